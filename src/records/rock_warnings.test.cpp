// What a user is told to look at twice.
#include "records/rock_warnings.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace phy {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

RockReading cell(Property property, double theta, double value, int line = 0) {
  RockReading r;
  r.property = property, r.theta = theta, r.value = value, r.line = line;
  return r;
}

Rock with(const std::vector<RockReading>& readings) {
  Rock rock;
  rock.readings = readings;
  return rock;
}

TEST(RockWarnings, AnUsualRockPassesWithoutAWord) {
  EXPECT_THAT(warnings_about(
                  with({cell(Property::E, 0, 23e9), cell(Property::ucs, 0, 107e6), cell(Property::nu, 0, 0.1),
                        cell(Property::E, 90, 59e9), cell(Property::ucs, 90, 134e6),
                        cell(Property::brazilian, 90, 9e6), cell(Property::direct_tension, 0, 6e6)})),
              IsEmpty());
}

// E in MPa and UCS in kPa leave E/UCS as it was.
TEST(RockWarnings, UnitsOffByAThousandAreDoubted) {
  EXPECT_THAT(warnings_about(with({cell(Property::E, 0, 0.023e9), cell(Property::ucs, 0, 0.11e6)})),
              ElementsAre(AllOf(HasSubstr("E(0) = 0.023 GPa"), HasSubstr("unit in the header")),
                          AllOf(HasSubstr("UCS(0) = 0.11 MPa"), HasSubstr("unit in the header"))));
  EXPECT_THAT(warnings_about(with({cell(Property::E, 0, 23e9), cell(Property::ucs, 0, 0.5e6)})),
              ElementsAre(AllOf(HasSubstr("E/UCS(0) = 4.6e+04"), HasSubstr("Deere & Miller 1966"))));
}

TEST(RockWarnings, ExchangedColumnsAreDoubted) {
  EXPECT_THAT(warnings_about(with({cell(Property::E, 0, 110e9), cell(Property::ucs, 0, 23e6)})),
              ElementsAre(HasSubstr("E/UCS(0) = 4783")));
  Rock plain = with({cell(Property::ucs, 0, 20e6), cell(Property::brazilian, 0, 11e6)});
  plain.bedded = false;
  EXPECT_THAT(warnings_about(plain), ElementsAre(HasSubstr("BTS = 0.55 UCS")));
}

TEST(RockWarnings, ReplicatesFarApartAreDoubtedWhereNoScatterIsGiven) {
  Rock rock =
      with({cell(Property::E, 0, 23e9, 2), cell(Property::E, 0, 80e9, 4), cell(Property::E, 0, 23.2e9, 3)});
  EXPECT_THAT(warnings_about(rock), ElementsAre(HasSubstr("E(0) of lines 2 and 4 differs by a factor 3.5")));
  for (RockReading& r : rock.readings) r.sd = 11e9;
  EXPECT_THAT(warnings_about(rock), IsEmpty());
}

TEST(RockWarnings, AnSdAsLargeAsItsValueIsDoubted) {
  Rock rock = with({cell(Property::ucs, 0, 100e6, 2), cell(Property::ucs, 45, 60e6, 3)});
  rock.readings[0].n = rock.readings[1].n = 3;
  rock.readings[0].sd = 300e6, rock.readings[1].sd = 6e6;
  EXPECT_THAT(warnings_about(rock),
              ElementsAre(AllOf(HasSubstr("the SD of UCS(0) (line 2) is 3 of the value"),
                                HasSubstr("check the unit and the column"))));
}

RockReading confined(double theta, double sigma_3, double value) {
  RockReading r = cell(Property::confined, theta, value);
  r.confining = sigma_3;
  return r;
}

TEST(RockWarnings, UcsThatNoEnvelopeMeetsIsDoubted) {
  // through (5, 140) and (20, 200) MPa: 120 MPa without confinement
  const std::vector<RockReading> envelope = {confined(45, 5e6, 140e6), confined(45, 20e6, 200e6)};
  const auto about = [&](double ucs) {
    std::vector<RockReading> all = envelope;
    all.push_back(cell(Property::ucs, 45, ucs));
    return warnings_about(with(all));
  };
  EXPECT_THAT(about(60e6), ElementsAre(AllOf(HasSubstr("UCS(45) = 60 MPa, and 120 MPa by the line"),
                                             HasSubstr("under 5 to 20 MPa"))));
  EXPECT_THAT(about(100e6), IsEmpty());
}

TEST(RockWarnings, StressesThatAreAlikeAreOneTestAndNoEnvelope) {
  const std::vector<RockReading> readings = {cell(Property::ucs, 45, 97e6), confined(45, 4.98e6, 128e6),
                                             confined(45, 5.02e6, 121e6), confined(45, 5.05e6, 131e6)};
  EXPECT_THAT(warnings_about(with(readings)), IsEmpty());
  const std::vector<Target> targets = of_property(targets_of(with(readings)), Property::confined);
  ASSERT_EQ(targets.size(), 1U);
  EXPECT_EQ(targets[0].n, 3);
  EXPECT_NEAR(targets[0].confining, 5.0167e6, 1e3);
}

TEST(RockWarnings, StrengthThatFallsUnderConfinementIsDoubted) {
  // three specimens each that scatter by 2 %
  const auto of_three = [](RockReading r) {
    r.n = 3, r.sd = 0.02 * r.value;
    return r;
  };
  const auto about = [&](const RockReading& sigma_1) {
    return warnings_about(with({of_three(cell(Property::ucs, 0, 100e6)), of_three(sigma_1)}));
  };
  EXPECT_THAT(about(confined(0, 10e6, 60e6)),
              ElementsAre(AllOf(HasSubstr("falls from 100 MPa under 0 to 50 MPa under 10 MPa"),
                                HasSubstr("takes no rock's"))));
  EXPECT_THAT(about(confined(0, 10e6, 107e6)), IsEmpty());  // by chance, and the strength itself has grown
  EXPECT_THAT(about(confined(30, 10e6, 60e6)), IsEmpty());  // another angle
}

TEST(RockWarnings, AConversionInPartIsTold) {
  Rock rock = with({cell(Property::E, 0, 20e9), cell(Property::nu, 30, 0.2), cell(Property::E, 60, 30e9),
                    cell(Property::nu, 60, 0.25)});
  rock.reading = ElasticReading::plane_strain;
  EXPECT_THAT(warnings_about(rock),
              ElementsAre(AllOf(HasSubstr("E(60), nu(60)"), HasSubstr("along the bedding")),
                          AllOf(HasSubstr("nu(30)"), HasSubstr("not converted"))));
  rock.reading = ElasticReading::plane_stress;
  EXPECT_THAT(warnings_about(rock), IsEmpty());
}

// 1/E_2D = 1/E - nu^2/E(90): a table of 195 GPa does not become one that hardly any rock has.
TEST(RockWarnings, WhatIsDoubtedIsTheTableAndNotItsConversion) {
  Rock rock = with({cell(Property::E, 0, 180e9), cell(Property::E, 90, 195e9), cell(Property::nu, 0, 0.25),
                    cell(Property::nu, 90, 0.27)});
  rock.reading = ElasticReading::plane_strain;
  ASSERT_GT(targets_of(rock)[1].mean, 200e9);
  EXPECT_THAT(warnings_about(rock), IsEmpty());
}

}  // namespace
}  // namespace phy
