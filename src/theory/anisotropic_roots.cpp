#include "theory/anisotropic_roots.hpp"

#include "base/check.hpp"
#include "base/polynomial.hpp"

namespace phy::theory {

std::array<std::complex<double>, 2> anisotropic_roots(const PlaneCompliance& S) {
  constexpr double apart = 1e-4;
  const double scale = 1.0 / S.S_xx;
  std::array<std::complex<double>, 2> mu;
  std::size_t n = 0;
  for (const std::complex<double>& root : roots_of_monic(
           {S.S_yy * scale, -2.0 * S.S_ys * scale, (2.0 * S.S_xy + S.S_ss) * scale, -2.0 * S.S_xs * scale}))
    // Roots come in conjugate pairs; one of each spans the solution.
    if (root.imag() > 0.0 && n < 2) mu[n++] = root;
  PHY_CHECK(n == 2, "an elastic body has two roots above the real axis");
  if (std::abs(mu[0] - mu[1]) < apart) mu[0] *= 1.0 - apart, mu[1] *= 1.0 + apart;
  return mu;
}

}  // namespace phy::theory
