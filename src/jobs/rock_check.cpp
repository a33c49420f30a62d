#include "jobs/rock_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

#include "base/text_table.hpp"
#include "maps/candidates.hpp"
#include "maps/forecast.hpp"
#include "maps/placing.hpp"
#include "report/calibration_tables.hpp"
#include "report/words.hpp"
#include "survey/cells.hpp"
#include "survey/closed_forms.hpp"
#include "survey/doubts.hpp"
#include "survey/identifiability.hpp"

namespace phy::jobs {

RockCheck check(const Rock& read) {
  RockCheck found{Evidence(maps::with_model(read, read.layers, read.matrix)), {}, {}, {}, {}, {}, {}, {}};
  const Evidence& evidence = found.evidence;
  found.doubts = survey::doubts_about(evidence);
  found.statements = survey::closed_forms(evidence);
  const std::vector<Estimate> expected = survey::identifiability(evidence);
  found.parameters = {expected.begin(), expected.end()};
  found.limits = survey::limits_of_table(evidence);
  // models are compared and the verdict is forecast for the rock as its file leaves it open
  const Evidence as_read(read);
  const std::vector<Rock> models = maps::candidates_of(as_read);
  if (models.size() > 1)
    found.models.push_back(fmt::format("parameters as of {}; calibrate chooses between {}",
                                       maps::model_in_words(models.front()), maps::models_in_words(models)));
  if (const auto share = maps::assumed_share(read, models)) found.models.push_back(report::sentence(*share));
  const auto sentences = [&](std::vector<Finding> findings) {
    return report::sentences(survey::cells_in(read, std::move(findings)));
  };
  found.in_maps = sentences(maps::place_in_maps(evidence));
  if (const auto forecast = maps::forecast_of(as_read))
    found.forecast = fmt::format("{}", fmt::join(sentences(maps::findings_of(*forecast)), " "));
  return found;
}

std::string rock_check(const Rock& read, const std::string& path, int width) {
  const RockCheck found = check(read);
  const Rock& rock = found.evidence.rock;
  std::string text;
  const auto items = [&](const std::vector<std::string>& lines) {
    for (const std::string& line : lines) text += wrapped("- " + line + "\n", width, 2);
  };
  for (const std::string& doubt : report::sentences(found.doubts)) text += wrapped(doubt + "\n", width, 2);
  if (!found.doubts.empty()) text += "\n";
  text += wrapped(fmt::format("rock      {} ({})\n", rock.name, path), width, 10);
  for (const std::string& note : rock.notes) text += wrapped("          " + note + "\n", width, 10);
  text += "\n" + report::target_table(found.evidence.targets, width) + "\n";
  items(report::sentences(found.statements));
  if (!found.statements.empty()) text += "\n";
  text += report::identifiability_table(found.parameters, width);
  items(found.models);
  items(report::sentences(found.limits));
  items(found.in_maps);
  if (found.forecast) text += wrapped("\n" + *found.forecast + "\n", width, 2);
  return text;
}

}  // namespace phy::jobs
