// Least squares: linear ones by QR with pivoted columns, nonlinear ones by the method of Levenberg and
// Marquardt, as Eigen has both (the latter after MINPACK). Compiled once for all who fit: these templates
// take ten seconds of a compiler's time in every file that names them.
#pragma once
#include <Eigen/Core>
#include <functional>

namespace phy {

/// The x for which |A x - b| is least.
struct LinearFit {
  Eigen::VectorXd x;
  Eigen::Index rank;  ///< of A; less than it has columns: x is one of many
};
LinearFit linear_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b);

/// (A^T A)^-1: times the variance of b, the covariance of that x. A has full rank.
Eigen::MatrixXd inverse_of_squares(const Eigen::MatrixXd& A);

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
