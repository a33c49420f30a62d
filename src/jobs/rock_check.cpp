#include "jobs/rock_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/text_table.hpp"
#include "calibrate/angle_question.hpp"
#include "calibrate/closed_forms.hpp"
#include "calibrate/forecast.hpp"
#include "calibrate/identifiability.hpp"
#include "calibrate/model_choice.hpp"
#include "calibrate/outliers.hpp"
#include "calibrate/reach_check.hpp"
#include "records/rock_warnings.hpp"
#include "report/calibration_tables.hpp"

namespace phy::jobs {
namespace {

/// The sense of the angles, then units and ratios, then values that do not belong to the others.
std::vector<std::string> doubts_about(const calibrate::Evidence& evidence) {
  std::vector<std::string> doubts;
  if (const auto question = calibrate::angle_question(evidence.targets))
    doubts.push_back(calibrate::text_of(*question, evidence.rock.counts_from_load));
  for (auto more : {warnings_about(evidence.rock), calibrate::outlying_specimens(evidence.rock),
                    calibrate::outlying_cells(evidence.targets)})
    doubts.insert(doubts.end(), more.begin(), more.end());
  return doubts;
}

}  // namespace

RockCheck check(const Rock& read) {
  RockCheck found{
      calibrate::Evidence(calibrate::with_model(read, read.layers, read.matrix)), {}, {}, {}, {}, {}, {}};
  const calibrate::Evidence& evidence = found.evidence;
  found.doubts = doubts_about(evidence);
  for (const std::string& note : evidence.rock.notes)
    if (std::find(found.doubts.begin(), found.doubts.end(), note) == found.doubts.end())
      found.notes.push_back(note);
  found.says = calibrate::closed_forms(evidence);
  const std::vector<calibrate::Estimate> expected = calibrate::identifiability(evidence);
  found.parameters = {expected.begin(), expected.end()};
  const calibrate::Evidence as_read(read);
  const std::vector<Rock> models = calibrate::candidates_of(as_read);
  if (models.size() > 1)
    found.advice.push_back(fmt::format("parameters as of {}; calibrate chooses between {}",
                                       calibrate::model_in_words(models.front()),
                                       calibrate::models_in_words(models)));
  if (const std::string text = calibrate::assumed_share(read, models); !text.empty())
    found.advice.push_back(text);
  for (auto more : {calibrate::advice(evidence), calibrate::place_in_maps(evidence)})
    found.advice.insert(found.advice.end(), more.begin(), more.end());
  if (const auto forecast = calibrate::foretell(as_read))
    found.forecast = calibrate::forecast_text(*forecast);
  return found;
}

std::string rock_check(const Rock& read, const std::string& path, int width) {
  const RockCheck found = check(read);
  const Rock& rock = found.evidence.rock;
  std::string text;
  const auto items = [&](const std::vector<std::string>& lines) {
    for (const std::string& line : lines) text += wrapped("- " + line + "\n", width, 2);
  };
  for (const std::string& doubt : found.doubts) text += wrapped(doubt + "\n", width, 2);
  if (!found.doubts.empty()) text += "\n";
  text += wrapped(fmt::format("rock      {} ({})\n", rock.name, path), width, 10);
  for (const std::string& note : found.notes) text += wrapped("          " + note + "\n", width, 10);
  text += "\n" + report::target_table(found.evidence.targets, width) + "\n";
  items(found.says);
  if (!found.says.empty()) text += "\n";
  text += report::identifiability_table(found.parameters, width);
  items(found.advice);
  if (found.forecast) text += wrapped("\n" + *found.forecast + "\n", width, 2);
  return text;
}

}  // namespace phy::jobs
