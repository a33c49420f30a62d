#include "base/least_squares.hpp"

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>

namespace phy {
namespace {

/// In the form of Eigen's Levenberg-Marquardt.
struct Functor {
  using Scalar = double;
  const Misfits& misfits;
  int values() const { return static_cast<int>(misfits.n); }
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const { return misfits.at(x, r), 0; }
  int df(const Eigen::VectorXd& x, Eigen::MatrixXd& J) const { return misfits.slopes(x, J), 0; }
};

}  // namespace

LinearFit linear_least_squares(const Eigen::MatrixXd& A, const Eigen::VectorXd& b) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  return {qr.solve(b), qr.rank()};
}

Eigen::MatrixXd inverse_of_squares(const Eigen::MatrixXd& A) { return (A.transpose() * A).inverse(); }

Eigen::VectorXd least_squares(const Misfits& misfits, Eigen::VectorXd start,
                              const LeastSquaresLimits& limits) {
  Functor functor{misfits};
  Eigen::LevenbergMarquardt<Functor> solver(functor);
  solver.parameters.maxfev = limits.evaluations;
  solver.parameters.factor = limits.first_step;
  if (limits.tolerance > 0.0) solver.parameters.ftol = solver.parameters.xtol = limits.tolerance;
  solver.minimize(start);
  return start;
}

}  // namespace phy
