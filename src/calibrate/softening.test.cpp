// What tests make of the moduli: when it is settled, and how far a step goes.
#include "calibrate/softening.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace phy::calibrate {
namespace {

TEST(Softening, IsSettledWhereNoModulusMovesByOnePercent) {
  EXPECT_TRUE(
      settled({{0.0, {0.8, 0.02}}, {90.0, {0.9, 0.0}}}, {{0.0, {0.806, 0.025}}, {90.0, {0.893, 0.0}}}));
  EXPECT_FALSE(settled({{0.0, {0.8, 0.02}}}, {{0.0, {0.8, 0.04}}})) << "nu moves";
  EXPECT_FALSE(settled({{0.0, {0.8, 0.0}}, {90.0, {0.9, 0.0}}}, {{0.0, {0.8, 0.0}}, {90.0, {0.91, 0.0}}}));
  EXPECT_FALSE(settled({}, {{0.0, {0.95, 0.0}}})) << "nothing was taken off before";
  EXPECT_TRUE(settled({}, {{0.0, {0.995, 0.0}}}));
}

// A press whose softening answers each step by half of it in the other direction: whole steps swing for long.
TEST(Softening, StepsSettleWhereWholeOnesSwing) {
  const auto press = [](double used) { return 0.7 * std::pow(used / 0.7, -0.54); };
  Softenings used = {{45.0, {1.0, 0.0}}};
  double whole = 1.0;
  for (int pass = 0; pass < 3; ++pass) {
    used = stepped(used, {{45.0, {press(used.at(45.0).factor), 0.1}}});
    whole = press(whole);
  }
  EXPECT_NEAR(used.at(45.0).factor, 0.7, 1e-3);
  EXPECT_GT(std::fabs(whole - 0.7), 0.03);
  EXPECT_GT(used.at(45.0).addition, 0.09);
}

}  // namespace
}  // namespace phy::calibrate
