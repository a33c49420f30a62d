#include "calibrate/strength_tests.hpp"

#include <gtest/gtest.h>

#include "calibrate/elastic_response.hpp"
#include "calibrate/paper_press_fixture.hpp"

namespace phy::calibrate {
namespace {

/// UCS of 100 MPa and 250 MPa under 50 MPa, of a rock with E = 50 GPa: peaks at strains of 0.2 and 0.4 %.
class Loaded : public testing::Test {
 protected:
  static Target target(Property property, double mean, double confining) {
    Target t{property, 0.0, mean, 1e6, 3, false};
    t.confining = confining;
    return t;
  }
  const std::vector<Target> targets_ = {target(Property::ucs, 100e6, 0.0),
                                        target(Property::confined, 250e6, 50e6),
                                        target(Property::brazilian, 10e6, 0.0)};
  const StrengthTests tests_ = {Recipe(), targets_, std::vector<double>(3, 50e9)};

  TestRecipe test(std::size_t i, const Loading& loading,
                  double foreseen = std::numeric_limits<double>::infinity()) const {
    return tests_.of(Recipe(), i, 1, loading, foreseen).test;
  }
};

TEST_F(Loaded, FromRestThereIsNoApproach) {
  EXPECT_EQ(test(0, from_rest).approach_strain, 0.0);
  EXPECT_EQ(test(0, from_rest).approach_speed, 0.0);
}

// E at half of the strength is read from 40 % of it on.
TEST_F(Loaded, TheApproachEndsBeforeAModulusIsRead) {
  EXPECT_NEAR(test(0, as_measured).approach_strain, 0.25 * 0.002, 1e-12);
  EXPECT_EQ(test(0, as_measured).platen_speed, test(0, from_rest).platen_speed);
  EXPECT_NEAR(test(0, as_measured).approach_speed, 3.0 * test(0, from_rest).platen_speed, 1e-12);
  EXPECT_EQ(test(0, search_with_moduli).approach_strain, test(0, as_measured).approach_strain);
}

TEST_F(Loaded, WhereNoModulusIsReadTheVerificationApproachesFarther) {
  EXPECT_EQ(test(0, strengths_as_measured).platen_speed, test(0, from_rest).platen_speed);
  EXPECT_NEAR(test(0, strengths_as_measured).approach_strain, 0.6 * 0.002, 1e-12);
}

/// What is pressed: approach strains, packing by packing.
class Approaches : public PaperPress {
 public:
  std::vector<double> strains;
  std::vector<TestResult> run(const std::vector<Recipe>& recipes) override {
    for (const Recipe& r : recipes) strains.push_back(r.test.approach_strain);
    return PaperPress::run(recipes);
  }
};

// 200 MPa are expected of a rock with E = 180 GPa on paper (0.9 times twice 100 GPa), 120 of the model.
TEST(StrengthResponse, ReadsModuliOfThePackingsThatAreApproachedSlowly) {
  Recipe rock;
  rock.matrix.E_c = rock.matrix.E_b = 100e9;
  const Target ucs = {Property::ucs, 0.0, 200e6, 1e6, 3, false};
  const double peak = 200e6 / 180e9;
  const auto pressed = [&](const Loadings& loadings, std::vector<Comparison>& moduli) {
    Approaches press;
    TestSeries series(rock, {ucs}, 7, loadings, press);
    series.take({7, 8, 9});
    moduli = series.moduli(ModulusReading::tangent_50);
    return press.strains;
  };
  std::vector<Comparison> moduli;
  std::vector<double> strains = pressed(of_verification(true, {120e6}), moduli);
  for (const double strain : strains) EXPECT_NEAR(strain, 0.25 * peak, 1e-9);
  for (const Comparison& c : moduli) EXPECT_EQ(c.n_packings, 3);
  strains = pressed(of_verification(false, {120e6}), moduli);
  ASSERT_EQ(strains.size(), 3U);
  EXPECT_NEAR(strains[0], 0.25 * peak, 1e-9) << "its curve is shown";
  for (const std::size_t k : {1, 2}) EXPECT_NEAR(strains[k], 0.6 * 0.6 * peak, 1e-9);
  ASSERT_EQ(moduli.size(), 2U);
  for (const Comparison& c : moduli) EXPECT_EQ(c.n_packings, 1);
}

TEST_F(Loaded, TheSearchIsFasterAndApproachesFarther) {
  const double slow = test(0, from_rest).platen_speed;
  EXPECT_NEAR(test(0, search_of_strengths).platen_speed, 1.4 * slow, 1e-12);
  EXPECT_NEAR(test(0, search_of_strengths).approach_speed, 4.2 * slow, 1e-12);
  EXPECT_NEAR(test(0, search_of_strengths).approach_strain, 0.7 * 0.002, 1e-12);
  EXPECT_NEAR(test(1, search_of_strengths).approach_strain, 0.7 * 0.004, 1e-12)
      << "stress grows from the confinement on";
}

// E is that of the stress which the platens bring on.
// One draw for all packings would give every specimen the bridges of the others.
// Gaps that are bonded grow with the grains: the same share of pairs is.
TEST(Coarse, GapsOfBondsGrowWithTheGrains) {
  Recipe r;
  r.matrix.bond_gap = 1e-5;
  const Recipe large = coarse(r);
  EXPECT_GT(large.packing.radius_min, 1.5 * r.packing.radius_min);
  EXPECT_DOUBLE_EQ(large.matrix.bond_gap / large.packing.radius_min,
                   r.matrix.bond_gap / r.packing.radius_min);
}

TEST(SingleAt, EachPackingHasBridgesOfItsOwn) {
  Recipe r;
  r.bedding.resize(1), r.matrix.bond_seed = 9;
  EXPECT_EQ(single_at(r, 30.0, 4).matrix.bond_seed, 9);
  r.bedding[0].persistence = 0.5;
  EXPECT_EQ(single_at(r, 30.0, 4).matrix.bond_seed, 4);
  EXPECT_EQ(single_at(r, 60.0, 5).matrix.bond_seed, 5);
  EXPECT_EQ(single_at(r, 60.0, 5).packing.seed, 5);
}

TEST(ModulusOf, AtThePeakIsTheSecantOfTheDeviatoricStress) {
  TestResult free, confined;
  free.outcome.status = confined.outcome.status = Status::peaked;
  free.numbers = {{"ucs", 100e6, "Pa", "", ""}, {"peak_strain", 0.002, "1", "", ""}};
  confined.numbers = {
      {"q_max", 150e6, "Pa", "", ""}, {"sigma_1", 200e6, "Pa", "", ""}, {"peak_strain", 0.0025, "1", "", ""}};
  EXPECT_NEAR(modulus_of(free, Property::ucs, ModulusReading::secant_at_peak), 50e9, 1.0);
  EXPECT_NEAR(modulus_of(confined, Property::confined, ModulusReading::secant_at_peak), 60e9, 1.0);
}

// The tests of a rock are loaded as the calibration has it, whatever the recipe of the model says.
TEST_F(Loaded, SettingsKeepNoPreStrainAndNoApproachOfTheModel) {
  Recipe model;
  model.test.pre_strain = 1e-3, model.test.approach_strain = 5e-3, model.test.approach_speed = 1.0;
  const Recipe settings = test_settings(model, targets_, std::vector<double>(3, 50e9));
  EXPECT_EQ(settings.test.pre_strain, 0.0);
  EXPECT_EQ(settings.test.approach_strain, 0.0);
  EXPECT_EQ(settings.test.approach_speed, 0.0);
  EXPECT_EQ(tests_.of(settings, 0, 1, from_rest).test.approach_strain, 0.0);
}

TEST_F(Loaded, AnApproachWithinTheRampIsNone) {
  Recipe slow;
  slow.test.ramp_strain = 1e-3;
  EXPECT_EQ(tests_.of(slow, 0, 1, as_measured).test.approach_strain, 0.0);
  EXPECT_EQ(tests_.of(slow, 0, 1, as_measured).test.approach_speed, 0.0);
}

TEST_F(Loaded, DiscsAreNotThrownAbout) {
  EXPECT_EQ(test(2, search_of_strengths).approach_strain, test(2, as_measured).approach_strain);
  EXPECT_GT(test(2, search_of_strengths).platen_speed, test(2, as_measured).platen_speed);
}

// Half as strong as the table has it: the rock would fail within the approach of the table's.
TEST_F(Loaded, WhatIsForeseenToBeWeakerIsApproachedLess) {
  EXPECT_NEAR(test(0, search_of_strengths, 50e6).approach_strain, 0.35 * 0.002, 1e-12);
  EXPECT_NEAR(test(1, search_of_strengths, 150e6).approach_strain, 0.35 * 0.004, 1e-12);
  EXPECT_NEAR(test(0, search_of_strengths, 300e6).approach_strain, 0.7 * 0.002, 1e-12)
      << "stronger: no farther than the table leads to expect";
}

// By hand: R = 19 mm, a = 9.5 mm, Y' = 6.646, so K_Ic = 1 MPa sqrt(m) at P/(2 R B) = 0.871 MPa; 12 times that
// over E = 50 GPa is an approach of 2.09e-4 of the diameter, and waves run at 4,303 m/s.
TEST(HalfDisc, IsBentAtTheSpeedOfTwoHundredWaves) {
  Target toughness{Property::fracture_toughness, 0.0, 1e6, 1e5, 3, false};
  const StrengthTests tests(Recipe(), {toughness}, {50e9});
  const TestRecipe slow = tests.of(Recipe(), 0, 1, from_rest).test,
                   fast = tests.of(Recipe(), 0, 1, search_of_strengths, 0.5e6).test;
  EXPECT_EQ(slow.kind, TestKind("semi_circular_bend"));
  EXPECT_NEAR(slow.platen_speed, 2.25e-3, 0.005e-3);
  EXPECT_EQ(slow.approach_strain, 0.0);
  EXPECT_NEAR(fast.approach_strain, 0.25 * 0.5 * 2.09e-4, 1e-7);
  toughness.diameter = 0.03;
  EXPECT_EQ(StrengthTests(Recipe(), {toughness}, {50e9}).of(Recipe(), 0, 1, from_rest).test.disc_diameter,
            0.03);
}

TEST_F(Loaded, ForeseenBelowItsConfinementItStillMoves) {
  EXPECT_GT(test(1, search_of_strengths, 10e6).approach_strain, 0.0);
}

/// Cracks of every test line up, on the second packing the other way; on the third they do not.
class Failing : public PaperPress {
  std::vector<TestResult> run(const std::vector<Recipe>& recipes) override {
    std::vector<TestResult> results = PaperPress::run(recipes);
    for (std::size_t i = 0; i < recipes.size(); ++i) {
      const std::int64_t seed = recipes[i].packing.seed;
      const double angle = seed == 1 ? 62.0 : seed == 2 ? -58.0 : std::nan("");
      results[i].intact = false, results[i].theta = recipes[i].bedding.front().theta;
      results[i].numbers.push_back({"bedding_share", 0.1 * static_cast<double>(seed), "1", "", ""});
      results[i].numbers.push_back({"failure_angle", angle, "deg", "", ""});
    }
    return results;
  }
};

// With bedding at 90 degrees the mirror image is as likely; at 60 the two directions lie 60 degrees apart,
// half a turn counting as none, so that their mean is upright.
TEST(StrengthResponse, HowSpecimensFailIsAMeanOverPackings) {
  Recipe rock;
  rock.bedding.resize(1);
  const std::vector<Target> table = {{Property::ucs, 60.0, 100e6, 1e6, 3, false},
                                     {Property::ucs, 90.0, 100e6, 1e6, 3, false}};
  Failing press;
  const std::vector<Comparison> rows = strength_response(rock, table, {1, 2, 3}, from_rest, press);
  EXPECT_NEAR(rows[0].failure.bedding_share, 0.2, 1e-12);
  EXPECT_NEAR(rows[0].failure.bedding_share_sd, 0.1, 1e-12);
  EXPECT_EQ(rows[0].failure.n_tests, 3);
  EXPECT_EQ(rows[0].failure.n_planes, 2);
  EXPECT_NEAR(std::fabs(rows[0].failure.angle), 88.0, 1e-9);
  EXPECT_NEAR(rows[1].failure.angle, 60.0, 1e-9);
  EXPECT_NEAR(rows[1].failure.angle_sd, std::sqrt(8.0), 1e-9);
}

}  // namespace
}  // namespace phy::calibrate
