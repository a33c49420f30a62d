// Bands of made-up draws, and how often they hold one more.
#include "study/band.hpp"

#include <gtest/gtest.h>

#include "base/rng.hpp"

namespace phy::study {
namespace {

Prediction ucs(double value, double theta = 45.0, double sigma_3 = nan) {
  return {{"theta = " + std::to_string(static_cast<int>(theta)) + " deg", false, theta, sigma_3},
          "ucs",
          "Pa",
          value};
}

TEST(Band, IsFromTheSmallestToTheLargestOfEachPlace) {
  const std::vector<Band> bands = bands_of(
      {{ucs(3e6), ucs(30e6, 90.0)}, {ucs(1e6), ucs(nan, 90.0)}, {ucs(8e6), ucs(10e6, 90.0)}, {ucs(4e6)}});
  ASSERT_EQ(bands.size(), 2U);
  EXPECT_EQ(bands[0].n, 4U);
  EXPECT_EQ(bands[0].n_without, 0U);
  EXPECT_DOUBLE_EQ(bands[0].median, 3.5e6);
  EXPECT_DOUBLE_EQ(bands[0].low, 1e6);
  EXPECT_DOUBLE_EQ(bands[0].high, 8e6);
  EXPECT_DOUBLE_EQ(bands[0].width(), 2.0);
  EXPECT_EQ(bands[1].n, 2U);
  EXPECT_EQ(bands[1].n_without, 2U);  // one without a strength, one without the test
  EXPECT_DOUBLE_EQ(bands[1].median, 20e6);
}

TEST(Band, StressesAreApart) {
  const std::vector<Band> bands = bands_of({{ucs(3e6, 45.0, 0.0), ucs(5e6, 45.0, 10e6), ucs(9e6)}});
  ASSERT_EQ(bands.size(), 3U);
  EXPECT_EQ(bands[1].place.sigma_3, 10e6);
}

TEST(Band, OfATestWithoutAStrengthOnlyThatIsSaid) {
  TestResult result;
  result.name = "theta = 45 deg", result.intact = false, result.theta = 45.0;
  result.numbers = {{"E_tangent", 5e9, "Pa", "", ""}, {"ucs", 50e6, "Pa", "", ""}};
  result.outcome.status = Status::peaked;
  TestResult none = result;
  none.outcome.status = Status::untrusted;
  const std::vector<Band> bands = bands_of({predictions_of(none, nan), predictions_of(result, nan)});
  ASSERT_EQ(bands.size(), 2U);
  EXPECT_EQ(bands[0].number, "ucs");
  EXPECT_EQ(bands[0].unit, "Pa");
  EXPECT_EQ(bands[0].n, 1U);
  EXPECT_EQ(bands[0].n_without, 1U);
  EXPECT_EQ(bands[1].number, "E_tangent");
}

// Twenty numbers and one more, of whatever distribution: here of a logarithm, skewed.
TEST(Band, OfTwentyDrawsHoldsOneMoreInNineteenOfTwentyOne) {
  constexpr std::uint32_t n_bands = 4000;
  int held = 0;
  for (std::uint32_t k = 0; k < n_bands; ++k) {
    std::vector<Predictions> draws;
    for (std::uint32_t i = 0; i < 20; ++i) draws.push_back({ucs(std::exp(normal(3, Stream::test, k, i)))});
    const double next = std::exp(normal(3, Stream::test, k, 20));
    const Band band = bands_of(draws).front();
    held += band.low <= next && next <= band.high ? 1 : 0;
  }
  const double p = 19.0 / 21.0;
  EXPECT_DOUBLE_EQ(band_probability(20), p);
  EXPECT_NEAR(held / static_cast<double>(n_bands), p, 3.0 * std::sqrt(p * (1.0 - p) / n_bands));
}

Prediction corrected(double value, double missed, double sd) {
  Prediction p = ucs(value);
  p.missed = missed, p.missed_sd = sd;
  return p;
}

TEST(Band, OfARockIsThatOfTheDrawsTimesWhatTheyMiss) {
  const std::vector<Band> certain =
      bands_of({{corrected(40e6, 0.1, 0.0)}, {corrected(50e6, 0.1, 0.0)}, {corrected(70e6, 0.1, 0.0)}});
  const Band& same = certain.front();
  EXPECT_DOUBLE_EQ(same.median, 50e6) << "the model's own stays";
  EXPECT_NEAR(same.factor, std::exp(0.1), 1e-12);
  EXPECT_NEAR(same.rock, 50e6 * same.factor, 1.0);
  EXPECT_NEAR(same.rock_low, 40e6 * same.factor, 1.0);
  EXPECT_NEAR(same.rock_high, 70e6 * same.factor, 1.0);
  // one draw: a normal distribution of which two thirds are wanted, 1/3 on either side of the middle at
  // 0.4307 standard deviations
  const Band wide = bands_of({{corrected(50e6, -0.1, 0.2)}, {corrected(50e6, -0.1, 0.2)}}).front();
  EXPECT_NEAR(wide.rock, 50e6 * std::exp(-0.1), 1.0);
  EXPECT_NEAR(std::log(wide.rock_high / wide.rock), 0.2 * 0.430727, 1e-6);
  EXPECT_NEAR(std::log(wide.rock / wide.rock_low), 0.2 * 0.430727, 1e-6);
}

TEST(Band, OfARockIsNotKnownWhereADrawDoesNotKnowWhatItMisses) {
  const Band band = bands_of({{corrected(40e6, 0.1, 0.1)}, {ucs(50e6)}}).front();
  EXPECT_EQ(band.n, 2U);
  EXPECT_FALSE(band.has_rock());
  EXPECT_TRUE(std::isnan(band.factor));
}

// Of draws that scatter and a discrepancy that is not known either: both together are counted once.
TEST(Band, OfARockHoldsIt) {
  constexpr std::uint32_t n_bands = 2000;
  int held = 0, held_by_model = 0;
  for (std::uint32_t k = 0; k < n_bands; ++k) {
    std::vector<Predictions> draws;
    for (std::uint32_t i = 0; i < 20; ++i)
      draws.push_back({corrected(std::exp(0.1 * normal(7, Stream::test, k, i)), 0.05, 0.1)});
    const double rock =
        std::exp(0.1 * normal(7, Stream::test, k, 20) + 0.05 + 0.1 * normal(7, Stream::test, k, 21));
    const Band band = bands_of(draws).front();
    held += band.rock_low <= rock && rock <= band.rock_high ? 1 : 0;
    held_by_model += band.low <= rock && rock <= band.high ? 1 : 0;
  }
  EXPECT_NEAR(held / static_cast<double>(n_bands), 19.0 / 21.0, 0.02);
  EXPECT_LT(held_by_model / static_cast<double>(n_bands), 0.85);
}

TEST(Band, TableHasEmptyCellsWhereThereIsNothing) {
  EXPECT_EQ(bands_csv(bands_of({{ucs(2e6)}, {ucs(4e6)}, {ucs(nan, 0.0, 5e6)}})),
            "specimen,theta [deg],sigma_3 [Pa],number,unit,draws,without,median,low,high,width,"
            "factor,factor_sd,rock,rock_low,rock_high\n"
            "theta = 45 deg,45,,ucs,Pa,2,1,3e+06,2e+06,4e+06,0.6666666666666666,,,,,\n"
            "theta = 0 deg,0,5e+06,ucs,Pa,0,3,,,,,,,,,\n");
}

}  // namespace
}  // namespace phy::study
