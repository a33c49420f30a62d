// Small statistics for reported numbers. They decide no trajectory, so the C library may be used.
#pragma once
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace phy {

/// y = intercept + slope x by least squares.
struct LineFit {
  double slope = std::numeric_limits<double>::quiet_NaN();
  double intercept = std::numeric_limits<double>::quiet_NaN();
  double R2 = std::numeric_limits<double>::quiet_NaN();  ///< share of the variance of y explained
};
inline LineFit fit_line(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  double mx = 0.0, my = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) mx += x[i] / n, my += y[i] / n;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my), yy += (y[i] - my) * (y[i] - my);
  }
  LineFit fit;
  if (!(xx > 0.0)) return fit;
  fit.slope = xy / xx;
  fit.intercept = my - fit.slope * mx;
  fit.R2 = yy > 0.0 ? xy * xy / (xx * yy) : 1.0;
  return fit;
}

}  // namespace phy
