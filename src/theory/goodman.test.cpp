// Eq. 1 against an independent re-derivation: the tractions on the inclined plane, the movements they cause,
// and the movements resolved on the load axis, all in vectors and without the formula.
#include "theory/goodman.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/exact_math.hpp"
#include "base/vec.hpp"
#include "theory/angles.hpp"

namespace phy::theory {
namespace {

const JointedRock example{45e9, 6406e9 * 0.005, 1666e9 * 0.005, 0.24};

// Axial and lateral strain (shortening positive) under a unit axial stress, summed from rock and joints.
Vec2 strain_from_tractions(const JointedRock& rock, double theta) {
  const double t = theta * pi / 180.0;
  const Vec2 normal{-std::sin(t), std::cos(t)};
  const Vec2 along{std::cos(t), std::sin(t)};
  const Vec2 traction{0.0, normal.y};  // sigma . n for sigma_yy = 1
  const Vec2 jump =
      (dot(traction, normal) / rock.K_n_delta) * normal + (dot(traction, along) / rock.K_s_delta) * along;
  return {-rock.nu / rock.E + jump.x * normal.x, 1.0 / rock.E + jump.y * normal.y};
}

TEST(Goodman, AgreesWithTractionsOnThePlane) {
  for (double theta = 0.0; theta <= 90.0; theta += 7.5) {
    const Vec2 eps = strain_from_tractions(example, theta);
    EXPECT_NEAR(goodman_E(example, theta) * eps.y, 1.0, 1e-12) << theta;
    EXPECT_NEAR(goodman_nu(example, theta), -eps.x / eps.y, 1e-12) << theta;
  }
}

TEST(Goodman, LimitsOfTheCurve) {
  const JointedRock& r = example;
  EXPECT_DOUBLE_EQ(goodman_E(r, 90.0), r.E);
  EXPECT_NEAR(goodman_E(r, 0.0) * (1.0 / r.E + 1.0 / r.K_n_delta), 1.0, 1e-14);
  EXPECT_NEAR(goodman_E(r, 45.0) * (1.0 / r.E + 0.25 / r.K_n_delta + 0.25 / r.K_s_delta), 1.0, 1e-14);
  EXPECT_NEAR(goodman_nu(r, 90.0), r.nu, 1e-14);
  EXPECT_DOUBLE_EQ(goodman_E(r, 30.0), goodman_E(r, 150.0));
}

TEST(Goodman, RigidPlanesLeaveTheIntactRock) {
  const double inf = std::numeric_limits<double>::infinity();
  const JointedRock intact{45e9, inf, inf, 0.24};
  for (double theta : {0.0, 33.0, 90.0}) {
    EXPECT_DOUBLE_EQ(goodman_E(intact, theta), 45e9);
    EXPECT_DOUBLE_EQ(goodman_nu(intact, theta), 0.24);
  }
}

// The minimum found by a search that knows only goodman_E.
double searched_minimum(const JointedRock& rock) {
  double lo = 0.0;
  double hi = 90.0;
  for (int i = 0; i < 200; ++i) {
    const double a = lo + (hi - lo) / 3.0;
    const double b = hi - (hi - lo) / 3.0;
    (goodman_E(rock, a) < goodman_E(rock, b) ? hi : lo) = goodman_E(rock, a) < goodman_E(rock, b) ? b : a;
  }
  return 0.5 * (lo + hi);
}

TEST(Goodman, ShoulderHasItsMinimumWhereTheFormulaSays) {
  const CurveShape shape = goodman_shape(example);
  EXPECT_EQ(shape.type, CurveType::shoulder);
  EXPECT_NEAR(shape.theta_star, 34.7, 0.05);
  EXPECT_NEAR(shape.theta_star, searched_minimum(example), 1e-5);
  EXPECT_NEAR(goodman_E(example, shape.theta_star) / shape.E_min, 1.0, 1e-13);
  EXPECT_LT(shape.E_min, shape.E_0);
}

TEST(Goodman, TypeSwitchesAtTwiceTheShearStiffness) {
  JointedRock rock{40e9, 20e9, 10e9, 0.2};
  EXPECT_EQ(goodman_shape(rock).type, CurveType::incremental);
  EXPECT_DOUBLE_EQ(goodman_shape(rock).E_min, goodman_E(rock, 0.0));
  for (double theta = 0.0; theta < 90.0; theta += 1.0)
    EXPECT_LE(goodman_E(rock, theta), goodman_E(rock, theta + 1.0));
  rock.K_n_delta *= 1.001;
  EXPECT_EQ(goodman_shape(rock).type, CurveType::shoulder);
  EXPECT_GT(goodman_shape(rock).theta_star, 0.0);
}

TEST(Goodman, PlanesThatOnlySlipAreWeakestAt45) {
  const JointedRock rock{40e9, std::numeric_limits<double>::infinity(), 10e9, 0.2};
  EXPECT_NEAR(goodman_shape(rock).theta_star, 45.0, 1e-12);
}

TEST(Angles, BetaIsTheComplement) {
  EXPECT_EQ(beta_from_theta(30.0), 60.0);
  EXPECT_EQ(beta_from_theta(beta_from_theta(12.5)), 12.5);
}

TEST(Angles, FoldingKeepsWhatAnAxialTestSees) {
  EXPECT_EQ(folded_theta(150.0), 30.0);
  EXPECT_EQ(folded_theta(-30.0), 30.0);
  EXPECT_EQ(folded_theta(180.0), 0.0);
  EXPECT_EQ(folded_theta(270.0), 90.0);
  EXPECT_EQ(folded_theta(90.0), 90.0);
}

}  // namespace
}  // namespace phy::theory
