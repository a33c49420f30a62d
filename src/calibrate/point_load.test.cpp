// Point load strength, from the table of a laboratory to the test that answers it: a Brazilian one, of whose
// strength it is 0.8.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "calibrate/parameters.hpp"
#include "calibrate/strength_tests.hpp"
#include "maps/prior_regression.hpp"
#include "records/reading_fixture.hpp"
#include "rock/file_fixture.hpp"

namespace phy::calibrate {
namespace {

class PointLoad : public rock::RockFile {};

TEST_F(PointLoad, IsReadUnderTheNamesOfLaboratories) {
  for (const char* header : {"I_s50 [MPa]", "I_s(50) (MPa)", "Is50 (MPa)", "Is(50) [MPa]", "Is(50)",
                             "Is [MPa]", "PLT (MPa)", "Point load (MPa)"}) {
    const std::string unit = std::string(header) == "Is(50)" ? ",,MPa,MPa\n" : "";
    const Rock r = rock(std::string("theta [deg],E [GPa],UCS") + (unit.empty() ? " [MPa]," : ",") + header +
                        "\n" + unit + "0,23,105,4\n45,20,53,\n90,59,138,6\n");
    const std::vector<Target> found = of_property(targets_of(r), Property::point_load);
    ASSERT_EQ(found.size(), 2U) << header;
    EXPECT_EQ(found.front().mean, 4e6) << header;
  }
}

Target tension(Property property, double mean) {
  Target t;
  t.property = property, t.mean = mean, t.sd = 0.1 * mean;
  return t;
}

// Loaded as a disc whose Brazilian strength is that of the relation.
TEST(PointLoadTest, IsABrazilianTestOfTheStrengthThatItStandsFor) {
  const std::vector<Target> both = {tension(Property::point_load, 4e6), tension(Property::brazilian, 5e6)};
  const StrengthTests tests(Recipe(), both, std::vector<double>(2, 50e9));
  const TestRecipe point = tests.of(Recipe(), 0, 1, as_measured).test,
                   disc = tests.of(Recipe(), 1, 1, as_measured).test;
  EXPECT_EQ(point.kind, TestKind("brazilian"));
  EXPECT_NEAR(point.platen_speed / disc.platen_speed, 1.0, 1e-12);
  EXPECT_NEAR(point.approach_strain / disc.approach_strain, 1.0, 1e-12);
  TestResult broken;
  broken.outcome.status = Status::peaked;
  broken.numbers = {{"bts", 5e6, "Pa", "", ""}};
  EXPECT_EQ(strength_of(broken, Property::brazilian), 5e6);
  EXPECT_NEAR(strength_of(broken, Property::point_load), 4e6, 1e-6);
}

TEST(PointLoadTest, IsExpectedAsAShareOfTheBrazilianStrength) {
  Rock rock;
  rock.model.bedding.resize(1), rock.model.bedding[0].rule = BeddingRule::crossing;
  rock.readings = {reading(Property::ucs, 0.0, 100e6), reading(Property::brazilian, 45.0, 8e6),
                   reading(Property::point_load, 45.0, 6e6)};
  const Evidence evidence(rock);
  const std::vector<double> z(strength_ratios(evidence).size(), 0.2);
  const auto expected = [&](Property p) {
    Target t = tension(p, 6e6);
    t.theta = 30.0;
    return maps::prior_strength(evidence, rock.model, t).value(z);
  };
  EXPECT_NEAR(expected(Property::point_load) - expected(Property::brazilian), std::log(0.8), 1e-12);
}

TEST(PointLoadTest, DeterminesTheRatioOfTheBondsBesideUcs) {
  Rock rock;
  rock.bedded = false;
  rock.readings = {reading(Property::ucs, 0.0, 100e6)};
  EXPECT_FALSE(matrix_tau_c.strength->rule(Evidence(rock)).held);
  rock.readings.push_back(reading(Property::point_load, 0.0, 6e6));
  EXPECT_TRUE(matrix_tau_c.strength->rule(Evidence(rock)).held);
}

}  // namespace
}  // namespace phy::calibrate
