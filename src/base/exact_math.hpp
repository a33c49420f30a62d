// Elementary functions with the same bits on every machine.
//
// Whatever feeds the time step, the bedding angles or the random strengths must not depend on the C library
// or on the instruction set: a last-bit difference in one bond strength gives another crack sequence. The
// functions below use only +, -, *, / and sqrt (exactly rounded by IEEE 754) in a fixed order. They are
// accurate to a few units in the last place, which exact_math.test.cpp measures against the C library.
// Rejected: libm (bits differ between versions).
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/vec.hpp"

namespace phy {

constexpr double pi = 3.14159265358979323846;

/// Natural logarithm of x > 0 (normal numbers). log(m 2^k) = k log 2 + 2 atanh((m-1)/(m+1)), m in [sqrt(1/2),
/// sqrt 2).
inline double exact_log(double x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  int k = static_cast<int>(bits >> 52U) - 1022;
  bits = (bits & 0x000fffffffffffffULL) | 0x3fe0000000000000ULL;  // m in [0.5, 1)
  double m = 0.0;
  std::memcpy(&m, &bits, sizeof m);
  if (m < 0.70710678118654752440) {
    m = 2.0 * m;
    k -= 1;
  }
  const double z = (m - 1.0) / (m + 1.0);
  const double z2 = z * z;
  double series = 1.0 / 27.0;
  for (int i = 25; i >= 1; i -= 2) series = 1.0 / i + z2 * series;
  return k * 0.69314718055994530942 + 2.0 * z * series;
}

namespace detail {
// Taylor series on |x| <= pi/4; the first neglected term is below 1e-18.
inline double sin_series(double x) {
  const double y = x * x;
  double s = 1.0;
  for (int i = 19; i >= 3; i -= 2) s = 1.0 - y * s / (i * (i - 1.0));
  return x * s;
}
inline double cos_series(double x) {
  const double y = x * x;
  double s = 1.0;
  for (int i = 20; i >= 2; i -= 2) s = 1.0 - y * s / (i * (i - 1.0));
  return s;
}
}  // namespace detail

struct SinCos {
  double sin;
  double cos;
};

/// Sine and cosine of an angle in degrees, |angle| <= 3600. Multiples of 90 degrees are exact, and
/// sin_cos_degrees(180 - a) mirrors sin_cos_degrees(a) bit by bit: the reduction is done in degrees.
inline SinCos sin_cos_degrees(double angle) {
  double turn = angle - 360.0 * std::floor(angle / 360.0);  // [0, 360)
  double quadrant = std::floor((turn + 45.0) / 90.0);
  // Both ends of a sector around 90 or 270 degrees belong to it: 45 and 135 then mirror each other exactly.
  if (turn - 90.0 * quadrant == -45.0 && std::fmod(quadrant, 2.0) == 0.0) quadrant -= 1.0;
  const double x = (turn - 90.0 * quadrant) * (pi / 180.0);
  const double s = detail::sin_series(x);
  const double c = detail::cos_series(x);
  switch (static_cast<int>(quadrant) & 3) {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
  }
}

inline double tan_degrees(double angle) {
  const SinCos sc = sin_cos_degrees(angle);
  return sc.sin / sc.cos;
}

/// Unit normal of a plane inclined by `theta` [deg] from +x, anticlockwise.
inline Vec2 plane_normal(double theta) {
  const SinCos sc = sin_cos_degrees(theta);
  return {-sc.sin, sc.cos};
}

}  // namespace phy
