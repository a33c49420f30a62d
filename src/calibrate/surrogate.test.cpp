// The stand-in for the press and the sampler, against functions and densities known in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "base/rng.hpp"
#include "calibrate/ensemble.hpp"
#include "calibrate/surrogate.hpp"

namespace phy::calibrate {
namespace {

/// In [-size, size].
Point point(std::uint32_t i, std::size_t d, double size = 1.0) {
  Point z(d);
  for (std::size_t j = 0; j < d; ++j)
    z[j] = size * (2.0 * uniform(3, Stream::test, i, static_cast<std::uint32_t>(j)) - 1.0);
  return z;
}
double curve(std::span<const double> z) {
  return 0.7 + 0.3 * z[0] - 0.1 * z[1] + 0.06 * z[0] * z[2] - 0.05 * z[1] * z[1];
}

std::vector<SurrogateRun> runs(int n, double noise, double coarse_offset, std::uint32_t n_coarse) {
  std::vector<SurrogateRun> list;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
    SurrogateRun r;
    r.z = point(i, 3), r.packing = static_cast<int>(i % 4), r.coarse = i < n_coarse;
    r.y = curve(r.z) + noise * normal(4, Stream::test, i) + (r.coarse ? coarse_offset : 0.0);
    list.push_back(r);
  }
  return list;
}

double rms(const Surrogate& s, double* chi = nullptr) {
  double squares = 0.0, scaled = 0.0;
  constexpr int n = 60;
  for (std::uint32_t i = 1000; i < 1000 + n; ++i) {
    const Surrogate::Value v = s.at(point(i, 3));
    const double e = v.mean - curve(point(i, 3));
    squares += e * e, scaled += e * e / v.variance;
  }
  if (chi != nullptr) *chi = scaled / n;
  return std::sqrt(squares / n);
}

TEST(Surrogate, LearnsACurvedResponseThroughScatterAndKnowsHowWell) {
  double chi = 0.0;
  const double few = rms(Surrogate(runs(10, 0.03, 0.0, 0))),
               many = rms(Surrogate(runs(60, 0.03, 0.0, 0)), &chi);
  EXPECT_LT(many, 0.025);
  EXPECT_LT(many, few);
  // Too sure is as wrong as too unsure.
  EXPECT_LT(chi, 2.0);
  EXPECT_GT(chi, 0.25);
}

// Runs of one packing share its scatter, so that more packings of as many runs tell the mean better.
TEST(Surrogate, PackingsThatAreMoreLeaveLessToChance) {
  const auto left = [](int n_packings, std::uint32_t n_coarse) {
    std::vector<SurrogateRun> list = runs(48, 0.03, 0.0, n_coarse);
    for (int i = 0; i < 48; ++i) list[static_cast<std::size_t>(i)].packing = i % n_packings;
    const Surrogate s(list);
    EXPECT_LT(s.packing_variance(), s.at(point(7, 3)).variance);
    return std::sqrt(s.packing_variance());
  };
  EXPECT_NEAR(left(4, 0) / left(16, 0), 2.0, 0.9);  // scatter itself is learnt anew
  EXPECT_EQ(left(4, 48), 0.0) << "coarse packings are others";
}

// A coarse packing has other grains than the fine one of the same number, and shares no scatter with it.
TEST(Surrogate, NumbersOfCoarsePackingsTellNothingOfFineOnes) {
  std::vector<SurrogateRun> alike = runs(24, 0.03, 0.1, 12), others = alike;
  for (SurrogateRun& r : others)
    if (r.coarse) r.packing += 100;
  const Surrogate::Value a = Surrogate(alike).at(point(7, 3)), b = Surrogate(others).at(point(7, 3));
  EXPECT_DOUBLE_EQ(a.mean, b.mean);
  EXPECT_DOUBLE_EQ(a.variance, b.variance);
}

TEST(Surrogate, FineRunsSetTheLevelThatCoarseOnesMiss) {
  EXPECT_LT(rms(Surrogate(runs(48, 0.02, 0.15, 36))), 0.05);  // 12 fine runs
  EXPECT_GT(rms(Surrogate(runs(48, 0.02, 0.15, 48))), 0.05);  // none: the offset cannot be known
}

TEST(Surrogate, LearnsTheDifferenceToThePriorMean) {
  const maps::PriorMean prior_mean{[](std::span<const double> z) { return curve(z) + 0.2 + 0.05 * z[1]; },
                                   0.15, 0.06, 0.04};
  const Surrogate none({}, prior_mean), few(runs(6, 0.02, 0.0, 0), prior_mean);
  const Point z = point(7, 3);
  EXPECT_DOUBLE_EQ(none.at(z).mean, prior_mean.value(z));
  EXPECT_GT(std::sqrt(none.at(z).variance), 0.1);
  EXPECT_LT(rms(few), 0.85 * rms(Surrogate(runs(6, 0.02, 0.0, 0))));
  double chi = 0.0;
  EXPECT_LT(rms(Surrogate(runs(30, 0.02, 0.0, 0), prior_mean), &chi), 0.03);
  EXPECT_LT(chi, 2.0);
}

TEST(Surrogate, IsSureNearItsRunsAndUnsureFarFromThem) {
  std::vector<SurrogateRun> near = runs(30, 0.02, 0.0, 0);
  for (SurrogateRun& r : near) {
    for (double& z : r.z) z *= 0.2;
    r.y = curve(r.z);
  }
  const Surrogate s(near);
  EXPECT_LT(s.at(Point(3, 0.0)).variance, 0.25 * s.at(Point(3, 1.0)).variance);
}

double largest(const Point& x) {
  double most = 0.0;
  for (const double v : x) most = std::max(most, std::fabs(v));
  return most;
}

TEST(Ensemble, DrawsFromACorrelatedNormalDensity) {
  // x ~ N(1, 1), y | x ~ N(2 x, 0.1^2): a ridge that single-coordinate steps would crawl along
  const LogDensity ridge = [](const Point& x) {
    const double u = x[0] - 1.0, v = (x[1] - 2.0 * x[0]) / 0.1;
    return -0.5 * (u * u + v * v);
  };
  std::vector<Point> walkers;
  for (std::uint32_t i = 0; i < 40; ++i) walkers.push_back(point(i, 2, 3.0));
  const std::vector<Point> draws = sample(ridge, walkers, 3000, 10, 1);
  ASSERT_EQ(draws.size(), 150U * 40U);
  double mean = 0.0, square = 0.0, width = 0.0;
  const auto n = static_cast<double>(draws.size());
  for (const Point& x : draws) {
    mean += x[0] / n, square += (x[0] - 1.0) * (x[0] - 1.0) / n;
    width += (x[1] - 2.0 * x[0]) * (x[1] - 2.0 * x[0]) / n;
  }
  EXPECT_NEAR(mean, 1.0, 0.12);  // some 1,000 independent draws: 4 standard errors
  EXPECT_NEAR(square, 1.0, 0.18);
  EXPECT_NEAR(width, 0.01, 0.002);
}

TEST(Ensemble, NeverLeavesWhereTheDensityIsZero) {
  const LogDensity box = [](const Point& x) {
    return largest(x) <= 1.0 ? 0.0 : -std::numeric_limits<double>::infinity();
  };
  std::vector<Point> walkers;
  for (std::uint32_t i = 0; i < 20; ++i) walkers.push_back(point(i, 3));
  double mean = 0.0;
  const std::vector<Point> draws = sample(box, walkers, 2000, 10, 2);
  for (const Point& x : draws) {
    ASSERT_LE(largest(x), 1.0);
    mean += std::accumulate(x.begin(), x.end(), 0.0) / (3.0 * static_cast<double>(draws.size()));
  }
  EXPECT_NEAR(mean, 0.0, 0.06);
}

/// Walkers that follow x' = a x + noise by themselves, of variance one, plus a drift over the sweeps.
std::vector<Point> chains(double a, double drift) {
  constexpr std::uint32_t n_walkers = 64, n_sweeps = 200;
  std::vector<double> x(n_walkers);
  for (std::uint32_t i = 0; i < n_walkers; ++i) x[i] = normal(5, Stream::test, i);
  std::vector<Point> draws;
  for (std::uint32_t sweep = 0; sweep < n_sweeps; ++sweep)
    for (std::uint32_t i = 0; i < n_walkers; ++i) {
      x[i] = a * x[i] + std::sqrt(1.0 - a * a) * normal(6, Stream::test, i, sweep);
      draws.push_back({x[i] + drift * sweep / n_sweeps});
    }
  return draws;
}

// Of such a chain n draws are worth n (1 - a)/(1 + a).
TEST(Mixing, CountsIndependentDrawsAndSeesADrift) {
  for (const double a : {0.0, 0.5, 0.8}) {
    const Mixing m = mixing(chains(a, 0.0), 64);
    EXPECT_NEAR(m.effective / (64 * 200 * (1.0 - a) / (1.0 + a)), 1.0, 0.12) << a;
    EXPECT_LT(m.r_hat, 1.01) << a;
  }
  // halves of the sweeps lie half a standard deviation apart: sqrt(1 + 4 x 0.25^2/3) = 1.04, less what the
  // drift adds inside
  EXPECT_GT(mixing(chains(0.0, 1.0), 64).r_hat, 1.03);
}

}  // namespace
}  // namespace phy::calibrate
