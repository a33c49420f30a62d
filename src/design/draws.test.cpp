#include "design/draws.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.hpp"

namespace phy::design {
namespace {

// A normal variable from two uniform ones.
double normal(std::uint32_t i, std::uint32_t j) {
  return std::sqrt(-2.0 * std::log(1.0 - uniform(i, Stream::test, 2 * j))) *
         std::cos(6.283185307179586 * uniform(i, Stream::test, 2 * j + 1));
}

Fit fit_of(double c, double variance) {
  Fit f{.refusal = Refusal::none, .keys = {{Constant::c}}, .error = 0.1, .n = 9};
  f.x = Eigen::VectorXd::Constant(1, std::log(c));
  f.covariance = Eigen::MatrixXd::Constant(1, 1, variance);
  return f;
}

// A posterior about the truth with a known scatter, drawn four times and fitted with an error of its own: the
// interval has to hold the truth in 95 % of rocks. 1,000 rocks: the standard error of the share is 0.7 %.
TEST(Draws, IntervalsHoldTheTruth) {
  constexpr double truth = 20e6, of_rock = 0.15, of_fit = 0.08;
  constexpr std::uint32_t n = 1000;
  std::uint32_t held = 0;
  for (std::uint32_t i = 0; i < n; ++i) {
    std::uint32_t j = 0;
    const double centre = std::log(truth) + of_rock * normal(i, j++);
    std::vector<Fit> draws;
    for (int k = 0; k < 4; ++k) {
      const double drawn = centre + of_rock * normal(i, j++), fitted = drawn + of_fit * normal(i, j++);
      draws.push_back(fit_of(std::exp(fitted), of_fit * of_fit));
    }
    const ConstantEstimate e = pool(draws).constants.front();
    held += e.low <= truth && truth <= e.high ? 1 : 0;
  }
  EXPECT_GE(held, n * 93 / 100);
}

TEST(Draws, AverageByHand) {
  const Pooled p = pool({fit_of(10e6, 0.01), fit_of(40e6, 0.03)});
  ASSERT_TRUE(p.ok());
  const ConstantEstimate& e = p.constants.front();
  // log 2 on both sides of log 20e6: B = 2 log(2)^2, T = 0.02 + 1.5 B.
  const double T = 0.02 + 3.0 * std::log(2.0) * std::log(2.0);
  EXPECT_NEAR(e.value, 20e6, 1.0);
  EXPECT_NEAR(e.se / e.value, std::sqrt(T), 1e-12);
  EXPECT_NEAR(p.covariance(0, 0), e.se * e.se, 1e-3 * e.se * e.se);
}

TEST(Draws, IntervalsOfAnglesEndWhereAnglesDo) {
  std::vector<Fit> draws;
  for (const double phi : {4.0, 60.0}) {
    Fit f{.refusal = Refusal::none, .keys = {{Constant::phi_j}}, .error = 0.1, .n = 9};
    f.x = Eigen::VectorXd::Constant(1, phi), f.covariance = Eigen::MatrixXd::Constant(1, 1, 1.0);
    draws.push_back(f);
  }
  const ConstantEstimate e = pool(draws).constants.front();
  EXPECT_NEAR(e.value, 32.0, 1e-12);
  EXPECT_EQ(e.low, 0.0);
  EXPECT_EQ(e.high, 90.0);
}

TEST(Draws, OneDrawIsNone) {
  EXPECT_FALSE(pool({fit_of(10e6, 0.01)}).ok());
  EXPECT_EQ(pool({refused(Refusal::no_plane), refused(Refusal::no_plane), fit_of(1e6, 0.1)}).refusal,
            Refusal::no_plane);
}

TEST(Draws, WithoutACommonConstantSaySo) {
  Fit one = fit_of(10e6, 0.01), other = fit_of(10e6, 0.01);
  one.keys = {{Constant::m, 0.0}}, other.keys = {{Constant::m, 90.0}};
  EXPECT_EQ(pool({one, other}).refusal, Refusal::no_common);
}

}  // namespace
}  // namespace phy::design
