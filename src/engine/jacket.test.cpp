#include "engine/jacket.hpp"

#include <gtest/gtest.h>

#include <cmath>

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
    std::vector<double> along;
    for (const Vec2 area : side_areas(x, r, 6.0, 0.01)) along.push_back(area.x);
    return along;
  };
  const std::vector<double> apart = heights(1.0, 5.0), close = heights(1.6, 4.5), shut = heights(2.0, 4.0);
  EXPECT_NEAR(apart[1], 2.0, 0.02);
  EXPECT_NEAR(close[1], 3.5 - 2.6, 0.02);
  EXPECT_EQ(shut[1], 0.0);
  for (const std::vector<double>& h : {apart, close, shut}) EXPECT_NEAR(h[3], -2.0, 0.02);
}

constexpr double ring_radius = 0.01, ring_grain = 2e-4;
constexpr Hole ring_hole = {{0.02, 0.03}, ring_radius};

/// Discs side by side around the hole, their centres on its wall.
std::vector<Vec2> ring(int n) {
  std::vector<Vec2> x;
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * pi * i / n;
    x.push_back(ring_hole.centre + ring_radius * Vec2{std::cos(a), std::sin(a)});
  }
  return x;
}

// The wall of a hole as a chain of discs: a pressure pushes each outwards by its piece of the perimeter, and
// leaves no force on the whole, whatever its two components are.
TEST(Jacket, PressesOnTheWallOfAHole) {
  const int n = 160;
  const std::vector<Vec2> x = ring(n),
                          area = hole_areas(x, std::vector<double>(n, ring_grain), ring_hole, 2e-5);
  Vec2 sum;
  double outwards = 0.0;
  for (int i = 0; i < n; ++i) {
    const Vec2 out = (1.0 / ring_radius) * (x[i] - ring_hole.centre);
    outwards += dot(area[i], out);
    sum = sum + area[i];
    EXPECT_NEAR(dot(area[i], out) / (2.0 * pi * ring_radius / n), 1.0, 0.05) << i;
  }
  EXPECT_NEAR(outwards / (2.0 * pi * (ring_radius - ring_grain)), 1.0, 0.02) << "they stand inwards of it";
  EXPECT_NEAR(norm(sum), 0.0, 1e-12 * outwards);
}

// A grain that has left the wall shows those behind it; one in front of them hides them; one that has fallen
// to the middle is not seen.
TEST(Jacket, OfAHoleFollowsItsWall) {
  const int n = 160;
  std::vector<Vec2> x = ring(n);
  const Vec2 out = (1.0 / ring_radius) * (x[0] - ring_hole.centre);
  x.push_back(x[0] + 2.0 * ring_grain * out);  // in a second row
  const std::vector<double> r(x.size(), ring_grain);
  const auto pressed = [&](std::size_t i) { return norm(hole_areas(x, r, ring_hole, 2e-5)[i]); };
  EXPECT_EQ(pressed(n), 0.0);
  x[0] = ring_hole.centre + 0.2 * ring_radius * out;
  EXPECT_GT(pressed(n), 1.5 * ring_grain);
  EXPECT_EQ(pressed(0), 0.0);
  x[0] = ring_hole.centre + 0.8 * ring_radius * out;
  EXPECT_EQ(pressed(n), 0.0);
  EXPECT_GT(pressed(0), 1.5 * ring_grain);
}

}  // namespace
}  // namespace phy::engine
