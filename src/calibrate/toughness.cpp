#include "calibrate/toughness.hpp"

#include <algorithm>
#include <cmath>

#include "base/nan.hpp"
#include "base/units.hpp"
#include "study/expected.hpp"
#include "survey/half_discs.hpp"
#include "verdict/grain_size.hpp"

namespace phy::calibrate {
namespace {

/// How many grains of another size the smallest half disc of the rows has in its radius.
double in_radius(const std::vector<Comparison>& toughness, const Recipe& model, double grain_size) {
  double R = infinity;
  for (const Comparison& c : toughness) R = std::min(R, survey::radius_of(model, c.target));
  return survey::grains_in(R, grain_size);
}

}  // namespace

std::vector<Finding> toughness_findings(const std::vector<Comparison>& toughness, const Recipe& model) {
  const double now = grain_size(model), wanted = verdict::grain_size_to_meet(toughness, now);
  std::vector<Finding> findings;
  for (const Comparison& c : toughness)
    findings.push_back({FindingKind::toughness_compared,
                        {cell_of(c.target)},
                        {{"model", c.mean}, {"laboratory", c.target.mean}, {"grain_size", now}}});
  if (!std::isfinite(wanted)) return findings;
  if (verdict::can_hold(model, wanted))
    findings.push_back({FindingKind::toughness_grains,
                        {},
                        {{"wanted", wanted},
                         {"grains", rounded(study::expected_grains(model) * std::pow(now / wanted, 2.0), 2)},
                         {"in_radius", in_radius(toughness, model, wanted)},
                         {"fewest", survey::fewest_in_radius}}});
  else
    findings.push_back({FindingKind::toughness_grains_unfit, {}, {{"wanted", wanted}, {"grain_size", now}}});
  return findings;
}

}  // namespace phy::calibrate
