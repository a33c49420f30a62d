// Nonlinear least squares by the method of Levenberg and Marquardt, as Eigen has it (after MINPACK). Compiled
// once for all who fit: its templates take ten seconds of a compiler's time.
#pragma once
#include <Eigen/Core>
#include <functional>

namespace phy {

/// The sum of the squares of these is to become least.
struct Misfits {
  Eigen::Index n = 0;  ///< at least as many as unknowns
  std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& misfits)> at;
  std::function<void(const Eigen::VectorXd& x, Eigen::MatrixXd& slopes)> slopes;  ///< d misfits / d x
};

/// Of a problem that has values(), operator()(x, misfits) and df(x, slopes), and outlives them.
template <class Problem>
Misfits misfits_of(const Problem& problem) {
  return {problem.values(), [&problem](const auto& x, auto& misfits) { problem(x, misfits); },
          [&problem](const auto& x, auto& slopes) { problem.df(x, slopes); }};
}
template <class Problem>
Misfits misfits_of(const Problem&& gone_too_soon) = delete;

/// When to end, and how to begin.
struct LeastSquaresLimits {
  int evaluations = 400;
  double tolerance = 0.0;     ///< relative, of the sum and of x; 0: the root of the spacing of doubles
  double first_step = 100.0;  ///< at most this times the size of the start, scaled by the slopes
};

/// The place of the minimum that lies downhill from `start`.
Eigen::VectorXd least_squares(const Misfits& misfits, Eigen::VectorXd start,
                              const LeastSquaresLimits& limits = {});

}  // namespace phy
