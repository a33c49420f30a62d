#include "theory/anisotropic_disc.hpp"

#include <Eigen/LU>
#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "theory/anisotropic_roots.hpp"

namespace phy::theory {
namespace {

using Complex = std::complex<double>;
constexpr Complex imaginary{0.0, 1.0};
/// Harmonics beyond this carry less than 1e-6 of the stress a tenth of a radius below the rim.
constexpr int last_harmonic = 199;

/// Harmonics e^inw, n odd, of the tractions -p n on the arcs |w - 90| < alpha and |w - 270| < alpha.
struct Traction {
  Complex x, y;
};
Traction traction(double p, double alpha, int n) {
  // The limit of sin(k alpha)/k as k goes to 0.
  const double low = n == 1 ? alpha : std::sin((n - 1) * alpha) / (n - 1);
  const double high = std::sin((n + 1) * alpha) / (n + 1);
  const Complex turn = n % 4 == 1 ? -imaginary : imaginary;  // (-i)^n
  return {-p / pi * turn * imaginary * (low - high), -p / pi * turn * (low + high)};
}

/// a of a_1 + conj(a_1 t_1^n) + ... = f, mu_1 a_1 + conj(mu_1 a_1 t_1^n) + ... = g.
Eigen::Vector2cd harmonic(const std::array<Complex, 2>& mu, const std::array<Complex, 2>& t_n, Complex f,
                          Complex g) {
  Eigen::Matrix2cd A, B;
  A << 1.0, 1.0, mu[0], mu[1];
  B << std::conj(t_n[0]), std::conj(t_n[1]), std::conj(mu[0] * t_n[0]), std::conj(mu[1] * t_n[1]);
  // The second equation conjugated gives conj(a) in terms of a, which leaves two equations for a.
  const Eigen::Matrix2cd back = B * A.conjugate().inverse();
  const Eigen::Vector2cd right(f, g);
  return (A - back * B.conjugate()).inverse() * (right - back * right.conjugate());
}

}  // namespace

AnisotropicDisc::AnisotropicDisc(const PressedDisc& disc)
    : radius_(0.5 * disc.diameter), mu_(anisotropic_roots(disc.S)) {
  PHY_CHECK(disc.diameter > 0.0 && disc.alpha > 0.0 && disc.alpha < 90.0, "a disc and loaded arcs");
  const double alpha = disc.alpha * pi / 180.0, p = disc.P / (disc.diameter * std::sin(alpha));
  for (std::size_t k = 0; k < 2; ++k)
    // The circle in z_k = x + mu_k y is an ellipse; its exterior map turns it into a circle again.
    c_[k] = 0.5 * (1.0 - imaginary * mu_[k]), t_[k] = (1.0 + imaginary * mu_[k]) / (1.0 - imaginary * mu_[k]);
  // The first harmonic is a uniform stress, and needs no root.
  const Traction first = traction(p, alpha, 1);
  uniform_ = {2.0 * first.x.real(), -2.0 * first.y.imag(), 2.0 * first.y.real()};
  for (int n = 3; n <= last_harmonic; n += 2) {
    const Traction q = traction(p, alpha, n);
    const std::array<Complex, 2> t_n = {std::pow(t_[0], n), std::pow(t_[1], n)};
    const Eigen::Vector2cd a = harmonic(mu_, t_n, -q.y / (imaginary * static_cast<double>(n)),
                                        q.x / (imaginary * static_cast<double>(n)));
    for (std::size_t k = 0; k < 2; ++k) a_[k].push_back(a[static_cast<Eigen::Index>(k)]);
  }
}

DiscStress AnisotropicDisc::at(double x, double y) const {
  DiscStress s = uniform_;
  for (std::size_t k = 0; k < 2; ++k) {
    const Complex w = (x + mu_[k] * y) / (radius_ * c_[k]);
    Complex P = w, P_before = 2.0, rate = 1.0, rate_before = 0.0, sum = 0.0;  // n = 1 and n = 0
    for (int n = 2; n <= last_harmonic; ++n) {
      // Chebyshev-like recurrence for the polynomials and their derivatives.
      const Complex next = w * P - t_[k] * P_before, next_rate = P + w * rate - t_[k] * rate_before;
      P_before = P, P = next, rate_before = rate, rate = next_rate;
      if (n % 2 == 1) sum += a_[k][static_cast<std::size_t>((n - 3) / 2)] * rate;
    }
    const Complex phi = sum / c_[k];
    s.x += 2.0 * (mu_[k] * mu_[k] * phi).real();
    s.y += 2.0 * phi.real();
    s.xy -= 2.0 * (mu_[k] * phi).real();
  }
  return {-s.x, -s.y, -s.xy};
}

DiscStress AnisotropicDisc::mean(double radius) const {
  constexpr int rings = 12, places = 24;  // of equal areas
  DiscStress sum;
  for (int ring = 0; ring < rings; ++ring) {
    // Rings of equal areas, each read in its middle.
    const double r = radius * std::sqrt((ring + 0.5) / rings);
    for (int place = 0; place < places; ++place) {
      const double w = 2.0 * pi * (place + 0.5) / places;
      const DiscStress s = at(r * std::cos(w), r * std::sin(w));
      sum.x += s.x, sum.y += s.y, sum.xy += s.xy;
    }
  }
  constexpr double n = rings * places;
  return {sum.x / n, sum.y / n, sum.xy / n};
}

}  // namespace phy::theory
