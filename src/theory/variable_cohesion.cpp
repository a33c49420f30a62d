#include "theory/variable_cohesion.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "theory/angles.hpp"

namespace phy::theory {

double OrientationLaw::at(double theta) const {
  PHY_CHECK(n >= 1, "an exponent of at least 1");
  const double folded = folded_theta(theta);
  // Two branches that meet at the weakest angle (McLamore & Gray 1967).
  const CosineBranch& branch = folded <= theta_min ? below : above;
  const double cosine = sin_cos_degrees(2.0 * (theta_min - folded)).cos;
  double power = 1.0;
  for (int i = 0; i < n; ++i) power *= cosine;
  return branch.A - branch.B * power;
}

OrientationLaw donath_law(double A, double B, double theta_min) { return {{A, B}, {A, B}, theta_min, 1}; }

namespace {
double sigma_1_from(double cohesion, double mu, double sigma_3) {
  return sigma_3 + 2.0 * (cohesion + sigma_3 * mu) * (std::sqrt(1.0 + mu * mu) + mu);
}
}  // namespace

double variable_cohesion_sigma_1(const OrientationLaw& cohesion, double friction, double theta,
                                 double sigma_3) {
  return sigma_1_from(cohesion.at(theta), tan_degrees(friction), sigma_3);
}

double mclamore_gray_sigma_1(const McLamoreGray& rock, double theta, double sigma_3) {
  return sigma_1_from(rock.cohesion.at(theta), rock.tan_friction.at(theta), sigma_3);
}

}  // namespace phy::theory
