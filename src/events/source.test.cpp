#include "events/source.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace phy::events {
namespace {

/// Principal moments m1 along `angle` [deg], m2 across it.
MomentTensor turned(double m1, double m2, double angle) {
  const double c = std::cos(angle * std::numbers::pi / 180.0), s = std::sin(angle * std::numbers::pi / 180.0);
  return {m1 * c * c + m2 * s * s, (m1 - m2) * c * s, m1 * s * s + m2 * c * c};
}

TEST(EventSource, PrincipalMomentsDoNotDependOnTheAxes) {
  for (const double angle : {0.0, 17.0, 45.0, 90.0, 133.0}) {
    const auto [m1, m2] = principal_moments(turned(5.0, -3.0, angle));
    EXPECT_NEAR(m1, 5.0, 1e-12) << angle;
    EXPECT_NEAR(m2, -3.0, 1e-12) << angle;
  }
}

TEST(EventSource, TheMomentOfADoubleCoupleIsThatOfOneCouple) {
  EXPECT_NEAR(scalar_moment(turned(7.0, -7.0, 30.0)), 7.0, 1e-12);
  EXPECT_NEAR(scalar_moment({0.0, 7.0, 0.0}), 7.0, 1e-12);
  EXPECT_NEAR(scalar_moment({7.0, 0.0, 0.0}), 7.0 / std::sqrt(2.0), 1e-12);
}

// Of the common logarithm: ten times the moment is two thirds of a unit, and 1 N m is -6. With the natural
// one it would be 1.54.
TEST(EventSource, MagnitudesAreOfTheCommonLogarithm) {
  EXPECT_NEAR(magnitude_of(1.0), -6.0, 1e-14);
  EXPECT_NEAR(magnitude_of(1e9), 0.0, 1e-12);
  for (const double moment : {1e-9, 1e-3, 20.0})
    EXPECT_NEAR(magnitude_of(10.0 * moment) - magnitude_of(moment), 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(magnitude_of(3.0), 2.0 / 3.0 * std::log10(3.0) - 6.0, 1e-14);
  EXPECT_EQ(magnitude_of(0.0), -HUGE_VAL);
}

TEST(EventSource, TheTypeFollowsTheShareOfVolume) {
  EXPECT_NEAR(volume_share(turned(4.0, 4.0, 0.0)), 100.0, 1e-12);
  EXPECT_NEAR(volume_share(turned(-4.0, -4.0, 0.0)), -100.0, 1e-12);
  EXPECT_NEAR(volume_share(turned(4.0, -4.0, 25.0)), 0.0, 1e-12);
  EXPECT_NEAR(volume_share(turned(4.0, 0.0, 25.0)), 50.0, 1e-12);  // an opening plane: 4 / (4 + 2 + 2)
  EXPECT_EQ(volume_share({}), 0.0);
  EXPECT_EQ(type_of(50.0), SourceType::opening);
  EXPECT_EQ(type_of(30.0), SourceType::shear);
  EXPECT_EQ(type_of(-30.0), SourceType::shear);
  EXPECT_EQ(type_of(-31.0), SourceType::implosion);
}

TEST(EventSource, AMagnitudeIsOfTheStatedThickness) {
  AcousticEvent e;
  e.tensor = {0.0, 50.0, 0.0}, e.thickness = 0.002;  // 50 N m per m of thickness, 2 mm of it: 0.1 N m
  describe(e);
  EXPECT_NEAR(e.moment, 50.0, 1e-12);
  EXPECT_NEAR(e.magnitude, -6.0 - 2.0 / 3.0, 1e-12);
  EXPECT_EQ(e.type, SourceType::shear);
}

TEST(EventSource, TypesAreReadByTheirNames) {
  for (const SourceType type : all_source_types) EXPECT_EQ(source_type_of(to_string(type)), type);
  EXPECT_FALSE(source_type_of("loud"));
}

}  // namespace
}  // namespace phy::events
