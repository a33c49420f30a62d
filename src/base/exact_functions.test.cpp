#include "base/exact_functions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/rng.hpp"

namespace phy {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity(),
                 nan = std::numeric_limits<double>::quiet_NaN();

/// The C library's functions of more digits say what is right.
using Function = double (*)(double);
using Wide = long double (*)(long double);
struct Case {
  const char* name;
  Function own;
  Wide wide;
  double from, to;
  double units = 0.6;  ///< in the last place, that it may be off
};

/// In units in the last place.
double error_of(double x, long double right) {
  const double rounded = static_cast<double>(right);
  const double unit = std::nextafter(std::fabs(rounded), inf) - std::fabs(rounded);
  return static_cast<double>(std::fabs(static_cast<long double>(x) - right) / static_cast<long double>(unit));
}

class ExactFunctions : public testing::TestWithParam<Case> {};

TEST_P(ExactFunctions, AreRightToTheLastPlace) {
  const Case& c = GetParam();
  double worst = 0.0, at = 0.0;
  for (std::uint32_t i = 0; i < 50000; ++i) {
    const double x = c.from + (c.to - c.from) * uniform(1, Stream::test, i);
    const double error = error_of(c.own(x), c.wide(x));
    if (!(error <= worst)) worst = error, at = x;
  }
  EXPECT_LE(worst, c.units) << c.name << " of " << at;
}

INSTANTIATE_TEST_SUITE_P(
    All, ExactFunctions,
    testing::Values(
        Case{"exp", exact::exp, std::exp, -700, 700}, Case{"exp", exact::exp, std::exp, -1, 1},
        Case{"exp2", exact::exp2, std::exp2, -1000, 1000}, Case{"expm1", exact::expm1, std::expm1, -2, 2},
        Case{"expm1", exact::expm1, std::expm1, -1e-3, 1e-3},
        Case{"expm1", exact::expm1, std::expm1, -30, 700}, Case{"log", exact::log, std::log, 0, 3, 1.0},
        Case{"log", exact::log, std::log, 0, 1e300, 1.0},
        Case{"log", exact::log, std::log, 0.999, 1.001, 1.0}, Case{"log2", exact::log2, std::log2, 0, 3},
        Case{"log10", exact::log10, std::log10, 0, 3}, Case{"log10", exact::log10, std::log10, 0, 1e9},
        Case{"log1p", exact::log1p, std::log1p, -0.9, 2},
        Case{"log1p", exact::log1p, std::log1p, -1e-3, 1e-3}, Case{"tanh", exact::tanh, std::tanh, -3, 3},
        Case{"tanh", exact::tanh, std::tanh, -1e-3, 1e-3}, Case{"sin", exact::sin, std::sin, -7, 7},
        Case{"sin", exact::sin, std::sin, -1e5, 1e5}, Case{"cos", exact::cos, std::cos, -7, 7},
        Case{"cos", exact::cos, std::cos, -1e5, 1e5}, Case{"tan", exact::tan, std::tan, -7, 7},
        Case{"asin", exact::asin, std::asin, -1, 1}, Case{"acos", exact::acos, std::acos, -1, 1},
        Case{"atan", exact::atan, std::atan, -3, 3}, Case{"atan", exact::atan, std::atan, -1e3, 1e3}));

TEST(ExactFunctionsOfTwo, AreRightToTheLastPlace) {
  double worst[] = {0.0, 0.0, 0.0};
  const auto meet = [&](int which, double own, long double right) {
    const double error = error_of(own, right);
    if (!(error <= worst[which])) worst[which] = error;
  };
  for (std::uint32_t i = 0; i < 50000; ++i) {
    const auto random = [&](std::uint32_t k, double size) {
      return size * (2.0 * uniform(2, Stream::test, i, k) - 1.0);
    };
    const double x = random(0, 3.0), y = random(1, 3.0), base = 0.01 + std::fabs(random(2, 20.0)),
                 power = random(3, 30.0);
    meet(0, exact::atan2(y, x), std::atan2(static_cast<long double>(y), static_cast<long double>(x)));
    meet(1, exact::hypot(x, y), std::hypot(static_cast<long double>(x), static_cast<long double>(y)));
    meet(2, exact::pow(base, power),
         std::pow(static_cast<long double>(base), static_cast<long double>(power)));
  }
  for (const double error : worst) EXPECT_LE(error, 0.6);
}

TEST(ExactFunctionsOfTwo, PowersOfTenAreTheNumbersThatAreWritten) {
  double ten = 1.0;
  for (int n = 0; n <= 22; ++n, ten *= 10.0) {
    EXPECT_EQ(exact::pow(10.0, n), ten);
    EXPECT_EQ(exact::log10(ten), n);
    EXPECT_EQ(exact::pow(10.0, -n), 1.0 / ten);
  }
  for (int n = -1074; n <= 1023; ++n) {
    EXPECT_EQ(exact::exp2(n), std::ldexp(1.0, n));
    EXPECT_EQ(exact::log2(std::ldexp(1.0, n)), n);
    EXPECT_EQ(exact::pow(2.0, n), std::ldexp(1.0, n));
  }
  EXPECT_EQ(exact::hypot(0x3p700, 0x4p700), 0x5p700);
}

TEST(ExactFunctionsOfTwo, SpecialValuesAreThoseOfC) {
  const double odd[] = {0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 2.0, -2.0, 3.0, -3.0, inf, -inf, nan};
  const auto same = [](double own, long double right) {
    return std::isnan(own) ? std::isnan(right)
                           : std::fabs(own - static_cast<double>(right)) <= 1e-15 &&
                                 std::signbit(own) == std::signbit(right);
  };
  const auto inexact = [&](double own, long double right) {
    return own == static_cast<double>(right) || same(own, right);
  };
  for (const double x : odd) {
    const long double X = x;
    for (const Case& c :
         {Case{"exp", exact::exp, std::exp, 0, 0}, Case{"expm1", exact::expm1, std::expm1, 0, 0},
          Case{"exp2", exact::exp2, std::exp2, 0, 0}, Case{"log", exact::log, std::log, 0, 0, 1.0},
          Case{"log2", exact::log2, std::log2, 0, 0}, Case{"log10", exact::log10, std::log10, 0, 0},
          Case{"log1p", exact::log1p, std::log1p, 0, 0}, Case{"tanh", exact::tanh, std::tanh, 0, 0},
          Case{"sin", exact::sin, std::sin, 0, 0}, Case{"cos", exact::cos, std::cos, 0, 0},
          Case{"tan", exact::tan, std::tan, 0, 0}, Case{"asin", exact::asin, std::asin, 0, 0},
          Case{"acos", exact::acos, std::acos, 0, 0}, Case{"atan", exact::atan, std::atan, 0, 0}})
      EXPECT_TRUE(inexact(c.own(x), c.wide(X))) << c.name << " of " << x << ": " << c.own(x);
    for (const double y : odd) {
      const long double Y = y;
      EXPECT_TRUE(inexact(exact::pow(x, y), std::pow(X, Y)))
          << x << " to the " << y << ": " << exact::pow(x, y);
      EXPECT_TRUE(inexact(exact::atan2(y, x), std::atan2(Y, X)))
          << y << " over " << x << ": " << exact::atan2(y, x);
      EXPECT_TRUE(inexact(exact::hypot(x, y), std::hypot(X, Y)))
          << x << ", " << y << ": " << exact::hypot(x, y);
    }
  }
  EXPECT_EQ(exact::exp(1000.0), inf);
  EXPECT_EQ(exact::exp(-1000.0), 0.0);
  EXPECT_EQ(exact::exp(-745.0), 5e-324);
  EXPECT_EQ(exact::log(5e-324), static_cast<double>(std::log(0x1p-1074L)));
}

// libm.cpp stands before the C library: without it the two differ in one of hundreds.
TEST(ExactFunctionsOfTwo, ArePutInPlaceOfTheLibrarys) {
  for (std::uint32_t i = 0; i < 20000; ++i) {
    volatile double x = 0.01 + 30.0 * uniform(3, Stream::test, i);
    ASSERT_EQ(std::exp(x), exact::exp(x));
    ASSERT_EQ(std::pow(x, 1.7), exact::pow(x, 1.7));
    ASSERT_EQ(std::atan2(x, 2.0), exact::atan2(x, 2.0));
  }
}

}  // namespace
}  // namespace phy
