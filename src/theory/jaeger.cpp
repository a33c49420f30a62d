#include "theory/jaeger.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/exact_math.hpp"
#include "theory/angles.hpp"

namespace phy::theory {

double coulomb_sigma_1(const Coulomb& rock, double sigma_3) {
  const double mu = tan_degrees(rock.friction);
  // tan(45 + phi/2) written by mu, without a pole.
  return sigma_3 + 2.0 * (rock.cohesion + sigma_3 * mu) * (std::sqrt(1.0 + mu * mu) + mu);
}

double weak_plane_sigma_1(const Coulomb& plane, double theta, double sigma_3) {
  const SinCos a = sin_cos_degrees(folded_theta(theta));
  const double mu = tan_degrees(plane.friction);
  const double drive =
      2.0 * a.cos * (a.sin - mu * a.cos);  // (1 - mu cot theta) sin 2 theta without the pole at 0
  if (drive <= 0.0) return std::numeric_limits<double>::infinity();
  return sigma_3 + 2.0 * (plane.cohesion + sigma_3 * mu) / drive;
}

double jaeger_sigma_1(const Coulomb& plane, double matrix_sigma_1, double theta, double sigma_3) {
  return std::min(matrix_sigma_1, weak_plane_sigma_1(plane, theta, sigma_3));
}

StrengthMinimum weak_plane_minimum(const Coulomb& plane, double sigma_3) {
  // The plane that Coulomb would choose: on it the rock is as weak as if made of the plane.
  return {45.0 + 0.5 * plane.friction, coulomb_sigma_1(plane, sigma_3)};
}

SlipRange slip_range(const Coulomb& plane, double matrix_sigma_1, double sigma_3) {
  const SinCos f = sin_cos_degrees(plane.friction);
  const double difference = matrix_sigma_1 - sigma_3;
  if (difference <= 0.0) return {};
  const double level = f.sin + 2.0 * (plane.cohesion * f.cos + sigma_3 * f.sin) / difference;
  // The plane is stronger than the matrix at every angle.
  if (level > 1.0) return {};
  const double rise = std::asin(level) * (180.0 / pi);
  return {true, 0.5 * (plane.friction + rise), 0.5 * (plane.friction + 180.0 - rise)};
}

}  // namespace phy::theory
