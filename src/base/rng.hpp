// Counter-based random numbers: Philox4x32-10 (Salmon, Moraes, Dror & Shaw 2011, "Parallel random numbers: as
// easy as 1, 2, 3", SC11). A draw is a pure function of (seed, stream, counter): the strength of the bond
// between grains i and j does not depend on the order in which bonds are made, on threads, or on the lane in
// which the specimen runs.
#pragma once
#include <array>
#include <cstdint>

#include "base/exact_math.hpp"

namespace phy {

using PhiloxBlock = std::array<std::uint32_t, 4>;

/// Ten rounds of Philox4x32 on `counter` with `key`.
constexpr PhiloxBlock philox4x32(PhiloxBlock counter, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t p0 = 0xD2511F53ULL * counter[0];
    const std::uint64_t p1 = 0xCD9E8D57ULL * counter[2];
    counter = {static_cast<std::uint32_t>(p1 >> 32U) ^ counter[1] ^ key[0], static_cast<std::uint32_t>(p1),
               static_cast<std::uint32_t>(p0 >> 32U) ^ counter[3] ^ key[1], static_cast<std::uint32_t>(p0)};
    key[0] += 0x9E3779B9U;
    key[1] += 0xBB67AE85U;
  }
  return counter;
}

/// What a random number is for. Two purposes never share a number.
enum class Stream : std::uint32_t {
  radius = 1,
  position = 2,
  bond_tension = 3,
  bond_shear = 4,
  design = 5,
  calibration = 6,
  bedding_patch = 7,
  bedding_phase = 8,
  bedding_contact = 9,
  bedding_spacing = 10,
  bedding_theta = 11,
  joint_tension = 12,
  unbonded = 13,
  gapped = 14,
  test = 99
};

/// The number (bits + 1/2) 2^-53 of the open interval (0, 1), bits < 2^53. Above 1/2 the half is lost in the
/// rounding; the largest would round to 1 and is held below it.
constexpr double open_unit(std::uint64_t bits) {
  const double u = (static_cast<double>(bits) + 0.5) * 0x1.0p-53;
  return u < 1.0 ? u : 1.0 - 0x1.0p-53;
}

/// Uniform in the open interval (0, 1), with 53 random bits.
inline double uniform(std::uint32_t seed, Stream stream, std::uint32_t a, std::uint32_t b = 0,
                      std::uint32_t c = 0) {
  const PhiloxBlock r = philox4x32({a, b, c, 0}, {seed, static_cast<std::uint32_t>(stream)});
  return open_unit((static_cast<std::uint64_t>(r[0]) << 21U) ^ (r[1] >> 11U));
}

/// c[0] x^7 + ... + c[7], by Horner's rule.
inline double of_degree_7(const double (&c)[8], double x) {
  double value = c[0];
  for (int i = 1; i < 8; ++i) value = value * x + c[i];
  return value;
}

/// Quantile of the standard normal distribution, 0 < p < 1: Wichura 1988, algorithm AS 241 (PPND16), Applied
/// Statistics 37:477-484. Relative accuracy about 1e-16; uses exact_log, so the same bits everywhere.
inline double normal_quantile(double p) {
  // The published coefficients of numerators and denominators, highest power first: of the middle, of the
  // tails, and of what lies beyond exp(-25).
  constexpr double a[] = {2509.0809287301226727, 33430.575583588128105, 67265.770927008700853,
                          45921.953931549871457, 13731.693765509461125, 1971.5909503065514427,
                          133.14166789178437745, 3.387132872796366608};
  constexpr double b[] = {
      5226.495278852854561,  28729.085735721942674, 39307.89580009271061,  21213.794301586595867,
      5394.1960214247511077, 687.1870074920579083,  42.313330701600911252, 1.0};
  constexpr double c[] = {7.7454501427834140764e-4, 0.0227238449892691845833, 0.24178072517745061177,
                          1.27045825245236838258,   3.64784832476320460504,   5.7694972214606914055,
                          4.6303378461565452959,    1.42343711074968357734};
  constexpr double d[] = {
      1.05075007164441684324e-9, 5.475938084995344946e-4, 0.0151986665636164571966, 0.14810397642748007459,
      0.68976733498510000455,    1.6763848301838038494,   2.05319162663775882187,   1.0};
  constexpr double e[] = {2.01033439929228813265e-7, 2.71155556874348757815e-5, 0.0012426609473880784386,
                          0.026532189526576123093,   0.29656057182850489123,    1.7848265399172913358,
                          5.4637849111641143699,     6.6579046435011037772};
  constexpr double f[] = {
      2.04426310338993978564e-15, 1.4215117583164458887e-7, 1.8463183175100546818e-5, 7.868691311456132591e-4,
      0.0148753612908506148525,   0.13692988092273580531,   0.59983220655588793769,   1.0};
  const double q = p - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q * of_degree_7(a, r) / of_degree_7(b, r);
  }
  const double r = std::sqrt(-exact_log(q < 0.0 ? p : 1.0 - p));
  const double value = r <= 5.0 ? of_degree_7(c, r - 1.6) / of_degree_7(d, r - 1.6)
                                : of_degree_7(e, r - 5.0) / of_degree_7(f, r - 5.0);
  return q < 0.0 ? -value : value;
}

/// A standard normal number keyed like `uniform`.
inline double normal(std::uint32_t seed, Stream stream, std::uint32_t a, std::uint32_t b = 0,
                     std::uint32_t c = 0) {
  return normal_quantile(uniform(seed, stream, a, b, c));
}

}  // namespace phy
