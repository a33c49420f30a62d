// Small statistics for reported numbers. They decide no trajectory, so the C library may be used.
#pragma once
#include <cstddef>
#include <limits>
#include <span>

namespace phy {

/// A sample: mean, scatter, and how well the mean is known. NaN where the sample is too small to tell.
struct Summary {
  std::size_t n = 0;
  double mean = std::numeric_limits<double>::quiet_NaN();
  /// Sample standard deviation (divisor n - 1); n >= 2.
  double sd = std::numeric_limits<double>::quiet_NaN();
  /// The 95 % interval of the mean is mean +- half_width; n >= 2.
  double half_width = std::numeric_limits<double>::quiet_NaN();
};

/// Mean, standard deviation and 95 % interval of the mean (Student) of normally distributed values.
Summary summarise(std::span<const double> values);

/// The value that |t| of `degrees` >= 1 degrees of freedom exceeds with a probability of 5 %; relative error
/// < 1e-9. NaN for 0. Source: Abramowitz & Stegun 1964, 26.7.3 and 26.7.4 (exact sums), 26.7.5 (series for
/// large degrees).
double student_t_95(std::size_t degrees);

/// y = intercept + slope x by least squares. NaN where the points do not determine it.
struct LineFit {
  std::size_t n = 0;
  double slope = std::numeric_limits<double>::quiet_NaN();
  double intercept = std::numeric_limits<double>::quiet_NaN();
  /// Share of the variance of y explained; 1 if y is constant.
  double R2 = std::numeric_limits<double>::quiet_NaN();
  /// Standard errors, if the residuals are independent; n >= 3.
  double slope_se = std::numeric_limits<double>::quiet_NaN();
  double intercept_se = std::numeric_limits<double>::quiet_NaN();
};

/// Fits the pairs x[i], y[i]; the longer list is cut to the length of the shorter.
LineFit fit_line(std::span<const double> x, std::span<const double> y);

}  // namespace phy
