#include "survey/half_discs.hpp"

#include <gtest/gtest.h>

#include "records/reading_fixture.hpp"

namespace phy::survey {
namespace {

TEST(GrainsBetweenPlanes, TooFewAreNamedWithTheSizeThatWouldDo) {
  Rock rock;
  rock.readings = {reading(Property::E, 0.0, 20e9)};
  rock.model.bedding.resize(1), rock.model.bedding[0].spacing = 4e-3;
  rock.model.packing.radius_min = rock.model.packing.radius_max = 0.6e-3;
  EXPECT_TRUE(few_grains_between(Evidence(rock)).empty());
  rock.model.bedding[0].spacing = 3e-3;
  const std::vector<Finding> found = few_grains_between(Evidence(rock));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].number("grains"), 2.5, 1e-9);
  EXPECT_NEAR(found[0].number("wanted"), 1e-3, 1e-9);
  rock.model.bedding.clear();
  EXPECT_TRUE(few_grains_between(Evidence(rock)).empty());
}

// A radius of 19 mm holds 28 grains of 0.665 mm, and 12 of 1.5 mm.
TEST(HalfDiscs, OfFewGrainsInTheRadiusAreNamedOnce) {
  Rock rock;
  for (const double theta : {0.0, 90.0})
    rock.readings.push_back(reading(Property::fracture_toughness, theta, 1e6));
  rock.model.test.disc_diameter = 0.038;
  const auto coarse = [&](double least, double most) {
    rock.model.packing.radius_min = least, rock.model.packing.radius_max = most;
    return coarse_half_discs(Evidence(rock));
  };
  EXPECT_TRUE(coarse(0.0002825, 0.0003825).empty());
  const std::vector<Finding> found = coarse(0.0005, 0.001);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].number("grains"), 12.0);
  EXPECT_EQ(found[0].number("radius"), 0.019);
  EXPECT_NEAR(found[0].number("wanted"), 0.95e-3, 1e-9);
  EXPECT_TRUE(coarse(0.00038, 0.00057).empty()) << "the advice was taken";
}

}  // namespace
}  // namespace phy::survey
