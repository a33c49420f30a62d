#include "base/exact_functions.hpp"

#include <boost/math/special_functions/erf.hpp>
#include <cmath>
#include <limits>

namespace phy::exact {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// The sum of two doubles, the second at most half a unit in the last place of the first.
struct Two {
  double high, low;
};

constexpr Two ln_2{0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56},
    one_over_ln_2{0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56},
    one_over_ln_10{0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57},
    half_pi{0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Two one_sixth{1.0 / 6.0, 0x1.5555555555555p-57};
constexpr double half_pi_rest = -0x1.f1976b7ed8fbcp-110;

/// a + b where |a| >= |b|.
Two ordered_sum(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

Two sum(double a, double b) {
  const double high = a + b, part = high - a;
  return {high, (a - (high - part)) + (b - part)};
}

/// Without a fused multiply-add, which not every machine has.
Two product(double a, double b) {
  constexpr double split = 0x1p27 + 1.0;
  const double a_wide = split * a, b_wide = split * b;
  const double a_high = a_wide - (a_wide - a), b_high = b_wide - (b_wide - b);
  const double a_low = a - a_high, b_low = b - b_high, high = a * b;
  return {high, ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

Two operator+(Two a, Two b) {
  const Two high = sum(a.high, b.high), low = sum(a.low, b.low);
  const Two s = ordered_sum(high.high, high.low + low.high);
  return ordered_sum(s.high, s.low + low.low);
}
Two operator-(Two a) { return {-a.high, -a.low}; }
Two operator*(Two a, Two b) {
  const Two p = product(a.high, b.high);
  return ordered_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
}
Two operator/(Two a, Two b) {
  const double first = a.high / b.high;
  const Two rest = a + -(b * Two{first, 0.0});
  return ordered_sum(first, rest.high / b.high);
}
Two root(Two a) {
  if (a.high <= 0.0) return {0.0, 0.0};
  const double first = std::sqrt(a.high);
  const Two rest = a + -product(first, first);
  return ordered_sum(first, rest.high / (2.0 * first));
}
Two times(Two a, double power_of_two) { return {a.high * power_of_two, a.low * power_of_two}; }
double value(Two a) { return a.high + a.low; }

/// exp(x) - 1 for |x| <= 0.35: x + x^2/2 as two doubles, the rest of the series behind them.
Two small_expm1(Two x) {
  const double r = x.high;
  double series = 1.0 / 17.0;
  for (int n = 16; n >= 4; --n) series = (1.0 + r * series) * (1.0 / n);
  const Two square = x * x;
  const Two third = square * x * one_sixth;
  return (x + times(square, 0.5)) + (third + Two{third.high * (r * series), 0.0});
}

/// exp(x) = (1 + part) 2^k.
struct Power {
  Two part;
  int k;
};
Power power_of_e(Two x) {
  const double k = std::floor(x.high * one_over_ln_2.high + 0.5);
  return {small_expm1(x + -(ln_2 * Two{k, 0.0})), static_cast<int>(k)};
}

constexpr double largest_exponent = 710.0, smallest_exponent = -746.0;

double exp_of(Two x) {
  if (x.high > largest_exponent) return infinity;
  if (x.high < smallest_exponent) return 0.0;
  const Power power = power_of_e(x);
  return std::ldexp(value(Two{1.0, 0.0} + power.part), power.k);
}

/// exp(x) - 1 for |x| <= 40 and more, where 1 no longer counts.
Two expm1_of(Two x) {
  const Power power = power_of_e(x);
  if (power.k == 0) return power.part;
  const double scale = std::ldexp(1.0, power.k);
  return times(Two{1.0, 0.0} + power.part, scale) + Two{-1.0, 0.0};
}

/// log(m) for m in [sqrt(1/2), sqrt(2)]: 2 atanh(z), z = (m - 1) / (m + 1).
Two small_log(Two m) {
  const Two z = (m + Two{-1.0, 0.0}) / (m + Two{1.0, 0.0}), square = z * z;
  double series = 1.0 / 27.0;
  for (int n = 25; n >= 7; n -= 2) series = 1.0 / n + square.high * series;
  const Two fifth{0.2 + square.high * series, 0.0};
  const Two third = times(one_sixth, 2.0) + square * fifth;
  return times(z + z * square * third, 2.0);
}

/// x = m 2^k, m in [sqrt(1/2), sqrt(2)).
struct Parts {
  Two m;
  int k;
};
Parts parts_of(Two x) {
  int k = 0;
  const double m = std::frexp(x.high, &k);
  if (m < 0.70710678118654752440) --k;
  const int half = k / 2;  // 2^-k itself may be beyond what a double holds
  return {times(times(x, std::ldexp(1.0, -half)), std::ldexp(1.0, half - k)), k};
}

Two log_of(Two x) {
  const Parts parts = parts_of(x);
  return ln_2 * Two{static_cast<double>(parts.k), 0.0} + small_log(parts.m);
}

/// Whether log(x) is something else than a number, and what.
bool has_no_log(double x, double& answer) {
  answer = x == 0.0 ? -infinity : x < 0.0 ? no_number : x;
  return !(x > 0.0) || x == infinity;
}

/// sin and cos of |x| <= pi / 4.
Two small_sin(Two x) {
  const double y = x.high * x.high;
  double series = 1.0;
  for (int n = 19; n >= 7; n -= 2) series = 1.0 - y * series * (1.0 / (n * (n - 1.0)));
  const Two third = -(x * x * x * one_sixth);
  return x + (third + Two{third.high * (-y * series * (1.0 / 20.0)), 0.0});
}
Two small_cos(Two x) {
  const double y = x.high * x.high;
  double series = 1.0;
  for (int n = 20; n >= 6; n -= 2) series = 1.0 - y * series * (1.0 / (n * (n - 1.0)));
  const Two half = times(x * x, -0.5);
  return Two{1.0, 0.0} + (half + Two{half.high * (-y * series * (1.0 / 12.0)), 0.0});
}

/// sin(x + quarter pi / 2).
Two sin_of(double x, int quarter) {
  const double n = std::floor(x * (1.0 / half_pi.high) + 0.5);
  const Two rest =
      (Two{x, 0.0} + -product(n, half_pi.high)) + (-product(n, half_pi.low) + Two{-n * half_pi_rest, 0.0});
  const int turned = (static_cast<int>(std::fmod(n, 4.0)) + quarter) & 3;
  const Two s = turned % 2 == 0 ? small_sin(rest) : small_cos(rest);
  return turned < 2 ? s : -s;
}

/// atan(j / 8).
constexpr Two arcs[] = {{0.0, 0.0},
                        {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                        {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                        {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                        {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                        {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                        {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                        {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                        {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};

/// For 0 <= x <= 1.
Two small_atan(Two x) {
  const int j = static_cast<int>(x.high * 8.0 + 0.5);
  const Two c{j / 8.0, 0.0}, u = (x + -c) / (Two{1.0, 0.0} + x * c);
  const double y = u.high * u.high;
  double series = 1.0 / 15.0;
  for (int n = 13; n >= 3; n -= 2) series = 1.0 / n - y * series;
  return arcs[j] + (u + Two{-u.high * y * series, 0.0});
}

/// The angle of a point whose coordinates are numbers and not both zero.
Two angle_of(Two y, Two x) {
  const Two up = y.high < 0.0 ? -y : y, right = x.high < 0.0 ? -x : x;
  Two angle = up.high <= right.high ? small_atan(up / right) : half_pi + -small_atan(right / up);
  if (x.high < 0.0) angle = times(half_pi, 2.0) + -angle;
  return y.high < 0.0 ? -angle : angle;
}

/// The other side of a right-angled triangle with hypotenuse 1.
Two other_side(double x) { return root((Two{1.0, 0.0} + Two{-x, 0.0}) * (Two{1.0, 0.0} + Two{x, 0.0})); }

}  // namespace

double exp(double x) { return std::isnan(x) ? x : exp_of({x, 0.0}); }

double exp2(double x) {
  if (std::isnan(x)) return x;
  if (x > 1025.0) return infinity;
  if (x < -1076.0) return 0.0;
  const double k = std::floor(x + 0.5);
  const Two part = small_expm1(Two{x - k, 0.0} * ln_2);
  return std::ldexp(value(Two{1.0, 0.0} + part), static_cast<int>(k));
}

double expm1(double x) {
  if (std::isnan(x) || x == 0.0 || x == infinity) return x;
  if (x < -40.0) return -1.0;
  return x > largest_exponent - 1.0 ? exp(x) : value(expm1_of({x, 0.0}));
}

// The one that the draws of a calibration spend their time in: by doubles alone, as near as the C library's.
// With s = f / (2 + f) log(1 + f) = 2 atanh(s), and 2 s = f - s f leaves the rounding of s out of the sum.
double log(double x) {
  double answer = 0.0;
  if (has_no_log(x, answer)) return answer;
  constexpr double ln_2_high = 0x1.62e42feep-1,
                   ln_2_low = 0x1.a39ef35793c76p-33;  // k times the first is exact
  int k = 0;
  double m = std::frexp(x, &k);
  if (m < 0.70710678118654752440) m *= 2.0, --k;
  const double f = m - 1.0, s = f / (2.0 + f), z = s * s, w = z * z;
  // two series of half the length, which the processor works on side by side
  const double odd = z * (2.0 / 3 + w * (2.0 / 7 + w * (2.0 / 11 + w * (2.0 / 15 + w * (2.0 / 19))))),
               even = w * (2.0 / 5 + w * (2.0 / 9 + w * (2.0 / 13 + w * (2.0 / 17 + w * (2.0 / 21)))));
  return k * ln_2_high + (f - (s * (f - (odd + even)) - k * ln_2_low));
}

double log2(double x) {
  double answer = 0.0;
  if (has_no_log(x, answer)) return answer;
  const Parts parts = parts_of({x, 0.0});
  return value(Two{static_cast<double>(parts.k), 0.0} + small_log(parts.m) * one_over_ln_2);
}

double log10(double x) {
  double answer = 0.0;
  return has_no_log(x, answer) ? answer : value(log_of({x, 0.0}) * one_over_ln_10);
}

double log1p(double x) {
  double answer = 0.0;
  if (x == 0.0 || has_no_log(1.0 + x, answer)) return x == 0.0 ? x : answer;
  return value(log_of(sum(1.0, x)));
}

// Special values as C's annex F has them.
double pow(double x, double y) {
  if (y == 0.0 || x == 1.0) return 1.0;
  if (std::isnan(x) || std::isnan(y)) return x + y;
  const double size = std::fabs(x);
  if (std::isinf(y)) return size == 1.0 ? 1.0 : (size > 1.0) == (y > 0.0) ? infinity : 0.0;
  const bool odd = std::fmod(std::fabs(y), 2.0) == 1.0, mirrored = std::signbit(x) && odd;
  double result = 0.0;
  if (size == 0.0 || size == infinity)
    result = (size == 0.0) == (y > 0.0) ? 0.0 : infinity;
  else if (x < 0.0 && std::floor(y) != y)
    return no_number;
  else if (std::fabs(y) > 0x1p70)  // every x but 1 is far enough from it
    result = size == 1.0 ? 1.0 : (size > 1.0) == (y > 0.0) ? infinity : 0.0;
  else
    result = exp_of(log_of({size, 0.0}) * Two{y, 0.0});
  return mirrored ? -result : result;
}

double tanh(double x) {
  constexpr double one_from = 20.0;
  if (std::isnan(x) || x == 0.0) return x;
  if (std::fabs(x) > one_from) return x > 0.0 ? 1.0 : -1.0;
  const Two twice = expm1_of({2.0 * x, 0.0});
  return value(twice / (twice + Two{2.0, 0.0}));
}

double sin(double x) {
  return x == 0.0 || std::isnan(x) ? x : std::isinf(x) ? no_number : value(sin_of(x, 0));
}

double cos(double x) { return std::isnan(x) || std::isinf(x) ? no_number : value(sin_of(x, 1)); }

double tan(double x) {
  return x == 0.0 || std::isnan(x) ? x : std::isinf(x) ? no_number : value(sin_of(x, 0) / sin_of(x, 1));
}

double asin(double x) {
  if (x == 0.0) return x;
  return std::fabs(x) <= 1.0 ? value(angle_of({x, 0.0}, other_side(x))) : no_number;
}

double acos(double x) {
  if (x == 1.0) return 0.0;
  return std::fabs(x) <= 1.0 ? value(angle_of(other_side(x), {x, 0.0})) : no_number;
}

double atan(double x) { return x == 0.0 || std::isnan(x) ? x : atan2(x, 1.0); }

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return x + y;
  if (y == 0.0) return std::copysign(std::signbit(x) ? 2.0 * half_pi.high : 0.0, y);
  if (std::isinf(x) && std::isinf(y)) return std::copysign((x > 0.0 ? 0.5 : 1.5) * half_pi.high, y);
  if (std::isinf(y) || x == 0.0) return std::copysign(half_pi.high, y);
  if (std::isinf(x)) return std::copysign(x > 0.0 ? 0.0 : 2.0 * half_pi.high, y);
  // Numbers of moderate size, so that no product is beyond what a double holds.
  int k = 0;
  std::frexp(std::fmax(std::fabs(x), std::fabs(y)), &k);
  return value(angle_of({std::ldexp(y, -k), 0.0}, {std::ldexp(x, -k), 0.0}));
}

double hypot(double x, double y) {
  if (std::isinf(x) || std::isinf(y)) return infinity;
  if (std::isnan(x) || std::isnan(y)) return x + y;
  if (x == 0.0 || y == 0.0) return std::fabs(x) + std::fabs(y);
  int k = 0;
  std::frexp(std::fmax(std::fabs(x), std::fabs(y)), &k);
  const double a = std::ldexp(x, -k), b = std::ldexp(y, -k);
  return std::ldexp(value(root(product(a, a) + product(b, b))), k);
}

double erfc(double x) {
  using boost::math::policies::policy, boost::math::policies::promote_double;
  return boost::math::erfc(x, policy<promote_double<false>>());
}

}  // namespace phy::exact
