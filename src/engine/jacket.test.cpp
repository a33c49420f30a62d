#include "engine/jacket.hpp"

#include <gtest/gtest.h>

#include "engine/small_groups_fixture.hpp"

namespace phy::engine {
namespace {

// Two loose discs under a jacket run into each other: p 2R on each, work = p times the area swept, also
// where the list of near pairs knew nothing of the other when it was made.
TEST(Jacket, WorkIsPressureTimesTheAreaSwept) {
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    TwoDiscs t(3.0 * TwoDiscs::skin, true, precision);
    const double drift = 2.0 * TwoDiscs::skin;  // in the first block
    const double force = 2.0 * drift * t.mass / (t.block * t.block);
    const double p = force / (2.0 * TwoDiscs::R);
    t.group->press(0, p);
    double most = 0.0;  // they bounce and give work back
    for (int i = 0; i < 6; ++i) {
      t.group->advance();
      const HistoryRow& r = t.group->row(0);
      const double closer = t.moved(0) - t.moved(1);
      EXPECT_NEAR(r.boundary_work / (force * closer), 1.0, 1e-5) << "after block " << i + 1;
      most = std::max(most, r.boundary_work);
      EXPECT_NEAR(r.kinetic + r.strain_linear, r.boundary_work, 5e-3 * most) << "after block " << i + 1;
      EXPECT_NEAR(t.moved(0) + t.moved(1), 0.0, 1e-3 * drift);
      EXPECT_EQ(t.group->jacket(0).pressure, p);
      EXPECT_NEAR(p * t.group->jacket(0).swept / r.boundary_work, 1.0, 1e-12);
    }
    EXPECT_LT(t.moved(0), 1.6 * TwoDiscs::skin) << "they do not pass through each other";
  }
}

// Three discs of a side, the middle one behind the others: as much of it is pressed as shows between them.
TEST(Jacket, PressesOnWhatShows) {
  const std::vector<double> r(4, 1.0);
  const auto heights = [&](double lower, double upper) {
    const std::vector<Vec2> x = {{1.0, lower}, {3.0, 3.0}, {1.0, upper}, {5.0, 3.0}};
    return jacket_heights(x, r, 6.0, 0.01);
  };
  const std::vector<double> apart = heights(1.0, 5.0), close = heights(1.6, 4.5), shut = heights(2.0, 4.0);
  EXPECT_NEAR(apart[1], 2.0, 0.02);
  EXPECT_NEAR(close[1], 3.5 - 2.6, 0.02);
  EXPECT_EQ(shut[1], 0.0);
  for (const std::vector<double>& h : {apart, close, shut}) EXPECT_NEAR(h[3], -2.0, 0.02);
}

}  // namespace
}  // namespace phy::engine
