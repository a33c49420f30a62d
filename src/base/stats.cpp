#include "base/stats.hpp"
#include "base/nan.hpp"

// Boost knows of C's functions on POSIX systems alone, and elsewhere sums series of its own.
#ifndef BOOST_HAS_LOG1P
#define BOOST_HAS_LOG1P
#endif
#ifndef BOOST_HAS_EXPM1
#define BOOST_HAS_EXPM1
#endif

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#ifndef __SSE2__  // where Boost sums inside the gamma function in another order
#include <boost/math/special_functions/detail/lanczos_sse2.hpp>
#endif

namespace phy {
namespace {

/// Mean, summed from the first value on, so that equal values have exactly their own mean.
double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double v : values) sum += v - values.front();
  return values.front() + sum / static_cast<double>(values.size());
}

// Boost would reckon with long double, which is another number on every kind of processor.
using Double = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using ChiSquared = boost::math::chi_squared_distribution<double, Double>;
using StudentsT = boost::math::students_t_distribution<double, Double>;

/// Unknown when this is compiled: a compiler evaluates functions of what it knows by itself, and its last
/// bits are not those of exact_functions.hpp.
double at_run_time(double probability) {
  const volatile double hidden = probability;
  return hidden;
}

}  // namespace

double chi_square_99(std::size_t degrees) {
  // What a sum of so many squares of errors exceeds once in a hundred times.
  return boost::math::quantile(ChiSquared(static_cast<double>(degrees)), at_run_time(0.99));
}

double student_t_95(std::size_t degrees) {
  if (degrees == 0) return nan;
  return boost::math::quantile(StudentsT(static_cast<double>(degrees)), at_run_time(0.975));
}

double student_t_chance(double t, double degrees) {
  return 2.0 * boost::math::cdf(boost::math::complement(StudentsT(degrees), t));
}

double student_t_one_sided_95(double degrees) {
  return boost::math::quantile(StudentsT(degrees), at_run_time(0.95));
}

Summary summarise(std::span<const double> values) {
  Summary s;
  s.n = values.size();
  if (s.n == 0) return s;
  s.mean = mean_of(values);
  if (s.n == 1) return s;
  double squares = 0.0;
  for (const double v : values) squares += (v - s.mean) * (v - s.mean);
  s.sd = std::sqrt(squares / static_cast<double>(s.n - 1));
  // Of the mean; with few values the normal quantile would be too narrow.
  s.half_width = student_t_95(s.n - 1) * s.sd / std::sqrt(static_cast<double>(s.n));
  return s;
}

LineFit fit_line(std::span<const double> x, std::span<const double> y) {
  LineFit fit;
  fit.n = std::min(x.size(), y.size());
  if (fit.n == 0) return fit;
  x = x.first(fit.n), y = y.first(fit.n);
  const double mx = mean_of(x), my = mean_of(y), n = static_cast<double>(fit.n);
  double xx = 0.0, xy = 0.0, yy = 0.0, residuals = 0.0;
  for (std::size_t i = 0; i < fit.n; ++i) {
    // About the means: sums of squares of stresses in Pa would lose their digits.
    xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my), yy += (y[i] - my) * (y[i] - my);
  }
  if (!(xx > 0.0)) return fit;
  fit.slope = xy / xx;
  fit.intercept = my - fit.slope * mx;
  for (std::size_t i = 0; i < fit.n; ++i) {
    const double r = (y[i] - my) - fit.slope * (x[i] - mx);
    residuals += r * r;
  }
  // A level line fits level values entirely.
  fit.R2 = yy > 0.0 ? 1.0 - residuals / yy : 1.0;
  // Two points lie on their line and say nothing of errors.
  if (fit.n < 3) return fit;
  const double variance = residuals / (n - 2.0);
  fit.slope_se = std::sqrt(variance / xx);
  fit.intercept_se = std::sqrt(variance * (1.0 / n + mx * mx / xx));
  return fit;
}

}  // namespace phy
