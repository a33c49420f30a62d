// Strength envelopes from peaks at several confining stresses: least squares with standard errors.
//
//   Mohr-Coulomb   sigma_1 = ucs_mc + N sigma_3,  N = (1 + sin phi)/(1 - sin phi),  c = ucs_mc / (2 sqrt N)
//   Hoek-Brown     sigma_1 = sigma_3 + sqrt(ucs_hb^2 + m ucs_hb sigma_3)        (s = 1, a = 1/2)
//
// Mohr-Coulomb is a straight line; errors of c and phi follow from those of the line by first-order
// propagation, with the covariance of slope and intercept. Hoek-Brown starts from the line (sigma_1 -
// sigma_3)^2 over sigma_3 (Hoek & Brown 1980) and ends by Gauss-Newton on sigma_1 itself: the squares would
// weigh high stresses too much. Its covariance is s^2 (J'J)^-1. Standard errors assume independent residuals
// of equal size; with as many readings as unknowns there are none (NaN).
//
// Foliated rock (Saroglou & Tsiambaos 2008, theory/hoek_brown.hpp): Hoek-Brown at every inclination; k(theta)
// = m(theta) / m_i, with m_i that of the inclination nearest to loading across the planes.
#pragma once
#include <string>
#include <vector>

#include "base/nan.hpp"

namespace phy::theory {

/// One peak [Pa].
struct EnvelopeReading {
  double sigma_3 = 0.0, sigma_1 = 0.0;
};

/// A value with its standard error; NaN: not determined.
struct Estimate {
  double value = nan;
  double se = nan;
};

struct MohrCoulombFit {
  bool ok = false;
  std::string reason;  ///< why not, empty when ok
  Estimate cohesion;   ///< [Pa]
  Estimate friction;   ///< [deg]
  Estimate ucs;        ///< intercept [Pa]
  double R2 = 0.0;
};
/// Needs two different confining stresses and a slope of at least 1.
MohrCoulombFit fit_mohr_coulomb(const std::vector<EnvelopeReading>& readings);

struct HoekBrownFit {
  bool ok = false;
  std::string reason;
  Estimate ucs;  ///< intercept ucs_hb [Pa]
  Estimate m_i;  ///< [-]
  double R2 = 0.0;
};
/// Needs two different confining stresses and strengths that grow faster than sigma_3.
HoekBrownFit fit_hoek_brown(const std::vector<EnvelopeReading>& readings);

}  // namespace phy::theory
