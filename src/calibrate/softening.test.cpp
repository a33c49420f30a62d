// What tests make of the moduli: in which tests it is read, when it is settled, how far a step goes.
#include "calibrate/softening.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "records/reading_fixture.hpp"

namespace phy::calibrate {
namespace {

/// Without a stress on the sides.
TestRead at(double theta) { return {0.0, theta}; }

TEST(Softening, IsSettledWhereNoModulusMovesByOnePercent) {
  EXPECT_TRUE(settled({{at(0), {0.8, 0.02}}, {at(90), {0.9, 0.0}}},
                      {{at(0), {0.806, 0.025}}, {at(90), {0.893, 0.0}}}));
  EXPECT_FALSE(settled({{at(0), {0.8, 0.02}}}, {{at(0), {0.8, 0.04}}})) << "nu moves";
  EXPECT_FALSE(
      settled({{at(0), {0.8, 0.0}}, {at(90), {0.9, 0.0}}}, {{at(0), {0.8, 0.0}}, {at(90), {0.91, 0.0}}}));
  EXPECT_FALSE(settled({}, {{at(0), {0.95, 0.0}}})) << "nothing was taken off before";
  EXPECT_TRUE(settled({}, {{at(0), {0.995, 0.0}}}));
}

// A press whose softening answers each step by half of it in the other direction: whole steps swing for long.
TEST(Softening, StepsSettleWhereWholeOnesSwing) {
  const auto press = [](double used) { return 0.7 * std::pow(used / 0.7, -0.54); };
  Softenings used = {{at(45), {1.0, 0.0}}};
  double whole = 1.0;
  for (int pass = 0; pass < 3; ++pass) {
    used = stepped(used, {{at(45), {press(used.at(at(45)).factor), 0.1}}});
    whole = press(whole);
  }
  EXPECT_NEAR(used.at(at(45)).factor, 0.7, 1e-3);
  EXPECT_GT(std::fabs(whole - 0.7), 0.03);
  EXPECT_GT(used.at(at(45)).addition, 0.09);
}

TEST(Softening, BetweenInclinationsIsThatOfTheNearestStress) {
  const Softenings known = {{{0.0, 0.0}, {0.8, 0.0}},
                            {{0.0, 90.0}, {0.9, 0.1}},
                            {{20e6, 30.0}, {1.0, 0.0}},
                            {{20e6, 60.0}, {1.1, 0.0}}};
  EXPECT_NEAR(softening_at(known, {0.0, 45.0}).factor, 0.85, 1e-12);
  EXPECT_NEAR(softening_at(known, {5e6, 45.0}).addition, 0.05, 1e-12) << "nearer to none than to 20 MPa";
  EXPECT_NEAR(softening_at(known, {20e6, 45.0}).factor, 1.05, 1e-12);
  EXPECT_EQ(softening_at(known, {50e6, 0.0}).factor, 1.0) << "beyond the inclinations as at the last";
  EXPECT_EQ(softening_at(known, {12e6, 90.0}).factor, 1.1);
  EXPECT_EQ(softening_at({}, {0.0, 45.0}).factor, 1.0);
}

RockReading under(double confining, Property property, double theta, double value) {
  RockReading r = reading(property, theta, value);
  r.confining = confining;
  return r;
}

TEST(Softening, ModuliAreReadInTestsOfTheirOwnStress) {
  Rock rock;
  rock.bedded = false, rock.E_is = ModulusReading::tangent_50;
  rock.readings = {under(0.0, Property::E, 0.0, 40e9), under(0.0, Property::ucs, 0.0, 100e6),
                   under(10e6, Property::E, 0.0, 44e9), under(10e6, Property::confined, 0.0, 150e6),
                   under(20e6, Property::confined, 0.0, 190e6)};
  const std::vector<Target> tests = tests_to_read(Evidence(rock));
  ASSERT_EQ(tests.size(), 2U);
  EXPECT_EQ(tests.front().property, Property::ucs);
  EXPECT_EQ(tests.back().confining, 10e6) << "under 20 MPa no modulus was measured";
  rock.readings.push_back(under(30e6, Property::E, 0.0, 46e9));
  const Evidence evidence(rock);
  ASSERT_EQ(evidence.read_only.size(), 1U);
  EXPECT_EQ(evidence.strengths.size(), 3U);
  EXPECT_EQ(tests_to_read(evidence).back().confining, 30e6) << "a test for the modulus alone";
  EXPECT_GT(evidence.read_only.front().mean, 190e6);
  rock.E_is = ModulusReading::small_strain;
  EXPECT_TRUE(Evidence(rock).read_only.empty());
}

}  // namespace
}  // namespace phy::calibrate
