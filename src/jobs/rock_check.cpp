#include "jobs/rock_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text_table.hpp"
#include "calibrate/closed_forms.hpp"
#include "calibrate/forecast.hpp"
#include "calibrate/identifiability.hpp"
#include "calibrate/model_choice.hpp"
#include "calibrate/outliers.hpp"
#include "calibrate/reach_check.hpp"
#include "report/calibration_tables.hpp"

namespace phy::jobs {
namespace {

/// What the table says by itself: closed forms, and values that do not belong to the others.
std::vector<std::string> what_the_table_says(const calibrate::Evidence& evidence) {
  std::vector<std::string> lines = calibrate::closed_forms(evidence);
  for (auto more :
       {calibrate::outlying_specimens(evidence.rock), calibrate::outlying_cells(evidence.targets)})
    lines.insert(lines.end(), more.begin(), more.end());
  return lines;
}

std::string all_in_words(const std::vector<Rock>& models) {
  std::vector<std::string> words;
  for (const Rock& rock : models) words.push_back(calibrate::model_in_words(rock));
  return fmt::format("{}", fmt::join(words, "; "));
}

}  // namespace

std::string rock_check(const Rock& read, const std::string& path, int width) {
  const calibrate::Evidence evidence(calibrate::with_model(read, read.layers, read.matrix));
  const Rock& rock = evidence.rock;
  std::string text;
  const auto items = [&](const std::vector<std::string>& lines) {
    for (const std::string& line : lines) text += wrapped("- " + line + "\n", width, 2);
  };
  text += wrapped(fmt::format("rock      {} ({})\n", rock.name, path), width, 10);
  for (const std::string& note : rock.notes) text += wrapped("          " + note + "\n", width, 10);
  text += "\n" + report::target_table(evidence.targets, width) + "\n";
  const std::vector<std::string> by_itself = what_the_table_says(evidence);
  items(by_itself);
  if (!by_itself.empty()) text += "\n";
  const std::vector<calibrate::Estimate> expected = calibrate::identifiability(evidence);
  text += report::identifiability_table({expected.begin(), expected.end()}, width);
  if (const std::vector<Rock> models = calibrate::candidates_of(evidence); models.size() > 1)
    items({fmt::format("parameters as of {}; calibrate chooses between {}",
                       calibrate::model_in_words(models.front()), all_in_words(models))});
  items(calibrate::advice(evidence));
  items(calibrate::place_in_maps(evidence));
  if (const auto forecast = calibrate::foretell(evidence))
    text += wrapped("\n" + calibrate::forecast_text(*forecast) + "\n", width, 2);
  return text;
}

}  // namespace phy::jobs
