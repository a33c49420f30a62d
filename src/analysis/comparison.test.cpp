// A curve beside itself, beside its multiple, and beside one that lacks something.
#include "analysis/comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "analysis/histories_fixture.hpp"

namespace phy::analysis {
namespace {

History marble_with_cracks() {
  History h = marble();
  for (std::size_t i = 150; i < h.rows.size(); ++i) h.rows[i].n_cracks = static_cast<double>(i - 149);
  return h;
}

TEST(Comparison, ACurveDoesNotDifferFromItself) {
  const History h = marble_with_cracks();
  const auto numbers = compared_numbers(h, h, {});
  ASSERT_EQ(numbers.size(), 5U);
  EXPECT_NEAR(numbers[0].ours, 50.0, 1e-9);
  EXPECT_NEAR(numbers[1].ours, 50.0, 1e-9);
  EXPECT_NEAR(numbers[2].ours, 75.5, 1e-9);  // row 151 of 200
  EXPECT_NEAR(numbers[3].ours, 100.0, 1e-9);
  EXPECT_NEAR(numbers[4].ours, 0.2, 1e-12);
  for (const ComparedNumber& n : numbers) {
    EXPECT_EQ(n.difference(), 0.0) << n.name;
    EXPECT_EQ(n.note, "") << n.name;
  }
  EXPECT_EQ(distance_of_curves(h, h, {}), 0.0);
}

TEST(Comparison, AStressScaledByATenthShowsThat) {
  const History ours = marble_with_cracks();
  History theirs = ours;
  for (HistoryRow& row : theirs.rows) row.axial_stress *= 1.1;
  const auto numbers = compared_numbers(ours, theirs, {});
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(numbers[i].difference(), 0.1, 1e-12) << numbers[i].name;
  EXPECT_EQ(numbers[4].difference(), 0.0) << "the strain of the peak is the same";
  // 10 % of a straight line over its end: root of the mean of squares, 1/sqrt(3)
  EXPECT_NEAR(distance_of_curves(ours, theirs, {}), 0.1 / std::sqrt(3.0), 3e-4);
}

TEST(Comparison, WhatACurveLacksIsSaid) {
  const auto numbers = compared_numbers(marble_with_cracks(), marble(), {});
  EXPECT_TRUE(std::isnan(numbers[2].theirs));
  EXPECT_THAT(numbers[2].note, testing::HasSubstr("theirs: no crack"));
  EXPECT_TRUE(std::isfinite(numbers[3].theirs));
}

}  // namespace
}  // namespace phy::analysis
