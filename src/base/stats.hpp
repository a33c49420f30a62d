// Small statistics for reported numbers. They decide no trajectory, so the C library may be used.
#pragma once
#include <cstddef>
#include <span>

#include "base/nan.hpp"

namespace phy {

/// A sample: mean, scatter, and how well the mean is known. NaN where the sample is too small to tell.
struct Summary {
  std::size_t n = 0;
  double mean = nan;
  /// Sample standard deviation (divisor n - 1); n >= 2.
  double sd = nan;
  /// The 95 % interval of the mean is mean +- half_width; n >= 2.
  double half_width = nan;
};

/// Mean, standard deviation and 95 % interval of the mean (Student) of normally distributed values.
Summary summarise(std::span<const double> values);

/// 95 % of a normal distribution lie within so many standard deviations of its mean.
constexpr double z_95 = 1.959963984540054;

/// The value that chi-square of `degrees` >= 1 degrees of freedom exceeds with a probability of 1 %.
double chi_square_99(std::size_t degrees);

/// The value that |t| of `degrees` >= 1 degrees of freedom exceeds with a probability of 5 %. NaN for 0.
double student_t_95(std::size_t degrees);

/// The probability that |t| of `degrees` > 0 degrees of freedom exceeds `t` >= 0. Infinite degrees: normal.
double student_t_chance(double t, double degrees);

/// The value that t of `degrees` > 0 degrees of freedom exceeds with a probability of 5 %.
double student_t_one_sided_95(double degrees);

/// y = intercept + slope x by least squares. NaN where the points do not determine it.
struct LineFit {
  std::size_t n = 0;
  double slope = nan;
  double intercept = nan;
  /// Share of the variance of y explained; 1 if y is constant.
  double R2 = nan;
  /// Standard errors, if the residuals are independent; n >= 3.
  double slope_se = nan;
  double intercept_se = nan;
};

/// Fits the pairs x[i], y[i]; the longer list is cut to the length of the shorter.
LineFit fit_line(std::span<const double> x, std::span<const double> y);

}  // namespace phy
