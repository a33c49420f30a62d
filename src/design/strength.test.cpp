#include "design/strength.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/rng.hpp"
#include "theory/fabric.hpp"
#include "theory/hoek_brown.hpp"

namespace phy::design {
namespace {

using enum Constant;

constexpr double per_mille = 1e-3;
const std::vector<double> angles = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0};
const std::vector<double> three = {0.0, 5e6, 10e6};

template <class Sigma1>
StrengthPoints points_of(const std::vector<double>& stresses, const Sigma1& sigma_1) {
  StrengthPoints points;
  for (const double theta : angles)
    for (const double s : stresses) points.push_back({theta, sigma_1(theta, s), s});
  return points;
}

// tau on the plane reaches its strength, from Mohr's circle: not the formula of theory/jaeger.hpp.
double slip_by_bisection(double c_j, double phi_j, double theta, double s3) {
  const double t = theta * 3.14159265358979324 / 180.0, mu = std::tan(phi_j * 3.14159265358979324 / 180.0);
  const auto slips = [&](double s1) {
    const double normal = s1 * std::cos(t) * std::cos(t) + s3 * std::sin(t) * std::sin(t);
    return (s1 - s3) * std::sin(t) * std::cos(t) >= c_j + mu * normal;
  };
  double low = s3, high = 1e12;
  if (!slips(high)) return 1e12;
  for (int i = 0; i < 200; ++i) (slips(0.5 * (low + high)) ? high : low) = 0.5 * (low + high);
  return high;
}
double breaks_at(double c, double phi, double s3) {
  const double s = std::sin(phi * 3.14159265358979324 / 180.0), N = (1.0 + s) / (1.0 - s);
  return N * s3 + 2.0 * c * std::sqrt(N);
}

TEST(UbiquitousJoint, FindsThePlaneAndTheRock) {
  for (const double phi_j : {12.0, 22.0, 33.0}) {
    SCOPED_TRACE(phi_j);
    const Fit fit = fit_ubiquitous_joint(points_of(three, [&](double theta, double s) {
      return std::min(slip_by_bisection(11e6, phi_j, theta, s), breaks_at(24e6, 37.0, s));
    }));
    ASSERT_TRUE(fit.ok()) << static_cast<int>(fit.refusal);
    EXPECT_NEAR(fit.value({c_j}) / 11e6, 1.0, per_mille);
    EXPECT_NEAR(fit.value({Constant::phi_j}) / phi_j, 1.0, per_mille);
    EXPECT_NEAR(fit.value({c}) / 24e6, 1.0, per_mille);
    EXPECT_NEAR(fit.value({phi}) / 37.0, 1.0, per_mille);
    EXPECT_LT(fit.error, 1e-6);
  }
}

/// Error of these constants, from Mohr's circle; without end where they are none.
double brute_error(const StrengthPoints& points, const std::array<double, 4>& at) {
  if (at[0] <= 0.0 || at[1] < 0.0 || at[1] > 60.0 || at[2] <= 0.0 || at[3] < 0.0 || at[3] > 60.0) return 1e9;
  double squares = 0.0;
  for (const StrengthPoint& p : points)
    squares += std::pow(std::log(std::min(slip_by_bisection(at[0], at[1], p.theta, p.sigma_3),
                                          breaks_at(at[2], at[3], p.sigma_3)) /
                                 p.ucs),
                        2);
  return std::sqrt(squares / static_cast<double>(points.size()));
}

/// The least error of a walk that tries random steps of all lengths about the best: no slopes, no branches.
double brute_least(const StrengthPoints& points, std::array<double, 4> best, std::uint32_t rock) {
  double least = brute_error(points, best);
  for (std::uint32_t k = 0; k < 4000; ++k) {
    const auto draw = [&](std::uint32_t j) { return 2.0 * uniform(rock, Stream::test, 9 * k + j) - 1.0; };
    const double length = std::pow(10.0, -2.0 + 2.0 * draw(4)) * 0.3;
    std::array<double, 4> at = best;
    for (std::uint32_t j = 0; j < 4; ++j)
      j % 2 == 0 ? at[j] *= std::exp(length * draw(j)) : at[j] += 30.0 * length * draw(j);
    if (const double error = brute_error(points, at); error < least) least = error, best = at;
  }
  return least;
}

TEST(UbiquitousJoint, OfANoisyRockMissesNoMoreThanASearchByBruteForce) {
  for (std::uint32_t rock = 0; rock < 6; ++rock) {
    SCOPED_TRACE(rock);
    std::uint32_t next = 100000;
    const StrengthPoints points = points_of(three, [&](double theta, double s) {
      const double sigma_1 = std::min(slip_by_bisection(11e6, 22.0, theta, s), breaks_at(24e6, 37.0, s));
      return sigma_1 * std::exp(0.5 * (uniform(rock, Stream::test, next++) - 0.5));
    });
    const Fit fit = fit_ubiquitous_joint(points);
    ASSERT_TRUE(fit.ok()) << word_of(fit.refusal);
    EXPECT_LE(fit.error, 1.01 * brute_least(points, {11e6, 22.0, 24e6, 37.0}, rock));
  }
}

TEST(HoekBrown, NeedsThreeStresses) {
  const auto sigma_1 = [](double, double s) { return theory::hoek_brown_sigma_1(90e6, 11.0, s); };
  EXPECT_EQ(fit_hoek_brown(points_of({0.0, 5e6}, sigma_1)).refusal, Refusal::too_few);
  // To predict a stress that is left out, two do.
  EXPECT_LT(left_out_error(strength_laws()[1], points_of(three, sigma_1)), 1e-5);
}

TEST(UbiquitousJoint, RefusesRockWithoutAPlane) {
  const Fit fit =
      fit_ubiquitous_joint(points_of(three, [](double, double s) { return breaks_at(24e6, 37.0, s); }));
  EXPECT_EQ(fit.refusal, Refusal::no_plane);
}

TEST(HoekBrown, FindsEveryInclination) {
  const auto sigma_ci_at = [](double theta) { return 90e6 - 4e5 * theta; };
  const auto k_at = [](double theta) { return 1.0 - theta / 200.0; };
  const Fit fit = fit_hoek_brown(points_of(three, [&](double theta, double s) {
    return s + std::sqrt(std::pow(sigma_ci_at(theta), 2) + k_at(theta) * 11.0 * sigma_ci_at(theta) * s);
  }));
  ASSERT_TRUE(fit.ok());
  for (const double theta : angles) {
    EXPECT_NEAR(fit.value({sigma_ci, theta}) / sigma_ci_at(theta), 1.0, per_mille);
    EXPECT_NEAR(fit.value({k_beta, theta}) / k_at(theta), 1.0, per_mille);
    EXPECT_NEAR(fit.value({m, theta}) / (11.0 * k_at(theta)), 1.0, per_mille);
  }
}

TEST(Fabric, FindsTheRock) {
  // By hand: sigma_1 and the direction of the load from each other, by bisection.
  const auto sigma_1 = [](double theta, double s) {
    const double t = theta * 3.14159265358979324 / 180.0;
    const auto holds = [&](double s1) {
      const double across = s1 * s1 * std::pow(std::cos(t), 2) + s * s * std::pow(std::sin(t), 2);
      const double x = 1.0 - 3.0 * across / (s1 * s1 + 2.0 * s * s);
      return s1 < breaks_at(20e6 * (1.0 + 0.12 * x + 0.09 * x * x), 31.0, s);
    };
    double low = s, high = 1e12;
    for (int i = 0; i < 200; ++i) (holds(0.5 * (low + high)) ? low : high) = 0.5 * (low + high);
    return low;
  };
  const Fit fit = fit_fabric(points_of(three, sigma_1));
  ASSERT_TRUE(fit.ok()) << static_cast<int>(fit.refusal);
  EXPECT_NEAR(fit.value({c_0}) / 20e6, 1.0, per_mille);
  EXPECT_NEAR(fit.value({phi_0}) / 31.0, 1.0, per_mille);
  EXPECT_NEAR(fit.value({omega}) / 0.12, 1.0, per_mille);
  EXPECT_NEAR(fit.value({omega_2}) / 0.09, 1.0, per_mille);
}

TEST(Tension, IsThatOfBothEnds) {
  const Fit fit = fit_tension({{0.0, 3e6}, {90.0, 8e6}});
  EXPECT_NEAR(fit.value({sigma_tj}), 3e6, 1.0);
  EXPECT_NEAR(fit.value({sigma_t}), 8e6, 1.0);
  EXPECT_EQ(fit_tension({{0.0, 3e6}}).refusal, Refusal::too_few);
}

// A law that holds predicts the stress that it was not shown; a curved rock is missed by a straight one.
TEST(StrengthLaws, PredictTheStressThatIsLeftOut) {
  const std::vector<double> four = {0.0, 5e6, 10e6, 20e6};
  const StrengthPoints curved = points_of(four, [](double theta, double s) {
    return std::min(slip_by_bisection(11e6, 22.0, theta, s), theory::hoek_brown_sigma_1(90e6, 15.0, s));
  });
  const StrengthPoints straight = points_of(four, [](double theta, double s) {
    return std::min(slip_by_bisection(11e6, 22.0, theta, s), breaks_at(24e6, 37.0, s));
  });
  const StrengthLaw& joint = strength_laws().front();
  EXPECT_LT(left_out_error(joint, straight), 1e-5);
  EXPECT_GT(left_out_error(joint, curved), 0.01);
}

}  // namespace
}  // namespace phy::design
