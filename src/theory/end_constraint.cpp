#include "theory/end_constraint.hpp"

#include "base/check.hpp"

namespace phy::theory {

double end_constraint_eta(const PlaneCompliance& S, double slenderness) {
  PHY_CHECK(slenderness > 0.0 && S.S_yy > 0.0 && S.S_ss > 0.0,
            "a specimen with height, width and finite stiffness");
  return 3.0 * S.S_ys * S.S_ys / (S.S_yy * (3.0 * S.S_ss + 2.0 * S.S_yy * slenderness * slenderness));
}

double end_constraint_ratio(const PlaneCompliance& S, double slenderness) {
  return 1.0 / (1.0 - end_constraint_eta(S, slenderness));
}

double end_constraint_mean_ratio(const PlaneCompliance& S, double slenderness) {
  const double eta = end_constraint_eta(S, slenderness);
  return (1.0 - 2.0 / 3.0 * eta) / (1.0 - eta);
}

}  // namespace phy::theory
