#include "base/stats.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace phy {
namespace {

constexpr double z_975 = 1.959963984540054;  // standard normal distribution: P(|z| > z_975) = 5 %
constexpr std::size_t exact_up_to = 100;     // beyond, four terms of the series err by less than 1e-9

/// P(|t| <= sqrt(degrees) tan angle): finite sums, Abramowitz & Stegun 26.7.3 (odd), 26.7.4 (even).
double probability_within(std::size_t degrees, double angle) {
  const bool odd = degrees % 2 == 1;
  const double cosine = std::cos(angle);
  double sum = 0.0, term = odd ? cosine : 1.0;
  for (std::size_t k = odd ? 1 : 0; k + 2 <= degrees; k += 2) {
    sum += term;
    term *= cosine * cosine * static_cast<double>(k + 1) / static_cast<double>(k + 2);
  }
  sum *= std::sin(angle);
  return odd ? 2.0 / std::numbers::pi * (angle + sum) : sum;
}

double exact_t(std::size_t degrees) {
  double low = 0.0, high = 0.5 * std::numbers::pi;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (probability_within(degrees, middle) < 0.95 ? low : high) = middle;
  }
  return std::sqrt(static_cast<double>(degrees)) * std::tan(0.5 * (low + high));
}

/// Abramowitz & Stegun 26.7.5.
double series_t(std::size_t degrees) {
  const double n = static_cast<double>(degrees), z = z_975, s = z * z;
  const double g1 = z * (s + 1.0) / 4.0;
  const double g2 = z * ((5.0 * s + 16.0) * s + 3.0) / 96.0;
  const double g3 = z * (((3.0 * s + 19.0) * s + 17.0) * s - 15.0) / 384.0;
  const double g4 = z * ((((79.0 * s + 776.0) * s + 1482.0) * s - 1920.0) * s - 945.0) / 92160.0;
  return z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
}

/// Mean, summed from the first value on, so that equal values have exactly their own mean.
double mean_of(std::span<const double> values) {
  double sum = 0.0;
  for (const double v : values) sum += v - values.front();
  return values.front() + sum / static_cast<double>(values.size());
}

}  // namespace

double student_t_95(std::size_t degrees) {
  if (degrees == 0) return std::numeric_limits<double>::quiet_NaN();
  return degrees <= exact_up_to ? exact_t(degrees) : series_t(degrees);
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
    xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my), yy += (y[i] - my) * (y[i] - my);
  }
  if (!(xx > 0.0)) return fit;
  fit.slope = xy / xx;
  fit.intercept = my - fit.slope * mx;
  for (std::size_t i = 0; i < fit.n; ++i) {
    const double r = (y[i] - my) - fit.slope * (x[i] - mx);
    residuals += r * r;
  }
  fit.R2 = yy > 0.0 ? 1.0 - residuals / yy : 1.0;
  if (fit.n < 3) return fit;
  const double variance = residuals / (n - 2.0);
  fit.slope_se = std::sqrt(variance / xx);
  fit.intercept_se = std::sqrt(variance * (1.0 / n + mx * mx / xx));
  return fit;
}

}  // namespace phy
