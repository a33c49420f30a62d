#include "theory/hondros.hpp"

#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"

namespace phy::theory {
namespace {

struct Arc {
  double p;  // pressure [Pa]
  double tan, sin2, cos2;
};

Arc arc_of(const BrazilianDisc& disc) {
  PHY_CHECK(disc.alpha > 0.0 && disc.alpha < 90.0, "a loaded arc of 0 < alpha < 90 degrees");
  const SinCos one = sin_cos_degrees(disc.alpha);
  const SinCos two = sin_cos_degrees(2.0 * disc.alpha);
  // The pressure whose sum along the load is P.
  return {disc.P / (disc.diameter * disc.thickness * one.sin), one.sin / one.cos, two.sin, two.cos};
}

DiameterStress from_terms(double p, double A, double B) {
  const double scale = 2.0 * p / pi;
  return {scale * (B - A), scale * (B + A)};
}

}  // namespace

DiameterStress hondros_loaded_diameter(const BrazilianDisc& disc, double rho) {
  const Arc arc = arc_of(disc);
  const double r2 = rho * rho;
  const double A = (1.0 - r2) * arc.sin2 / (1.0 - 2.0 * r2 * arc.cos2 + r2 * r2);
  // atan2 and not atan: on the rim the denominator is zero.
  return from_terms(arc.p, A, std::atan2((1.0 + r2) * arc.tan, 1.0 - r2));
}

DiameterStress hondros_cross_diameter(const BrazilianDisc& disc, double rho) {
  const Arc arc = arc_of(disc);
  const double r2 = rho * rho;
  const double A = (1.0 - r2) * arc.sin2 / (1.0 + 2.0 * r2 * arc.cos2 + r2 * r2);
  return from_terms(arc.p, A, std::atan2((1.0 - r2) * arc.tan, 1.0 + r2));
}

DiameterStress point_load_loaded_diameter(const BrazilianDisc& disc, double rho) {
  const double s = brazilian_strength(disc.P, disc.diameter, disc.thickness);
  // Tension is the same along the whole diameter; compression grows to the loads without bound.
  return {-s, s * (4.0 / (1.0 - rho * rho) - 1.0)};
}

DiameterStress point_load_cross_diameter(const BrazilianDisc& disc, double rho) {
  const double s = brazilian_strength(disc.P, disc.diameter, disc.thickness);
  const double up = 1.0 + rho * rho;
  const double ratio = (1.0 - rho * rho) / up;
  return {-s * ratio * ratio, s * (4.0 / (up * up) - 1.0)};
}

double brazilian_strength(double P, double diameter, double thickness) {
  return 2.0 * P / (pi * diameter * thickness);
}

}  // namespace phy::theory
