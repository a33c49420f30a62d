// Is there a layered elastic body with the E(theta) and nu(theta) of a table? Least squares over its four
// compliances in the plane (seen_at in transverse_isotropy.hpp), each cell weighed by its error:
//
//   minimise  sum (log(E(theta_i)/E_i) E_i/error_i)^2 + sum ((nu(theta_i) - nu_i)/error_i)^2
//
// over bodies whose strain energy is positive (S_xx, S_yy, S_ss > 0, S_xy^2 < S_xx S_yy). A body of any kind,
// or an isotropic rock to which planes add compliance, never negative: S_yy >= S_xx, S_ss >= 2 (S_xx - S_xy)
// (Eq. 1, theory/goodman.hpp). Both kinds are written in logarithms, which no step can take out of bounds;
// what lies on the bound is approached. Several starts, because a step far beyond a bound would not come
// back.
//
// The sum is chi-square where the body has the table's values but for errors, with as many degrees of freedom
// as there are cells less compliances that they speak about. Left out: errors that cells have in common.
#pragma once
#include <vector>

#include "theory/transverse_isotropy.hpp"

namespace phy::theory {

struct LayeredReading {
  double theta = 0.0;               ///< [deg]
  bool is_modulus = true;           ///< E [Pa]; false: nu
  double value = 0.0, error = 0.0;  ///< standard error, > 0
};

enum class LayeredBody { any, planes_in_isotropic_rock };

struct LayeredFit {
  PlaneCompliance body;
  double chi_square = 0.0;
  int degrees_of_freedom = 0;    ///< 0: nothing that could contradict
  std::vector<double> residual;  ///< in standard errors, one per reading
  PlaneConstants at(double theta) const { return seen_at(body, theta); }
  /// What chi-square exceeds in one table of a hundred, by chance (Wilson & Hilferty 1931: within 1 %).
  double limit() const;
  bool met() const { return degrees_of_freedom <= 0 || chi_square <= limit(); }
};

/// The nearest body. Needs a modulus among the readings.
LayeredFit fit_layered(const std::vector<LayeredReading>& readings, LayeredBody kind);

}  // namespace phy::theory
