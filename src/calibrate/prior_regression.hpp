// What other rocks have taught about UCS before a rock's own first test.
//
// log(UCS/sigma_c) is a function of dimensionless numbers alone: five ratios of strengths and frictions
// (places in their boxes) and three of moduli, k_s/k_n, k_n spacing/E_c, k_s spacing/E_c. A
// quadratic in all eight per angle, fitted by ridge regression to tests of 48 synthetic rocks of the
// paper's geometry (1,197 discs, nine points of the box each on twelve packings, seven angles and intact),
// predicts UCS of rocks that took no part to 10-18 %, of which some 10 % is the scatter of single runs
// (docs/calibration.md, "Prior mean"). It is a beginning, not an answer: the surrogate learns how far this
// rock, with its own bedding and grains, lies from it.
//
// Of tension a closed form is enough to begin with. Across a set of planes under the pull s the normal stress
// is s cos^2(theta), the shear stress s sin(theta) cos(theta) (bonded joints have no friction); the planes
// part where sigma_n or C are reached, the matrix at 0.55 sigma_c (measured: docs/theory/ucs-to-tension.md).
// A disc is pulled a quarter turn from its load.
#pragma once
#include <span>
#include <vector>

#include "calibrate/parameters.hpp"
#include "calibrate/surrogate.hpp"
#include "records/calibration.hpp"
#include "records/recipe.hpp"

namespace phy::calibrate {

/// The ratios that were learnt, in the order of the regression, with bedding and without.
std::vector<const StrengthParameter*> regressed_ratios(bool bedded);

/// The eight numbers of a point, two and one without bedding, as the regression takes them: places of
/// regressed_ratios() in their boxes, and regression_moduli().
std::vector<double> regression_features(std::span<const double> places, std::span<const double> moduli);

/// k_s/k_n, k_n spacing/E_c, k_s spacing/E_c of a recipe, the first alone without bedding: logarithms,
/// scaled to [-1, 1] over the range that was learnt, and held at 1.2 beyond it.
std::vector<double> regression_moduli(const Recipe& recipe);

/// Expected log(UCS/sigma_c) of a rock with the moduli of a recipe at one angle.
class PriorRegression {
 public:
  /// `theta` in degrees, bedding against the horizontal; between the angles that were learnt linear.
  /// Without bedding the same at every angle.
  PriorRegression(const Recipe& recipe, double theta);
  /// `z`: places of strength_ratios() in their boxes. A ratio that was not learnt is taken to change nothing.
  double at(std::span<const double> z) const;

 private:
  std::vector<std::size_t> learnt_;  // which of the ratios
  std::vector<double> moduli_, coefficients_;
};

/// What is known of log(strength/sigma_c) beforehand, for a rock with the moduli of a recipe: of UCS, direct
/// tension and Brazilian tests.
PriorMean prior_strength(const Recipe& recipe, Property property, double theta);

}  // namespace phy::calibrate
