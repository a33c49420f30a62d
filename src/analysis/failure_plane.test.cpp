// Clouds of cracks whose line is known by construction, and clouds that have none.
#include "analysis/failure_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "analysis/histories_fixture.hpp"
#include "base/rng.hpp"

namespace phy::analysis {
namespace {

double random(std::uint32_t seed, std::uint32_t i, std::uint32_t of) {
  return uniform(seed, Stream::test, i, of);
}
CrackEvent at(double x, double y) {
  CrackEvent c;
  c.position = {x, y};
  return c;
}

/// Evenly spread over a box, in grain diameters.
std::vector<CrackEvent> spread(std::uint32_t seed, int n, double width, double height) {
  std::vector<CrackEvent> cracks;
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i)
    cracks.push_back(at(width * random(seed, i, 1), height * random(seed, i, 2)));
  return cracks;
}
/// On a line through (x, y) that is `length` long, half a grain diameter to both sides.
void add_line(std::vector<CrackEvent>& cracks, int n, double angle, double x, double y, double length) {
  const double c = std::cos(angle * std::numbers::pi / 180.0), s = std::sin(angle * std::numbers::pi / 180.0);
  const auto seed = static_cast<std::uint32_t>(cracks.size());
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n); ++i) {
    const double along = length * (random(seed, i, 3) - 0.5), across = random(seed, i, 4) - 0.5;
    cracks.push_back(at(x + c * along - s * across, y + s * along + c * across));
  }
}

TEST(FailurePlane, OneLineAmongCracksThatHaveNone) {
  for (const double angle : {-60.0, 0.0, 30.0, 60.0, 90.0}) {
    std::vector<CrackEvent> cracks = spread(1, 60, 22.0, 45.0);
    add_line(cracks, 60, angle, 11.0, 22.0, 22.0);
    const FailurePlane plane = failure_plane(cracks, 1.0);
    EXPECT_LT(std::fabs(std::remainder(plane.angle - angle, 180.0)), 3.0) << angle << ": " << plane.angle;
    EXPECT_LT(plane.error, 3.0) << angle;
  }
}

// Two lines of three tell their direction, not the one between them.
TEST(FailurePlane, ParallelLinesCountTogether) {
  std::vector<CrackEvent> cracks;
  for (const double y : {12.0, 17.0, 27.0}) add_line(cracks, 30, 45.0, 11.0, y, 20.0);
  const FailurePlane plane = failure_plane(cracks, 1.0);
  EXPECT_NEAR(plane.angle, 45.0, 1.0);
  EXPECT_GT(plane.excess, 2.0) << "nothing lies between the lines";
}

// The error is that of a line fitted to the cracks: scatter across over the root of n and the scatter along.
TEST(FailurePlane, TheErrorIsThatOfALine) {
  std::vector<CrackEvent> cracks;
  add_line(cracks, 80, 20.0, 0.0, 0.0, 30.0);
  const double expected = std::sqrt(1.0 / 12.0) / (std::sqrt(80.0) * 30.0 * std::sqrt(1.0 / 12.0));
  const FailurePlane plane = failure_plane(cracks, 1.0);
  EXPECT_NEAR(plane.error / (expected * 180.0 / std::numbers::pi), 1.0, 0.6) << "ten groups tell 25 %";
  EXPECT_NEAR(plane.angle, 20.0, 3.0 * plane.error);
}

// The two limits are those of chance: boxes of a coarse and of the paper's specimen, few cracks and many.
TEST(FailurePlane, CracksThatAreSpreadEvenlyHaveNone) {
  int lines = 0, clouds = 0;
  for (const auto& [width, height] : {std::pair(15.0, 30.0), std::pair(22.0, 45.0), std::pair(57.0, 114.0)})
    for (const int n : {20, 50, 100, 300})
      for (std::uint32_t seed = 1; seed <= 40; ++seed, ++clouds)
        lines += std::isfinite(failure_plane(spread(seed, n, width, height), 1.0).angle) ? 1 : 0;
  EXPECT_LE(lines, clouds / 100) << "of " << clouds;
}

TEST(FailurePlane, ACompactCloudHasNone) {
  std::vector<CrackEvent> cracks;
  for (std::uint32_t i = 0; i < 200; ++i)
    cracks.push_back(at(4.0 * normal(1, Stream::test, i, 1), 4.0 * normal(1, Stream::test, i, 2)));
  EXPECT_TRUE(std::isnan(failure_plane(cracks, 1.0).angle));
}

TEST(FailurePlane, NumbersSayWhyThereIsNone) {
  std::vector<CrackEvent> few(3);
  few[0].place = CrackPlace::bedding;
  const std::vector<Number> numbers = failure_numbers(few, 1.0, true);
  EXPECT_NEAR(value(numbers, "bedding_share"), 1.0 / 3.0, 1e-12);
  EXPECT_TRUE(std::isnan(value(numbers, "failure_angle")));
  EXPECT_EQ(note(numbers, "failure_angle"), "fewer than 20 cracks");
  EXPECT_TRUE(std::isnan(value(failure_numbers(few, 1.0, false), "bedding_share")));
}

TEST(MeanDirection, IsTheSameHalfATurnOn) {
  const double around_90[] = {88.0, -88.0, 90.0};
  EXPECT_NEAR(mean_direction(around_90).angle, 90.0, 1e-9);
  EXPECT_NEAR(mean_direction(around_90).sd, 2.0, 1e-9);
  const double one[] = {30.0};
  EXPECT_NEAR(mean_direction(one).angle, 30.0, 1e-12);
  EXPECT_TRUE(std::isnan(mean_direction(one).sd));
}

}  // namespace
}  // namespace phy::analysis
