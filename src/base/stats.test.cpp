#include "base/stats.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace phy {
namespace {

TEST(StudentT, AgreesWithPrintedTables) {  // Abramowitz & Stegun, table 26.10: three decimals
  const std::array<std::pair<std::size_t, double>, 10> table = {{{1, 12.706},
                                                                 {2, 4.303},
                                                                 {3, 3.182},
                                                                 {4, 2.776},
                                                                 {5, 2.571},
                                                                 {10, 2.228},
                                                                 {15, 2.131},
                                                                 {30, 2.042},
                                                                 {60, 2.000},
                                                                 {120, 1.980}}};
  for (const auto& [degrees, t] : table) EXPECT_NEAR(student_t_95(degrees), t, 5.1e-4) << degrees;
}

TEST(StudentT, ClosedFormsForOneTwoAndFourDegrees) {
  EXPECT_NEAR(student_t_95(1), std::tan(0.475 * 3.14159265358979323846), 1e-12);  // Cauchy distribution
  EXPECT_NEAR(student_t_95(2), 0.95 * std::sqrt(2.0 / (1.0 - 0.95 * 0.95)), 1e-12);
  const double t = student_t_95(4), s = t / std::sqrt(4.0 + t * t);  // P = s + s (1 - s^2) / 2
  EXPECT_NEAR(s + 0.5 * s * (1.0 - s * s), 0.95, 1e-14);
}

TEST(StudentT, FallsSmoothlyToTheNormalValue) {
  for (std::size_t n = 2; n < 300; ++n) EXPECT_LT(student_t_95(n), student_t_95(n - 1)) << n;
  const double below = student_t_95(99) - student_t_95(100), above = student_t_95(100) - student_t_95(101);
  EXPECT_NEAR(above / below, 0.98, 1e-3);  // differences fall like 1/n^2
  EXPECT_NEAR(student_t_95(100000000), 1.959963984540054, 1e-7);
  EXPECT_TRUE(std::isnan(student_t_95(0)));
}

TEST(Summarise, ByHand) {  // 2 4 4 4 5 5 7 9: mean 5, squares 32
  const std::vector<double> v = {2, 4, 4, 4, 5, 5, 7, 9};
  const Summary s = summarise(v);
  EXPECT_EQ(s.n, 8u);
  EXPECT_DOUBLE_EQ(s.mean, 5.0);
  EXPECT_DOUBLE_EQ(s.sd, std::sqrt(32.0 / 7.0));
  EXPECT_NEAR(s.half_width, 2.364624 * std::sqrt(32.0 / 7.0 / 8.0), 1e-6);
}

TEST(Summarise, SmallAndEqualSamples) {
  EXPECT_TRUE(std::isnan(summarise({}).mean));
  const Summary one = summarise(std::array{3.0});
  EXPECT_EQ(one.mean, 3.0);
  EXPECT_TRUE(std::isnan(one.sd));
  EXPECT_TRUE(std::isnan(one.half_width));
  const Summary equal = summarise(std::vector<double>(7, 0.1));
  EXPECT_EQ(equal.mean, 0.1);
  EXPECT_EQ(equal.sd, 0.0);
}

TEST(FitLine, ByHand) {  // x 1 2 3 4, y 2 4 5 8: Sxx 5, Sxy 9.5, Syy 18.75, residual sum 0.7
  const LineFit f = fit_line(std::array{1.0, 2.0, 3.0, 4.0}, std::array{2.0, 4.0, 5.0, 8.0});
  EXPECT_DOUBLE_EQ(f.slope, 1.9);
  EXPECT_NEAR(f.intercept, 0.0, 1e-14);
  EXPECT_NEAR(f.R2, 1.0 - 0.7 / 18.75, 1e-14);
  EXPECT_NEAR(f.slope_se, std::sqrt(0.35 / 5.0), 1e-14);
  EXPECT_NEAR(f.intercept_se, std::sqrt(0.35 * (0.25 + 6.25 / 5.0)), 1e-14);
}

TEST(FitLine, OffsetsDoNotSpoilTheSlope) {
  std::vector<double> x, y;
  for (int i = 0; i < 50; ++i) x.push_back(1e6 + i), y.push_back(-1e9 + 3.0 * i);
  const LineFit f = fit_line(x, y);
  EXPECT_NEAR(f.slope, 3.0, 1e-9);
  EXPECT_NEAR(f.R2, 1.0, 1e-12);
}

TEST(FitLine, WhatCannotBeFittedIsNaN) {
  EXPECT_TRUE(std::isnan(fit_line({}, {}).slope));
  EXPECT_TRUE(std::isnan(fit_line(std::array{1.0}, std::array{1.0}).slope));
  EXPECT_TRUE(
      std::isnan(fit_line(std::vector<double>(7, 0.1), std::vector<double>{1, 2, 3, 4, 5, 6, 7}).slope));
  const LineFit two = fit_line(std::array{0.0, 1.0}, std::array{0.0, 2.0});
  EXPECT_DOUBLE_EQ(two.slope, 2.0);
  EXPECT_TRUE(std::isnan(two.slope_se));
  EXPECT_EQ(fit_line(std::array{0.0, 1.0, 2.0}, std::array{5.0, 5.0, 5.0}).R2, 1.0);
}

}  // namespace
}  // namespace phy
