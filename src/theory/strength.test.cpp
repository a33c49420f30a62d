// Jaeger's plane of weakness, Hoek-Brown, and the laws with variable constants.
#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "theory/hoek_brown.hpp"
#include "theory/jaeger.hpp"

namespace phy::theory {
namespace {

double degrees(double radians) { return radians * 180.0 / pi; }

// Golden section on weak_plane_sigma_1 alone.
double searched_weakest(const Coulomb& plane, double sigma_3) {
  double lo = plane.friction + 1e-3;
  double hi = 90.0 - 1e-3;
  const double g = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int i = 0; i < 120; ++i) {
    const double a = hi - g * (hi - lo);
    const double b = lo + g * (hi - lo);
    if (weak_plane_sigma_1(plane, a, sigma_3) < weak_plane_sigma_1(plane, b, sigma_3))
      hi = b;
    else
      lo = a;
  }
  return 0.5 * (lo + hi);
}

TEST(Jaeger, MinimumStandsAt45PlusHalfTheFrictionAngle) {
  for (double friction : {0.0, 10.0, 21.8014, 35.0})
    for (double sigma_3 : {0.0, 5e6, 20e6}) {
      const Coulomb plane{30e6, friction};
      const StrengthMinimum closed = weak_plane_minimum(plane, sigma_3);
      const double searched = searched_weakest(plane, sigma_3);
      EXPECT_NEAR(searched, closed.theta, 1e-5);  // a flat minimum: half the digits of the value
      EXPECT_NEAR(weak_plane_sigma_1(plane, searched, sigma_3) / closed.sigma_1, 1.0, 1e-12);
      EXPECT_NEAR(weak_plane_sigma_1(plane, closed.theta, sigma_3) / closed.sigma_1, 1.0, 1e-12);
    }
}

TEST(Jaeger, MinimumByHand) {  // c = 30 MPa, mu = 0.4: 2 c (sqrt(1 + mu^2) + mu) = 88.622 MPa at 55.9 degrees
  const Coulomb plane{30e6, degrees(std::atan(0.4))};
  EXPECT_NEAR(weak_plane_minimum(plane, 0.0).sigma_1, 60e6 * (std::sqrt(1.16) + 0.4), 1.0);
  EXPECT_NEAR(weak_plane_minimum(plane, 0.0).theta, 55.9, 0.01);
}

// On the plane at the predicted sigma_1, shear stress equals shear strength: Mohr's circle, not the formula.
TEST(Jaeger, ShearStressReachesTheStrengthOfThePlane) {
  const Coulomb plane{12e6, 28.0};
  for (double theta : {32.0, 45.0, 59.0, 80.0, 121.0})
    for (double sigma_3 : {0.0, 7e6}) {
      const double s1 = weak_plane_sigma_1(plane, theta, sigma_3);
      const double t = theta * pi / 180.0;
      const double sigma_n = s1 * std::cos(t) * std::cos(t) + sigma_3 * std::sin(t) * std::sin(t);
      const double tau = std::abs((s1 - sigma_3) * std::sin(t) * std::cos(t));
      EXPECT_NEAR(tau / (plane.cohesion + sigma_n * std::tan(28.0 * pi / 180.0)), 1.0, 1e-12) << theta;
    }
}

TEST(Jaeger, MatrixCapsBothShoulders) {
  const Coulomb plane{12e6, 28.0};
  const double matrix = coulomb_sigma_1({30e6, 40.0}, 5e6);
  EXPECT_EQ(jaeger_sigma_1(plane, matrix, 0.0, 5e6), matrix);
  EXPECT_EQ(jaeger_sigma_1(plane, matrix, 20.0, 5e6), matrix);
  EXPECT_EQ(jaeger_sigma_1(plane, matrix, 90.0, 5e6), matrix);
  EXPECT_TRUE(std::isinf(weak_plane_sigma_1(plane, 28.0 - 1e-9, 5e6)));
  const SlipRange range = slip_range(plane, matrix, 5e6);
  ASSERT_TRUE(range.any);
  EXPECT_NEAR(weak_plane_sigma_1(plane, range.from, 5e6) / matrix, 1.0, 1e-11);
  EXPECT_NEAR(weak_plane_sigma_1(plane, range.to, 5e6) / matrix, 1.0, 1e-11);
  EXPECT_LT(jaeger_sigma_1(plane, matrix, 0.5 * (range.from + range.to), 5e6), matrix);
  EXPECT_FALSE(slip_range(plane, weak_plane_minimum(plane, 5e6).sigma_1 * 0.999, 5e6).any);
  EXPECT_FALSE(slip_range(plane, 5e6, 5e6).any);
}

TEST(HoekBrown, UnconfinedStrengthAndTensileEnd) {
  EXPECT_DOUBLE_EQ(hoek_brown_sigma_1(90e6, 10.0, 0.0), 90e6);
  EXPECT_DOUBLE_EQ(hoek_brown_sigma_1(90e6, 10.0, -9e6), -9e6);
  EXPECT_NEAR(hoek_brown_sigma_1(90e6, 10.0, 27e6), 27e6 + 90e6 * 2.0, 1e-6);  // sqrt(10*27/90 + 1) = 2
  EXPECT_THROW(hoek_brown_sigma_1(90e6, 10.0, -10e6), InternalError);
}

TEST(HoekBrown, AnisotropyParameterScalesTheSlope) {
  EXPECT_DOUBLE_EQ(saroglou_tsiambaos_sigma_1(60e6, 1.0, 10.0, 8e6), hoek_brown_sigma_1(60e6, 10.0, 8e6));
  const double h = 1.0;  // initial slope d sigma_1 / d sigma_3 = 1 + k m_i / 2
  const double slope = (saroglou_tsiambaos_sigma_1(60e6, 0.6, 10.0, h) - 60e6) / h;
  EXPECT_NEAR(slope, 1.0 + 0.6 * 10.0 / 2.0, 1e-6);
}

}  // namespace
}  // namespace phy::theory
