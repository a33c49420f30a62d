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

std::vector<std::string> names(const std::vector<PlaneStiffness>& band) {
  std::vector<std::string> all;
  for (const PlaneStiffness& line : band) all.push_back(line.planes);
  return all;
}

TEST(Eq2, IsOfWholePlanes) {
  Recipe r = jointed(BeddingRule::crossing);
  EXPECT_TRUE(has_eq2(r));
  r.bedding[0].persistence = 0.65;
  EXPECT_FALSE(has_eq2(r));
}

// The press on paper has planes that are 1.8 times as stiff as their joints, whatever their spacing.
TEST(Eq2, FindsTheLineBetweenPlanesAndJoints) {
  PaperPress press;
  const std::vector<PlaneStiffness> band = eq2_band(jointed(BeddingRule::zone), {1, 2, 3}, press);
  EXPECT_THAT(names(band),
              testing::ElementsAre("as calibrated", "spacing x 0.7", "spacing x 1.4", "rule crossing",
                                   "zone thickness x 0.7", "zone thickness x 1.4"));
  for (const PlaneStiffness& line : band)
    for (const StiffnessRelation& r : {line.normal, line.shear}) {
      EXPECT_EQ(r.line.n, 3U);
      EXPECT_NEAR(r.ratio, 1.8, 1e-6) << line.planes;
      EXPECT_NEAR(r.line.slope, 1.8, 1e-6) << line.planes;
      EXPECT_NEAR(r.line.intercept, 0.0, 1e-6 * 3360e9) << line.planes;
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
  EXPECT_TRUE(has_eq2(jointed(BeddingRule::zone)));
  EXPECT_FALSE(has_eq2(Recipe()));
  Recipe r = jointed(BeddingRule::zone);
  r.matrix.stiffness_ratio = 1.5;
  EXPECT_FALSE(has_eq2(r));
  EXPECT_FALSE(has_eq2(jointed(BeddingRule::oriented)));
}

/// Planes of joints with at most half of their stiffness are none that Eq. 1 has: the rock is stiffest
/// across.
class HalfOfIt : public PaperPress {
 public:
  std::vector<ElasticResult> solve(const std::vector<Recipe>& recipes, Statics what) override {
    std::vector<ElasticResult> results = PaperPress::solve(recipes, what);
    for (std::size_t i = 0; i < recipes.size(); ++i)
      if (recipes[i].bedding.front().k_n < 2000e9 && recipes[i].bedding.front().theta < 90.0)
        results[i].E_gauge = 2e11;
    return results;
  }
};

// A line through what two of three give would look perfect.
TEST(Eq2, ALineHasAllThreePoints) {
  HalfOfIt press;
  const PlaneStiffness line = eq2_band(jointed(BeddingRule::crossing), {1}, press).front();
  EXPECT_FALSE(std::isfinite(line.normal.line.slope) || std::isfinite(line.normal.ratio));
  EXPECT_NEAR(line.shear.line.slope, 1.8, 1e-6);
  press.carries_load = false;
  for (const PlaneStiffness& l : eq2_band(jointed(BeddingRule::crossing), {1}, press))
    EXPECT_FALSE(std::isfinite(l.normal.line.slope) || std::isfinite(l.shear.line.slope));
}

}  // namespace
}  // namespace phy::calibrate
