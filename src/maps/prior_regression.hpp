// What other rocks have taught about a strength before a rock's own first test.
//
// log(strength/sigma_c) is a function of dimensionless numbers alone. A rock's model was mapped over them
// (response_map.hpp); a quadratic through its rows, per inclination and kind of test, predicts UCS of
// points that took no part to 10-20 %, of which some 10 % is the scatter of single runs (docs/calibration.md,
// "Prior mean"). It is a beginning, not an answer: the surrogate learns how far this rock, with its own
// bedding and grains, lies from it.
//
// Direct tension of layered rock was not mapped: a disc is pulled a quarter turn from its load, so its
// strength at 90 degrees less stands in, times direct tension over Brazilian strength of the same bonds
// without layers, and is believed less. Strengths under confinement were mapped without layers alone: UCS of
// the layered rock plus what the stress adds to the same bonds without layers.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "maps/response_map.hpp"
#include "records/parameters.hpp"

namespace phy::maps {

/// What is known of a response before its first run: its value at every point, and how far a rock may lie
/// from that, in units of the logarithm, slope and curvature per half box (calibrate/surrogate.hpp).
struct PriorMean {
  std::function<double(std::span<const double>)> value = [](std::span<const double>) { return 0.0; };
  double constant = 1.0, slope = 0.33, curvature = 0.08;
};

/// Expected log(strength/sigma_c) of a rock with the moduli of a recipe at one angle.
class PriorRegression {
 public:
  /// `ratios`: those of the points that at() takes. `theta` in degrees, layers against the horizontal;
  /// between the angles that were mapped linear. The model of the recipe must have been mapped.
  PriorRegression(std::vector<const Parameter*> ratios, const Recipe& recipe, Property property,
                  double theta);
  /// The same of what any regression over the variables of a model answers.
  PriorRegression(std::vector<const Parameter*> ratios, const Recipe& recipe, const MappedModel& model,
                  MapRegression regression);
  /// `z`: places of the ratios in their boxes. A ratio that was not mapped changes nothing.
  double at(std::span<const double> z) const;

 private:
  struct Link {
    std::size_t ratio;
    const Parameter* parameter;
    const MapVariable* variable;
    double at_middle, slope;  // of a logarithmic variable, whose place is linear in that of the ratio
    double place(double z) const;
  };
  std::vector<Link> links_;
  MapRegression regression_;  // over the variables of the links, the others as in the recipe
};

/// What is known of log(K_Ic/sigma_c) [of sqrt(m)] beforehand: the Brazilian strength that is expected at the
/// same inclination, where a disc splits along its load as a half disc from its notch, times
/// sqrt(pi alpha R), R the mean radius of the grains (Potyondy & Cundall 2004, Int. J. Rock Mech. Min. Sci.
/// 41:1329-1364); sigma_c in place of that strength where nothing was mapped. `splitting`: of
/// log(BTS/sigma_c), nothing where nothing was mapped.
PriorMean prior_toughness(const Recipe& recipe, const std::optional<PriorMean>& splitting);

/// What is known of log(strength/sigma_c) beforehand, for a rock with the moduli of a recipe, over the inputs
/// of StrengthPosterior.
PriorMean prior_strength(const Evidence& evidence, const Recipe& recipe, const Target& target);

}  // namespace phy::maps
