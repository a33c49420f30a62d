#include "events/b_value.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.hpp"

namespace phy::events {
namespace {

/// Complete from -8 on, with that b.
std::vector<double> catalogue(std::uint32_t seed, std::uint32_t n, double b) {
  std::vector<double> magnitudes;
  for (std::uint32_t i = 0; i < n; ++i)
    magnitudes.push_back(-8.0 - std::log10(uniform(seed, Stream::test, i)) / b);
  return magnitudes;
}

// By hand: mean 0.5 above the completeness, b = 0.4343 / 0.5. Half of the events 0.1, half 0.9 above it:
// standard deviation of the mean 0.4 / sqrt(n - 1).
TEST(BValue, IsThatOfAkiWithTheErrorOfShiAndBolt) {
  std::vector<double> m;
  for (int i = 0; i < 20; ++i) m.insert(m.end(), {-7.9, -7.1});
  m.push_back(-8.5);  // below the completeness: does not count
  const BValue b = b_value(m, -8.0);
  EXPECT_EQ(b.n, 40U);
  EXPECT_NEAR(b.b, std::log10(std::exp(1.0)) / 0.5, 1e-12);
  EXPECT_NEAR(b.error, std::log(10.0) * b.b * b.b * 0.4 / std::sqrt(39.0), 1e-12);
  EXPECT_NEAR(b.half_width / b.error, 2.023, 1e-3);  // Student's t of 39
}

TEST(BValue, FewEventsGiveNone) {
  EXPECT_TRUE(std::isnan(b_value(catalogue(1, least_events - 1, 1.0), -8.0).b));
  EXPECT_FALSE(std::isnan(b_value(catalogue(1, least_events, 1.0), -8.0).b));
  EXPECT_TRUE(std::isnan(b_value(std::vector<double>(100, -8.0), -8.0).b)) << "all alike";
  EXPECT_TRUE(std::isnan(b_value({}, -8.0).b));
}

int n_within(int n_catalogues, std::uint32_t n_events, double b) {
  int n = 0;
  for (int seed = 0; seed < n_catalogues; ++seed) {
    const BValue found = b_value(catalogue(static_cast<std::uint32_t>(seed), n_events, b), -8.0);
    n += std::fabs(found.b - b) <= found.half_width ? 1 : 0;
  }
  return n;
}

// 190 of 200 are expected; chance takes away up to 9 of them once in a thousand times. Many more catalogues
// say that 95 % is right, and not more than that.
TEST(BValue, LiesWithinItsIntervalInNineteenOfTwentyCatalogues) {
  for (const double b : {0.6, 1.0, 1.8}) {
    const int of_200 = n_within(200, 300, b);
    RecordProperty("within_of_200", of_200);
    EXPECT_GE(of_200, 181) << b;
    EXPECT_NEAR(n_within(5000, 300, b) / 5000.0, 0.95, 0.01) << b;
  }
}

// Half of the events below -7.5 are missed: the fullest bin is there, and b is that of the rest.
TEST(BValue, CompletenessIsFoundWhereSmallEventsAreMissed) {
  std::vector<double> heard;
  std::uint32_t i = 0;
  for (const double m : catalogue(5, 20000, 1.0)) {
    const double chance = m >= -7.5 ? 1.0 : std::pow(10.0, 2.0 * (m + 7.5));  // of being heard
    if (uniform(6, Stream::test, i++) < chance) heard.push_back(m);
  }
  const double completeness = completeness_of(heard);
  EXPECT_NEAR(completeness, -7.3, 0.15);
  const BValue b = b_value(heard, completeness);
  EXPECT_NEAR(b.b, 1.0, 3.0 * b.error);
  EXPECT_TRUE(std::isnan(completeness_of({})));
}

// Another thickness adds a constant to every magnitude: b and its error stay.
TEST(BValue, StaysWhereAllMagnitudesAreShifted) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U, 5U}) {
    const std::vector<double> all = catalogue(seed, 300, 1.0);
    const BValue b = b_value(all, completeness_of(all));
    ASSERT_TRUE(std::isfinite(b.b));
    for (const double shift : {2.0 / 3.0, 0.037, -1.25}) {
      std::vector<double> shifted = all;
      for (double& m : shifted) m += shift;
      const BValue again = b_value(shifted, completeness_of(shifted));
      EXPECT_NEAR(again.completeness, b.completeness + shift, 1e-9) << shift;
      EXPECT_EQ(again.n, b.n) << shift;
      EXPECT_NEAR(again.b, b.b, 1e-9) << shift;
      EXPECT_NEAR(again.error, b.error, 1e-9) << shift;
    }
  }
}

TEST(EventNumbers, CountTypesAndSayWhatIsMissing) {
  std::vector<AcousticEvent> events(3);
  events[0].type = SourceType::opening, events[0].magnitude = -7.0;
  events[1].type = SourceType::opening, events[1].magnitude = -HUGE_VAL;
  events[2].magnitude = -6.5;
  const std::vector<Number> numbers = event_numbers(events, 0.001);
  const auto value = [&](const std::string& name) {
    for (const Number& n : numbers)
      if (n.name == name) return n.value;
    return std::nan("");
  };
  EXPECT_EQ(value("n_events"), 3.0);
  EXPECT_EQ(value("events_opening"), 2.0);
  EXPECT_EQ(value("events_shear"), 1.0);
  EXPECT_EQ(value("largest_magnitude"), -6.5);
  EXPECT_EQ(value("event_thickness"), 0.001);
  for (const Number& n : numbers) EXPECT_EQ(std::isnan(n.value), !n.note.empty()) << n.name;
}

}  // namespace
}  // namespace phy::events
