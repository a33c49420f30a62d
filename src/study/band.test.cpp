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

TEST(Band, TableHasEmptyCellsWhereThereIsNothing) {
  EXPECT_EQ(bands_csv(bands_of({{ucs(2e6)}, {ucs(4e6)}, {ucs(nan, 0.0, 5e6)}})),
            "specimen,theta [deg],sigma_3 [Pa],number,unit,draws,without,median,low,high,width\n"
            "theta = 45 deg,45,,ucs,Pa,2,1,3e+06,2e+06,4e+06,0.6666666666666666\n"
            "theta = 0 deg,0,5e+06,ucs,Pa,0,3,,,,\n");
}

}  // namespace
}  // namespace phy::study
