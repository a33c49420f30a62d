#include "events/counts.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace phy::events {
namespace {

std::vector<AcousticEvent> at(std::initializer_list<double> strains) {
  std::vector<AcousticEvent> events;
  for (const double s : strains) events.emplace_back().strain = s;
  return events;
}

TEST(Counts, AreSharesOfThoseUpToThePeak) {
  const Counts c = counts_of(at({-0.3, -0.1, -0.2, -0.4, -0.9}), -1.0, 0.4);
  EXPECT_DOUBLE_EQ(c.share(0.0), 0.0);
  EXPECT_DOUBLE_EQ(c.share(0.2), 0.0) << "before the first";
  EXPECT_NEAR(c.share(0.25), 0.25, 1e-12);
  EXPECT_NEAR(c.share(0.625), 2.5 / 4.0, 1e-12) << "halfway from the second to the third";
  EXPECT_DOUBLE_EQ(c.share(1.0), 1.0);
  EXPECT_DOUBLE_EQ(c.share(3.0), 1.25) << "behind the peak";
  EXPECT_TRUE(std::isnan(counts_of(at({}), 1.0, 0.4).share(1.0)));
}

TEST(Counts, WithoutAPeakAreNotCompared) {
  const Counts none = counts_of(at({0.1, 0.2}), 1.0, nan), some = counts_of(at({0.1, 0.2}), 1.0, 0.4);
  EXPECT_TRUE(std::isnan(none.share(0.5)));
  EXPECT_TRUE(std::isnan(compared(none, some).difference));
  EXPECT_FALSE(compared(none, some).peaks);
  EXPECT_TRUE(compared(some, some).peaks);
}

TEST(Counts, OfACurveAreThoseOfItsRows) {
  History h;
  for (const auto& [strain, stress, n] :
       {std::array{0.0, 0.0, 0.0}, {0.1, 5.0, 10.0}, {0.05, 5.0, 99.0}, {0.2, 9.0, 40.0}, {0.3, 4.0, 70.0}}) {
    HistoryRow& row = h.rows.emplace_back();
    row.axial_strain = strain, row.axial_stress = stress, row.n_cracks = n;
  }
  const Counts c = counts_of(h);
  EXPECT_EQ(c.peak, 0.2);
  EXPECT_DOUBLE_EQ(c.share(0.5), 0.25);
  EXPECT_EQ(c.n.size(), 4U) << "the row that went back is passed over";
  for (HistoryRow& row : h.rows) row.n_cracks = nan;
  EXPECT_TRUE(std::isnan(counts_of(h).share(1.0)));
}

// Ours come evenly, theirs all in the last fifth: at four fifths ours are 0.8 ahead.
TEST(Counts, AreComparedOverTheWayToThePeak) {
  std::vector<AcousticEvent> even, late;
  for (int i = 1; i <= 1000; ++i) {
    even.emplace_back().strain = 1e-5 * i;
    late.emplace_back().strain = 0.02 * (0.8 + 2e-4 * i);
  }
  const CountsCompared c = compared(counts_of(even, 1.0, 0.01), counts_of(late, 1.0, 0.02));
  EXPECT_NEAR(c.difference, 0.8, 2e-3);
  EXPECT_NEAR(c.part, 0.8, 1e-2);
  EXPECT_NEAR(compared(counts_of(late, 1.0, 0.02), counts_of(even, 1.0, 0.01)).difference, -0.8, 2e-3);
  EXPECT_TRUE(std::isnan(compared(counts_of({}, 1.0, 0.01), counts_of(late, 1.0, 0.02)).difference));
}

}  // namespace
}  // namespace phy::events
