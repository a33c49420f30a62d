#include "theory/opening.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "theory/anisotropic_roots.hpp"

namespace phy::theory {
namespace {

using Complex = std::complex<double>;
constexpr Complex imaginary{0.0, 1.0};

void check_outside(const Opening& opening, double x, double y) {
  PHY_CHECK(opening.radius > 0.0, "a hole has a radius");
  // Points of the wall itself are rounded.
  PHY_CHECK(std::hypot(x, y) >= opening.radius * (1.0 - 1e-9), "there is no stress inside a hole");
}

/// w of the exterior map of a wall of radius 1: of the two answers that are each other's inverse but for a
/// factor below 1, the one outside the unit circle.
Complex mapped(Complex mu, Complex z) {
  const Complex root = std::sqrt(z * z - 1.0 - mu * mu);
  const Complex one = (z + root) / (1.0 - imaginary * mu), other = (z - root) / (1.0 - imaginary * mu);
  return std::abs(one) >= std::abs(other) ? one : other;
}

/// Shortening of the radius [m] by the uniform stress alone, as if there were no hole.
double uniform_closure(const PlaneCompliance& S, const Opening& opening, double angle) {
  const StressInPlane& far = opening.far;
  const SinCos a = sin_cos_degrees(angle);
  const double xx = S.S_xx * far.x + S.S_xy * far.y + S.S_xs * far.xy;
  const double yy = S.S_xy * far.x + S.S_yy * far.y + S.S_ys * far.xy;
  const double xy = S.S_xs * far.x + S.S_ys * far.y + S.S_ss * far.xy;
  return opening.radius * (xx * a.cos * a.cos + yy * a.sin * a.sin + xy * a.sin * a.cos);
}

}  // namespace

PolarStress polar(const StressInPlane& stress, double angle) {
  const SinCos a = sin_cos_degrees(angle);
  const double c2 = a.cos * a.cos, s2 = a.sin * a.sin, sc = a.sin * a.cos;
  return {stress.x * c2 + stress.y * s2 + 2.0 * stress.xy * sc,
          stress.x * s2 + stress.y * c2 - 2.0 * stress.xy * sc,
          (stress.y - stress.x) * sc + stress.xy * (c2 - s2)};
}

StressInPlane kirsch(const Opening& opening, double x, double y) {
  check_outside(opening, x, y);
  const double r2 = x * x + y * y, e = opening.radius * opening.radius / r2, p = opening.pressure;
  const double cos2 = (x * x - y * y) / r2, sin2 = 2.0 * x * y / r2;
  const StressInPlane& far = opening.far;
  const double m = 0.5 * (far.x + far.y), half = 0.5 * (far.x - far.y);
  const double d = half * cos2 + far.xy * sin2;
  const double radial = m * (1.0 - e) + d * (1.0 - 4.0 * e + 3.0 * e * e) + p * e;
  const double hoop = m * (1.0 + e) - d * (1.0 + 3.0 * e * e) - p * e;
  const double shear = (far.xy * cos2 - half * sin2) * (1.0 + 2.0 * e - 3.0 * e * e);
  const double mean = 0.5 * (radial + hoop), range = 0.5 * (radial - hoop);
  return {mean + range * cos2 - shear * sin2, mean - range * cos2 + shear * sin2,
          range * sin2 + shear * cos2};
}

double kirsch_closure(const Opening& opening, const PlaneConstants& seen, double angle, Loaded when) {
  PHY_CHECK(opening.radius > 0.0 && seen.E > 0.0, "a hole in an elastic body");
  const StressInPlane& far = opening.far;
  const SinCos a = sin_cos_degrees(2.0 * angle);
  const double d = 0.5 * (far.x - far.y) * a.cos + far.xy * a.sin, sum = far.x + far.y;
  const double scale = opening.radius / seen.E;
  const double loaded = scale * (sum + 4.0 * d - (1.0 + seen.nu) * opening.pressure);
  const double uniform = scale * (0.5 * (1.0 - seen.nu) * sum + (1.0 + seen.nu) * d);
  return when == Loaded::with_hole ? loaded : loaded - uniform;
}

AnisotropicOpening::AnisotropicOpening(const PlaneCompliance& S, const Opening& opening)
    : S_(S), opening_(opening), mu_(anisotropic_roots(S)) {
  PHY_CHECK(opening.radius > 0.0, "a hole has a radius");
  // Half the harmonic e^-ia of the stress function's slopes that make the wall carry p alone, of R = 1.
  const Complex along_x{-0.5 * (opening.pressure - opening.far.y), -0.5 * opening.far.xy};
  const Complex along_y{-0.5 * opening.far.xy, -0.5 * (opening.pressure - opening.far.x)};
  A_[0] = (along_y - mu_[1] * along_x) / (mu_[0] - mu_[1]);
  A_[1] = (mu_[0] * along_x - along_y) / (mu_[0] - mu_[1]);
}

StressInPlane AnisotropicOpening::at(double x, double y) const {
  check_outside(opening_, x, y);
  StressInPlane s = opening_.far;
  for (std::size_t k = 0; k < 2; ++k) {
    const Complex mu = mu_[k], w = mapped(mu, (x + mu * y) / opening_.radius);
    const Complex rate = 0.5 * ((1.0 - imaginary * mu) - (1.0 + imaginary * mu) / (w * w));  // dz/dw
    const Complex phi = -A_[k] / (w * w * rate);
    s.x -= 2.0 * (mu * mu * phi).real();
    s.y -= 2.0 * phi.real();
    s.xy += 2.0 * (mu * phi).real();
  }
  return s;
}

double AnisotropicOpening::closure(double angle, Loaded when) const {
  const SinCos a = sin_cos_degrees(angle);
  const Complex back{a.cos, -a.sin};  // 1/w on the wall
  double outward = 0.0;
  for (std::size_t k = 0; k < 2; ++k) {
    const Complex mu = mu_[k], phi = A_[k] * back;
    outward += 2.0 * a.cos * ((S_.S_xx * mu * mu + S_.S_xy - S_.S_xs * mu) * phi).real();
    outward += 2.0 * a.sin * ((S_.S_xy * mu + S_.S_yy / mu - S_.S_ys) * phi).real();
  }
  const double cut = -opening_.radius * outward;
  return when == Loaded::before_hole ? cut : cut + uniform_closure(S_, opening_, angle);
}

}  // namespace phy::theory
