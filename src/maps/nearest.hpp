// The one search downhill of this room and of calibrations: where a problem in the form of Eigen's
// Levenberg-Marquardt lies nearest to a table. What is missed counts by softened(), so that a value which
// cannot be met does not decide for the others; that has several minima, so the best of many starts go down.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/least_squares.hpp"

namespace phy::maps {

/// Its square is that of x where x is small and a multiple of |x| where it is large (Charbonnier's).
inline double softened(double x) {
  constexpr double edge = 2.0;
  return std::copysign(edge * std::sqrt(2.0 * (std::hypot(1.0, x / edge) - 1.0)), x);
}

/// From the six best of `starts`. `problem`: its at(x) is the sum of squares, its clamped(x) the nearest
/// admissible point.
template <class Problem>
Eigen::VectorXd nearest(const Problem& problem, const std::vector<Eigen::VectorXd>& starts) {
  constexpr std::size_t n_starts = 6;
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t k = 0; k < starts.size(); ++k) order.emplace_back(problem.at(starts[k]), k);
  std::sort(order.begin(), order.end());
  order.resize(std::min(order.size(), n_starts));
  Eigen::VectorXd best = starts[order.front().second];
  for (const auto& [value, k] : order) {
    const Eigen::VectorXd x = problem.clamped(least_squares(misfits_of(problem), starts[k], {60, 1e-4, 1.0}));
    if (problem.at(x) < problem.at(best)) best = x;
  }
  return best;
}

}  // namespace phy::maps
