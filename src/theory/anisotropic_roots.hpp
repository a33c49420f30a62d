// The roots on which stresses in a plane body of any anisotropy rest (S.G. Lekhnitskii, "Anisotropic Plates",
// Gordon & Breach, 1968): those above the real axis of
//
//   S_xx mu^4 - 2 S_xs mu^3 + (2 S_xy + S_ss) mu^2 - 2 S_ys mu + S_yy = 0
//
// Equal roots (an isotropic body, and some others) have another solution. Roots nearer than 1e-4 are moved
// apart by as much about their mean: stresses depend on equal roots through their mean, and change by the
// square of the distance, 1e-8.
#pragma once
#include <array>
#include <complex>

#include "theory/transverse_isotropy.hpp"

namespace phy::theory {

/// Two roots with positive imaginary parts, never equal. S belongs to a body whose energy is positive.
std::array<std::complex<double>, 2> anisotropic_roots(const PlaneCompliance& S);

}  // namespace phy::theory
