// Joint draws: in the box, correlated as they were asked to be, the same every time.
#include "calibrate/posterior_ensemble.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/nan.hpp"
#include "base/stats.hpp"

namespace phy::calibrate {
namespace {

const std::vector<LogBox> wide = {{-50.0, 50.0, 0.0}, {-50.0, 50.0, 0.0}};
/// SD 0.5 and 2, correlation 0.9.
const std::vector<double> covariance = {0.25, 0.9, 0.9, 4.0};

TEST(GaussianDraws, KeepMeansSpreadsAndCorrelation) {
  const std::vector<Point> draws = gaussian_draws({3.0, -1.0}, covariance, wide, 4000, 1);
  ASSERT_EQ(draws.size(), 4000U);
  std::vector<double> x, y;
  double product = 0.0;
  for (const Point& d : draws) {
    x.push_back(d[0]), y.push_back(d[1]);
    product += (d[0] - 3.0) * (d[1] + 1.0) / 4000.0;
  }
  // four standard errors of means, standard deviations (sd over root 2n) and of the correlation
  EXPECT_NEAR(summarise(x).mean, 3.0, 4.0 * 0.5 / std::sqrt(4000.0));
  EXPECT_NEAR(summarise(y).mean, -1.0, 4.0 * 2.0 / std::sqrt(4000.0));
  EXPECT_NEAR(summarise(x).sd, 0.5, 4.0 * 0.5 / std::sqrt(8000.0));
  EXPECT_NEAR(summarise(y).sd, 2.0, 4.0 * 2.0 / std::sqrt(8000.0));
  EXPECT_NEAR(product, 0.9, 4.0 * std::sqrt(1.81 / 4000.0));
}

TEST(GaussianDraws, StayInTheBoxAndAreThoseOfTheSeed) {
  const std::vector<LogBox> narrow = {{2.9, 3.4, 3.0}, {-2.0, 0.0, -1.0}};
  const std::vector<Point> draws = gaussian_draws({3.0, -1.0}, covariance, narrow, 200, 5);
  ASSERT_EQ(draws.size(), 200U);
  for (const Point& d : draws)
    for (std::size_t j = 0; j < 2; ++j) {
      EXPECT_GE(d[j], narrow[j].low);
      EXPECT_LE(d[j], narrow[j].high);
    }
  EXPECT_EQ(draws, gaussian_draws({3.0, -1.0}, covariance, narrow, 200, 5));
  EXPECT_NE(draws, gaussian_draws({3.0, -1.0}, covariance, narrow, 200, 6));
  // far outside, nothing falls in by chance
  for (const Point& d : gaussian_draws({9.0, -1.0}, {1e-6, 0.0, 0.0, 1e-6}, narrow, 3, 5))
    EXPECT_EQ(d[0], narrow[0].high);
}

TEST(GaussianDraws, WithoutACovarianceThereAreNone) {
  EXPECT_TRUE(gaussian_draws({0.0, 0.0}, {1.0, 2.0, 2.0, 1.0}, wide, 20, 1).empty());
  EXPECT_TRUE(gaussian_draws({0.0, 0.0}, {nan, 0.0, 0.0, nan}, wide, 20, 1).empty());
}

TEST(EvenlyTaken, FromTheFirstToTheLastAndFromDifferentWalkers) {
  constexpr std::size_t n_walkers = 64;
  std::vector<Point> chain;
  for (int i = 0; i < 1280; ++i) chain.push_back({static_cast<double>(i)});
  const std::vector<Point> taken = evenly_taken(chain, 20);
  ASSERT_EQ(taken.size(), 20U);
  EXPECT_EQ(taken.front()[0], 0.0);
  EXPECT_EQ(taken.back()[0], 1279.0);
  for (std::size_t k = 1; k < 20; ++k) {
    EXPECT_NEAR(taken[k][0] - taken[k - 1][0], 1279.0 / 19.0, 1.0);
    EXPECT_NE(static_cast<std::size_t>(taken[k][0]) % n_walkers,
              static_cast<std::size_t>(taken[k - 1][0]) % n_walkers);
  }
}

}  // namespace
}  // namespace phy::calibrate
