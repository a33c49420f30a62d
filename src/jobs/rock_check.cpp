#include "jobs/rock_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "jobs/rock_base.hpp"
#include "maps/candidates.hpp"
#include "maps/forecast.hpp"
#include "maps/placing.hpp"
#include "report/words.hpp"
#include "survey/cells.hpp"
#include "survey/closed_forms.hpp"
#include "survey/doubts.hpp"
#include "survey/identifiability.hpp"

namespace phy::jobs {
namespace {

/// The end of a forecast, which knows each value by itself: no model has values that contradict each other.
void take_contradictions(const std::vector<Finding>& doubts, Finding& end) {
  constexpr FindingKind contradictions[] = {FindingKind::unusual_shear, FindingKind::unusual_point_load,
                                            FindingKind::unusual_tension, FindingKind::strength_falls,
                                            FindingKind::off_envelope};
  if (end.kind == FindingKind::forecast_out_of_reach) return;
  for (const Finding& doubt : doubts) {
    if (std::ranges::find(contradictions, doubt.kind) == std::end(contradictions)) continue;
    end.kind = FindingKind::forecast_excepted;
    for (const Cell& cell : doubt.cells)
      if (std::ranges::find(end.cells, cell) == end.cells.end()) end.cells.push_back(cell);
  }
}

}  // namespace

RockCheck check(const Rock& read) {
  // Parameters need one model to be told of; the forecast below weighs all that the file allows.
  RockCheck found{Evidence(maps::with_model(read, read.layers, read.matrix)), Evidence(read)};
  const Evidence& evidence = found.evidence;
  found.doubts = survey::doubts_about(evidence);
  found.statements = survey::closed_forms(evidence);
  const std::vector<Estimate> expected = survey::identifiability(evidence);
  found.parameters = {expected.begin(), expected.end()};
  found.limits = survey::limits_of_table(evidence);
  // models are compared and the verdict is forecast for the rock as its file leaves it open
  const std::vector<Rock> models = maps::candidates_of(found.as_read);
  if (models.size() > 1)
    found.models.push_back(fmt::format("parameters as of {}; calibrate chooses between {}",
                                       maps::model_in_words(models.front()), maps::models_in_words(models)));
  if (const auto share = maps::assumed_share(read, models)) found.models.push_back(report::sentence(*share));
  found.in_maps = report::sentences(survey::cells_in(read, maps::place_in_maps(evidence)));
  if (const auto forecast = maps::forecast_of(found.as_read))
    found.forecast = survey::cells_in(read, maps::findings_of(*forecast));
  if (!found.forecast.empty()) take_contradictions(found.doubts, found.forecast.front());
  found.neighbour = nearest_rock(evidence.targets);
  return found;
}

}  // namespace phy::jobs
