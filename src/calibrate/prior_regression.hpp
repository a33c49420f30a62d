// What other rocks have taught about a strength before a rock's own first test.
//
// log(strength/sigma_c) is a function of dimensionless numbers alone. The family of a rock's model was mapped
// over them (reach.hpp); a quadratic through its rows, per inclination and kind of test, predicts UCS of
// points that took no part to 10-20 %, of which some 10 % is the scatter of single runs (docs/calibration.md,
// "Prior mean"). It is a beginning, not an answer: the surrogate learns how far this rock, with its own
// bedding and grains, lies from it.
//
// Direct tension of layered rock was not mapped: a disc is pulled a quarter turn from its load, so its
// strength at 90 degrees less stands in, times direct tension over Brazilian strength of the same bonds
// without layers, and is believed less. Strengths under confinement were mapped without layers alone: UCS of
// the layered rock plus what the stress adds to the same bonds without layers.
#pragma once
#include <span>
#include <vector>

#include "calibrate/parameters.hpp"
#include "calibrate/reach.hpp"
#include "calibrate/surrogate.hpp"

namespace phy::calibrate {

/// Expected log(strength/sigma_c) of a rock with the moduli of a recipe at one angle.
class PriorRegression {
 public:
  /// `ratios`: those of the points that at() takes. `theta` in degrees, layers against the horizontal;
  /// between the angles that were mapped linear. The family of the recipe must have been mapped.
  PriorRegression(std::vector<const StrengthParameter*> ratios, const Recipe& recipe, Property property,
                  double theta);
  /// The same of what any regression over the levers of a family answers.
  PriorRegression(std::vector<const StrengthParameter*> ratios, const Recipe& recipe,
                  const ModelFamily& family, ReachRegression regression);
  /// `z`: places of the ratios in their boxes. A ratio that was not mapped changes nothing.
  double at(std::span<const double> z) const;

 private:
  struct Link {
    std::size_t ratio;
    const StrengthParameter* parameter;
    const Lever* lever;
    double at_middle, slope;  // of a logarithmic lever, whose place is linear in that of the ratio
    double place(double z) const;
  };
  std::vector<Link> links_;
  ReachRegression regression_;  // over the levers of the links, the others as in the recipe
};

/// What is known of log(strength/sigma_c) beforehand, for a rock with the moduli of a recipe, over the inputs
/// of StrengthPosterior.
PriorMean prior_strength(const Evidence& evidence, const Recipe& recipe, const Target& target);

}  // namespace phy::calibrate
