// What a user should look at twice.
#include "survey/unusual.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace phy::survey {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using Kind = FindingKind;

std::vector<Kind> kinds(const std::vector<Finding>& found) {
  std::vector<Kind> list;
  for (const Finding& f : found) list.push_back(f.kind);
  return list;
}

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

TEST(UnusualValues, AnUsualRockPassesWithoutAWord) {
  EXPECT_THAT(unusual_values(
                  with({cell(Property::E, 0, 23e9), cell(Property::ucs, 0, 107e6), cell(Property::nu, 0, 0.1),
                        cell(Property::E, 90, 59e9), cell(Property::ucs, 90, 134e6),
                        cell(Property::brazilian, 90, 9e6), cell(Property::direct_tension, 0, 6e6)})),
              IsEmpty());
}

// E in MPa and UCS in kPa leave E/UCS as it was.
TEST(UnusualValues, UnitsOffByAThousandAreDoubted) {
  const auto both = unusual_values(with({cell(Property::E, 0, 0.023e9), cell(Property::ucs, 0, 0.11e6)}));
  ASSERT_THAT(kinds(both), ElementsAre(Kind::unusual_value, Kind::unusual_value));
  EXPECT_THAT(both[0].cells, ElementsAre(Cell{Property::E, 0.0}));
  EXPECT_DOUBLE_EQ(both[0].number("value"), 0.023e9);
  EXPECT_THAT(both[1].cells, ElementsAre(Cell{Property::ucs, 0.0}));
  EXPECT_EQ(both[1].advice, Advice::check_unit);
  const auto ratio = unusual_values(with({cell(Property::E, 0, 23e9), cell(Property::ucs, 0, 0.5e6)}));
  ASSERT_THAT(kinds(ratio), ElementsAre(Kind::unusual_modulus_ratio));
  EXPECT_DOUBLE_EQ(ratio[0].number("ratio"), 46000.0);
}

TEST(UnusualValues, APointLoadFarFromUcsIsDoubted) {
  const auto of = [](double index) {
    return unusual_values(with({cell(Property::ucs, 0, 100e6), cell(Property::point_load, 0, index)}));
  };
  EXPECT_THAT(of(4.2e6), IsEmpty());
  EXPECT_THAT(kinds(of(20e6)), ElementsAre(Kind::unusual_point_load));
  EXPECT_EQ(of(20e6)[0].number("ratio"), 5.0);
  EXPECT_THAT(kinds(of(0.5e6)), ElementsAre(Kind::unusual_point_load));
}

// At 60 degrees UCS of 40 MPa bears 17.3 MPa in shear under 10 MPa; 110 MPa of rock at most 55 MPa + 1.5
// sigma_n.
TEST(UnusualValues, ShearOfBeddingIsComparedWithUcs) {
  const auto of = [](double tau, double sigma_n) {
    RockReading shear = cell(Property::shear_peak, 0, tau);
    shear.confining = sigma_n;
    return unusual_values(with({cell(Property::ucs, 0, 110e6), cell(Property::ucs, 60, 40e6), shear}));
  };
  EXPECT_THAT(of(18e6, 12e6), IsEmpty());
  EXPECT_THAT(of(2e6, 1e6), IsEmpty()) << "under less stress it may carry less";
  ASSERT_THAT(kinds(of(2e6, 12e6)), ElementsAre(Kind::unusual_shear));
  EXPECT_NEAR(of(2e6, 12e6)[0].number("least"), 17.32e6, 1e4);
  EXPECT_EQ(of(2e6, 12e6)[0].cells[1], (Cell{Property::ucs, 60.0}));
  ASSERT_THAT(kinds(of(90e6, 12e6)), ElementsAre(Kind::unusual_shear));
  EXPECT_NEAR(of(90e6, 12e6)[0].number("most"), 73e6, 1.0);
}

// Radians among degrees, or percent: angles of a bedded rock that hardly differ.
TEST(UnusualValues, AnglesThatHardlyDifferAreDoubted) {
  const auto found = unusual_values(
      with({cell(Property::ucs, 3, 88e6), cell(Property::ucs, 5, 60e6), cell(Property::ucs, 9, 50e6)}));
  EXPECT_THAT(kinds(found), testing::Contains(Kind::narrow_angles));
  EXPECT_THAT(kinds(unusual_values(with({cell(Property::ucs, 0, 88e6), cell(Property::ucs, 15, 60e6),
                                         cell(Property::ucs, 30, 50e6)}))),
              testing::Not(testing::Contains(Kind::narrow_angles)));
}

TEST(UnusualValues, ToughnessInAnotherUnitIsDoubted) {
  const auto found = unusual_values(with({cell(Property::fracture_toughness, 0, 1e3)}));
  ASSERT_THAT(kinds(found), ElementsAre(Kind::unusual_value));
  EXPECT_EQ(found[0].number("least"), 0.03e6);
  EXPECT_EQ(found[0].number("most"), 10e6);
}

TEST(UnusualValues, ExchangedColumnsAreDoubted) {
  const auto exchanged = unusual_values(with({cell(Property::E, 0, 110e9), cell(Property::ucs, 0, 23e6)}));
  ASSERT_THAT(kinds(exchanged), ElementsAre(Kind::unusual_modulus_ratio));
  EXPECT_NEAR(exchanged[0].number("ratio"), 4783.0, 1.0);
  Rock plain = with({cell(Property::ucs, 0, 20e6), cell(Property::brazilian, 0, 11e6)});
  plain.bedded = false;
  const auto tension = unusual_values(plain);
  ASSERT_THAT(kinds(tension), ElementsAre(Kind::unusual_tension));
  EXPECT_DOUBLE_EQ(tension[0].number("ratio"), 0.55);
  EXPECT_TRUE(std::isnan(tension[0].cells.at(0).theta)) << "a rock without bedding has no angle";
}

TEST(UnusualValues, ReplicatesFarApartAreDoubtedWhereNoScatterIsGiven) {
  Rock rock =
      with({cell(Property::E, 0, 23e9, 2), cell(Property::E, 0, 80e9, 4), cell(Property::E, 0, 23.2e9, 3)});
  const auto apart = unusual_values(rock);
  ASSERT_THAT(kinds(apart), ElementsAre(Kind::replicates_apart));
  EXPECT_NEAR(apart[0].number("factor"), 80.0 / 23.0, 1e-12);
  EXPECT_THAT(apart[0].numbers, testing::IsSupersetOf({NamedNumber{"line", 2.0}, NamedNumber{"line", 4.0}}));
  for (RockReading& r : rock.readings) r.sd = 11e9;
  EXPECT_THAT(unusual_values(rock), IsEmpty());
}

TEST(UnusualValues, RowsThatStandTwiceAreDoubted) {
  Rock rock =
      with({cell(Property::E, 0, 23e9, 2), cell(Property::ucs, 0, 100e6, 2), cell(Property::E, 90, 40e9, 3),
            cell(Property::E, 0, 23e9, 4), cell(Property::ucs, 0, 100e6, 4)});
  const auto twice = unusual_values(rock);
  ASSERT_THAT(kinds(twice), ElementsAre(Kind::rows_repeated));
  EXPECT_THAT(twice[0].numbers, ElementsAre(NamedNumber{"line", 2.0}, NamedNumber{"copy", 4.0}));
  EXPECT_EQ(twice[0].cells, (std::vector<Cell>{{Property::E, 0.0}, {Property::ucs, 0.0}}));
  rock.readings.back().value = 101e6;
  EXPECT_THAT(unusual_values(rock), IsEmpty()) << "another specimen, of the same E";
  rock.readings.back().value = 100e6, rock.readings[3].n = 3;
  EXPECT_THAT(unusual_values(rock), IsEmpty()) << "of other specimens";
}

TEST(UnusualValues, AnSdBeyondEveryRockIsDoubted) {
  Rock rock = with({cell(Property::ucs, 0, 100e6, 2), cell(Property::ucs, 45, 60e6, 3)});
  rock.readings[0].n = rock.readings[1].n = 3;
  rock.readings[0].sd = 300e6, rock.readings[1].sd = 6e6;
  const auto wide = unusual_values(rock);
  ASSERT_THAT(kinds(wide), ElementsAre(Kind::unusual_scatter));
  EXPECT_EQ(wide[0].number("line"), 2.0);
  EXPECT_DOUBLE_EQ(wide[0].number("share"), 3.0);
  rock.readings[0].sd = 0.07e6;  // a share of the value in a column of MPa
  const auto narrow = unusual_values(rock);
  ASSERT_THAT(kinds(narrow), ElementsAre(Kind::unusual_scatter));
  EXPECT_DOUBLE_EQ(narrow[0].number("share"), 0.0007);
  rock.readings[0].sd = 0.5e6;
  EXPECT_THAT(unusual_values(rock), IsEmpty());
}

RockReading confined(double theta, double sigma_3, double value) {
  RockReading r = cell(Property::confined, theta, value);
  r.confining = sigma_3;
  return r;
}

TEST(UnusualValues, UcsThatNoEnvelopeMeetsIsDoubted) {
  // through (5, 140) and (20, 200) MPa: 120 MPa without confinement
  const std::vector<RockReading> envelope = {confined(45, 5e6, 140e6), confined(45, 20e6, 200e6)};
  const auto about = [&](double ucs) {
    std::vector<RockReading> all = envelope;
    all.push_back(cell(Property::ucs, 45, ucs));
    return unusual_values(with(all));
  };
  const auto found = about(60e6);
  ASSERT_THAT(kinds(found), ElementsAre(Kind::off_envelope));
  EXPECT_THAT(found[0].cells, ElementsAre(Cell{Property::ucs, 45.0}));
  EXPECT_NEAR(found[0].number("envelope"), 120e6, 1.0);
  EXPECT_EQ(found[0].number("from"), 5e6);
  EXPECT_EQ(found[0].number("to"), 20e6);
  EXPECT_THAT(about(100e6), IsEmpty());
}

TEST(UnusualValues, StressesThatAreAlikeAreOneTestAndNoEnvelope) {
  const std::vector<RockReading> readings = {cell(Property::ucs, 45, 97e6), confined(45, 4.98e6, 128e6),
                                             confined(45, 5.02e6, 121e6), confined(45, 5.05e6, 131e6)};
  EXPECT_THAT(unusual_values(with(readings)), IsEmpty());
  const std::vector<Target> targets = of_property(targets_of(with(readings)), Property::confined);
  ASSERT_EQ(targets.size(), 1U);
  EXPECT_EQ(targets[0].n, 3);
  EXPECT_NEAR(targets[0].confining, 5.0167e6, 1e3);
}

TEST(UnusualValues, StrengthThatFallsUnderConfinementIsDoubted) {
  // three specimens each that scatter by 2 %
  const auto of_three = [](RockReading r) {
    r.n = 3, r.sd = 0.02 * r.value;
    return r;
  };
  const auto about = [&](const RockReading& sigma_1) {
    return unusual_values(with({of_three(cell(Property::ucs, 0, 100e6)), of_three(sigma_1)}));
  };
  const auto falls = about(confined(0, 10e6, 60e6));
  ASSERT_THAT(kinds(falls), ElementsAre(Kind::strength_falls));
  EXPECT_DOUBLE_EQ(falls[0].number("from"), 100e6);
  EXPECT_DOUBLE_EQ(falls[0].number("to"), 50e6);
  EXPECT_EQ(falls[0].cells.at(1).confining, 10e6);
  EXPECT_THAT(about(confined(0, 10e6, 107e6)), IsEmpty());  // by chance, and the strength itself has grown
  EXPECT_THAT(about(confined(30, 10e6, 60e6)), IsEmpty());  // another angle
}

TEST(UnusualValues, AConversionInPartIsReported) {
  Rock rock = with({cell(Property::E, 0, 20e9), cell(Property::nu, 30, 0.2), cell(Property::E, 60, 30e9),
                    cell(Property::nu, 60, 0.25)});
  rock.reading = ElasticReading::plane_strain;
  const auto found = conversion_in_part(rock);
  ASSERT_THAT(kinds(found), ElementsAre(Kind::along_bedding_taken, Kind::not_converted));
  EXPECT_THAT(found[0].cells, ElementsAre(Cell{Property::E, 60.0}, Cell{Property::nu, 60.0}));
  EXPECT_THAT(found[1].cells, ElementsAre(Cell{Property::nu, 30.0}));
  rock.reading = ElasticReading::plane_stress;
  EXPECT_THAT(conversion_in_part(rock), IsEmpty());
}

// 1/E_2D = 1/E - nu^2/E(90): a table of 195 GPa does not become one that hardly any rock has.
TEST(UnusualValues, WhatIsDoubtedIsTheTableAndNotItsConversion) {
  Rock rock = with({cell(Property::E, 0, 180e9), cell(Property::E, 90, 195e9), cell(Property::nu, 0, 0.25),
                    cell(Property::nu, 90, 0.27)});
  rock.reading = ElasticReading::plane_strain;
  ASSERT_GT(targets_of(rock)[1].mean, 200e9);
  EXPECT_THAT(unusual_values(rock), IsEmpty());
}

}  // namespace
}  // namespace phy::survey
