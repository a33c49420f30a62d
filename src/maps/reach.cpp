#include "maps/reach.hpp"

#include <algorithm>

#include "maps/forecast.hpp"
#include "maps/placing.hpp"

namespace phy::maps {
namespace {

/// As discs of the rock's own grains have it: coarse ones are stronger in tension.
Finding on_own_grains(Finding ratio, const Evidence& evidence) {
  const Cell& tension = ratio.cells.front();
  for (const Target& t : evidence.strengths) {
    if (cell_of(t) != tension || !measured(t.property).of_discs) continue;
    const double stronger = tension_over_maps(grains_across_disc(evidence.rock.model, t));
    for (NamedNumber& q : ratio.numbers)
      if (q.name == "low" || q.name == "high") q.value /= stronger;
  }
  return ratio;
}

}  // namespace

std::vector<Finding> reach_of(const Evidence& evidence, bool quick) {
  std::optional<Forecast> forecast = forecast_of(evidence);
  if (!forecast) return {};
  forecast->quick = quick;
  std::vector<Finding> reach = {findings_of(*forecast).front()};
  for (const Comparison& row : forecast->rows)
    reach.push_back(
        {FindingKind::map_expected,
         {cell_of(row.target)},
         {{"model", row.mean}, {"laboratory", row.target.mean}, {"error", forecast->error_of(row.target)}}});
  std::vector<const MappedModel*> all;
  for (const MappedModel& m : mapped_models())
    if (m.layered() == evidence.rock.bedded) all.push_back(&m);
  const std::vector<Finding> of_all = ratios_in_maps(evidence, all);
  for (Finding own : ratios_in_maps(evidence, {forecast->model})) {
    own = on_own_grains(std::move(own), evidence);
    for (const Finding& one : of_all)
      if (one.cells == own.cells) own.names = one.names;
    reach.push_back(std::move(own));
  }
  return reach;
}

}  // namespace phy::maps
