#include "calibrate/eq2.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "calibrate/paper_press_fixture.hpp"

namespace phy::calibrate {
namespace {

Recipe jointed(BeddingRule rule) {
  Recipe r;
  r.bedding.resize(1);
  r.bedding.front().rule = rule;
  return r;
}

std::vector<std::string> names(const std::vector<StiffnessRelation>& band) {
  std::vector<std::string> all;
  for (const StiffnessRelation& line : band) all.push_back(line.setting);
  return all;
}

// The press on paper has planes that are 1.8 times as stiff as their joints, whatever their spacing.
TEST(Eq2, FindsTheLineBetweenPlanesAndJoints) {
  PaperPress press;
  const std::vector<StiffnessRelation> band = eq2_band(jointed(BeddingRule::zone), {1, 2, 3}, press);
  EXPECT_THAT(names(band),
              testing::ElementsAre("as calibrated", "spacing x 0.7", "spacing x 1.4", "rule crossing",
                                   "zone thickness x 0.7", "zone thickness x 1.4"));
  for (const StiffnessRelation& line : band)
    for (const LineFit& fit : {line.normal, line.shear}) {
      EXPECT_EQ(fit.n, 3U);
      EXPECT_NEAR(fit.slope, 1.8, 1e-6) << line.setting;
      EXPECT_NEAR(fit.intercept, 0.0, 1e-6 * 3360e9) << line.setting;
    }
}

TEST(Eq2, ZonesAsThickAsTheSpacingAreNoSetting) {
  PaperPress press;
  Recipe r = jointed(BeddingRule::crossing);
  r.bedding.front().zone_thickness = 0.8 * r.bedding.front().spacing;
  EXPECT_THAT(
      names(eq2_band(r, {1}, press)),
      testing::ElementsAre("as calibrated", "spacing x 0.7", "spacing x 1.4", "rule zone, thickness 4 mm"));
  r.bedding.front().rule = BeddingRule::zone;
  EXPECT_THAT(names(eq2_band(r, {1}, press)), testing::ElementsAre("as calibrated", "spacing x 1.4",
                                                                   "rule crossing", "zone thickness x 0.7"));
}

TEST(Eq2, IsOfPlanesInAMatrixWithoutDirections) {
  PaperPress press;
  EXPECT_TRUE(eq2_band(Recipe(), {1}, press).empty());
  Recipe r = jointed(BeddingRule::zone);
  r.matrix.stiffness_ratio = 1.5;
  EXPECT_TRUE(eq2_band(r, {1}, press).empty());
  r = jointed(BeddingRule::oriented);
  EXPECT_TRUE(eq2_band(r, {1}, press).empty());
}

// No answer of the direct solution: no line, and no wrong one.
TEST(Eq2, WithoutModuliThereIsNoLine) {
  PaperPress press;
  press.carries_load = false;
  for (const StiffnessRelation& line : eq2_band(jointed(BeddingRule::crossing), {1}, press))
    EXPECT_FALSE(std::isfinite(line.normal.slope) || std::isfinite(line.shear.slope));
}

}  // namespace
}  // namespace phy::calibrate
