#include "base/least_squares.hpp"

#include <gtest/gtest.h>

namespace phy {
namespace {

/// Rosenbrock's valley, as the sum of two squares: the minimum is 0 at (1, 1).
struct Valley {
  int values() const { return 2; }
  void operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    r << 10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0];
  }
  void df(const Eigen::VectorXd& x, Eigen::MatrixXd& J) const { J << -20.0 * x[0], 10.0, -1.0, 0.0; }
};

TEST(LeastSquares, FollowsACurvedValley) {
  const Valley valley;
  const Eigen::VectorXd x = least_squares(misfits_of(valley), Eigen::Vector2d(-1.2, 1.0));
  EXPECT_NEAR(x[0], 1.0, 1e-9);
  EXPECT_NEAR(x[1], 1.0, 1e-9);
}

TEST(LeastSquares, EndsWhereItIsTold) {
  const Valley valley;
  int asked = 0;
  Misfits counted = misfits_of(valley);
  counted.at = [&](const Eigen::VectorXd& x, Eigen::VectorXd& r) { ++asked, valley(x, r); };
  const Eigen::VectorXd start = Eigen::Vector2d(-1.2, 1.0);
  const Eigen::VectorXd x = least_squares(counted, start, {4, 1e-3, 1.0});
  EXPECT_LE(asked, 5) << "four and the start";
  EXPECT_GT((x - Eigen::Vector2d(1.0, 1.0)).norm(), 0.1) << "on the way";
  Eigen::VectorXd before(2), after(2);
  valley(start, before), valley(x, after);
  EXPECT_LT(after.norm(), before.norm());
}

// A line through points that do not lie on one: the normal equations by hand.
struct Line {
  int values() const { return 3; }
  void operator()(const Eigen::VectorXd& x, Eigen::VectorXd& r) const {
    for (int i = 0; i < 3; ++i) r[i] = x[0] + x[1] * i - i * i;
  }
  void df(const Eigen::VectorXd&, Eigen::MatrixXd& J) const {
    for (int i = 0; i < 3; ++i) J(i, 0) = 1.0, J(i, 1) = i;
  }
};

TEST(LeastSquares, OfALineAreThoseOfTheNormalEquations) {
  const Line line;
  const Eigen::VectorXd x = least_squares(misfits_of(line), Eigen::Vector2d(5.0, -7.0));
  EXPECT_NEAR(x[0], -1.0 / 3.0, 1e-8);
  EXPECT_NEAR(x[1], 2.0, 1e-8);
}

TEST(LinearLeastSquares, OfALineAreThoseOfTheNormalEquations) {
  const Eigen::MatrixXd A = Eigen::MatrixXd{{1.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}};
  const LinearFit fit = linear_least_squares(A, Eigen::Vector3d(0.0, 1.0, 4.0));
  EXPECT_NEAR(fit.x[0], -1.0 / 3.0, 1e-14);
  EXPECT_NEAR(fit.x[1], 2.0, 1e-14);
  EXPECT_EQ(fit.rank, 2);
  const Eigen::MatrixXd inverse = inverse_of_squares(A);  // of {{3, 3}, {3, 5}}
  EXPECT_NEAR(inverse(0, 0), 5.0 / 6.0, 1e-14);
  EXPECT_NEAR(inverse(0, 1), -0.5, 1e-14);
  EXPECT_NEAR(inverse(1, 1), 0.5, 1e-14);
}

TEST(LinearLeastSquares, ColumnsAlikeHaveNoFullRank) {
  const Eigen::MatrixXd A = Eigen::MatrixXd{{1.0, 2.0}, {2.0, 4.0}, {3.0, 6.0}};
  const LinearFit fit = linear_least_squares(A, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(fit.rank, 1);
  EXPECT_NEAR((A * fit.x - Eigen::Vector3d(1.0, 2.0, 3.0)).norm(), 0.0, 1e-13);
}

}  // namespace
}  // namespace phy
