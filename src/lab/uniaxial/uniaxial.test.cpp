// The press room: the affine pre-strain and its rule.
#include "lab/uniaxial/uniaxial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "analysis/analyse.hpp"
#include "lab/procedure_fixture.hpp"

namespace phy::lab {
namespace {

TestResult press(double pre_strain) {
  Recipe r = small_rock(TestKind("uniaxial"));
  r.bedding = {BeddingRecipe{}};
  r.bedding[0].theta = 60.0;
  r.bedding[0].spacing = 0.002;
  r.test.platen_speed = 0.1;
  r.test.pre_strain = pre_strain;
  return run_alone(r);
}

// Stress concentrates at an opening: the specimen bears less.
TEST(Uniaxial, RockWithAnOpeningIsWeaker) {
  Recipe r = small_rock(TestKind("uniaxial"));
  r.specimen = {0.012, 0.024}, r.packing.n_grains = 742, r.test.platen_speed = 0.1;
  const TestResult sound = run_alone(r);
  r.specimen.hole_diameter = 0.005;
  const TestResult hole = run_alone(r);
  r.specimen.hole_diameter = 0.0, r.specimen.flaw_length = 0.005, r.specimen.flaw_angle = 30.0;
  const TestResult flaw = run_alone(r);
  for (const TestResult* t : {&sound, &hole, &flaw})
    EXPECT_EQ(t->outcome.status, Status::peaked) << t->outcome.reason;
  EXPECT_LT(number(hole, "ucs").value, 0.85 * number(sound, "ucs").value);
  EXPECT_LT(number(flaw, "ucs").value, 0.95 * number(sound, "ucs").value);
  EXPECT_LT(number(hole, "E_tangent").value, number(sound, "E_tangent").value);
  EXPECT_LT(number(hole, "energy_error").value, 5e-3);
}

TEST(JumpStart, StartsLoadedAndKeepsTheEnergyBalance) {
  const double strain = 5e-4;
  const TestResult plain = press(0.0), pre_strained = press(strain);
  ASSERT_EQ(pre_strained.outcome.status, Status::peaked);
  const HistoryRow& first = pre_strained.history.rows.front();
  EXPECT_GT(first.axial_strain, strain);
  EXPECT_LT(first.axial_strain, strain + 1e-5) << "one row later";
  EXPECT_EQ(first.n_cracks, 0.0);
  EXPECT_NEAR(first.axial_stress / first.axial_strain_gauge / number(plain, "E_small").value, 1.0, 0.1);
  // What the damped cycles have left of the pre-strain's work is what the springs hold: half of stress times
  // strain.
  const double held = first.boundary_work - first.damping - first.slip;
  EXPECT_NEAR(held / (0.5 * first.axial_stress * first.axial_strain * 0.008 * 0.016), 1.0, 0.1);
  EXPECT_LT(number(pre_strained, "energy_error").value, 5e-3);
  EXPECT_LT(pre_strained.history.rows.size(), plain.history.rows.size());
  EXPECT_NEAR(number(pre_strained, "ucs").value / number(plain, "ucs").value, 1.0,
              0.1);  // chance, on 330 grains
}

// A jump so far that a bond or joint would break the moment strengths return is taken back: the test is then
// the plain one, to the last bit.
TEST(JumpStart, SpecimenAtItsStrengthIsRunWithoutIt) {
  const TestResult plain = press(0.0), too_far = press(2e-3);
  ASSERT_LT(plain.cracks.front().strain, 2e-3) << "the pre-strain is to go beyond first breakage";
  EXPECT_EQ(too_far.hash, plain.hash);
  EXPECT_EQ(too_far.history.rows.front().step, plain.history.rows.front().step);
  EXPECT_EQ(number(too_far, "sigma_first_crack").value, number(plain, "sigma_first_crack").value);
  EXPECT_FALSE(number(too_far, "sigma_ci").upper_bound) << "nothing was jumped over";
}

// Layers a thousand times softer than the grains take nearly all of the strain; spread evenly it throws the
// grains about, and the watchdog rejects it.
TEST(JumpStart, StrainThatThrowsGrainsAboutIsTakenBack) {
  Recipe r = small_rock(TestKind("uniaxial"));
  r.bedding = {BeddingRecipe{}};
  r.bedding[0].theta = 30.0;
  r.bedding[0].spacing = 0.002;
  r.bedding[0].k_n /= 1000.0, r.bedding[0].k_s /= 1000.0;
  r.test.platen_speed = 0.5, r.test.max_strain = 0.02;
  const TestResult plain = run_alone(r);
  r.test.pre_strain = 0.03;
  const TestResult thrown = run_alone(r);
  EXPECT_NE(thrown.outcome.status, Status::unstable) << thrown.outcome.reason;
  EXPECT_EQ(thrown.hash, plain.hash);
}

TestResult approach(double strain, double speed) {
  Recipe r = small_rock(TestKind("uniaxial"));
  r.test.platen_speed = 0.05;
  r.test.approach_strain = strain, r.test.approach_speed = speed;
  return run_alone(r);
}
/// Strain between two rows, `row` and the next.
double strain_of_block(const TestResult& t, std::size_t row) {
  return t.history.rows[row + 1].axial_strain - t.history.rows[row].axial_strain;
}

TEST(Approach, IsFasterUpToItsStrainAndAsSlowAsTheTestBehindIt) {
  const double until = 1e-3;
  const TestResult plain = approach(0.0, 0.0), fast = approach(until, 0.15);
  ASSERT_EQ(fast.outcome.status, Status::peaked);
  const std::vector<HistoryRow>& rows = fast.history.rows;
  const auto end = static_cast<std::size_t>(
      std::find_if(rows.begin(), rows.end(), [&](const HistoryRow& r) { return r.axial_strain >= until; }) -
      rows.begin());
  const double slow = strain_of_block(plain, 20);
  EXPECT_NEAR(strain_of_block(fast, end - 2) / slow, 3.0, 1e-6);
  std::size_t row = end;
  for (; strain_of_block(fast, row) > slow * (1.0 + 1e-6); ++row)
    EXPECT_LE(strain_of_block(fast, row + 1), strain_of_block(fast, row) * (1.0 + 1e-9)) << "no jolt";
  EXPECT_LE(rows[row].axial_strain, rows[end].axial_strain + 2e-5 + slow) << "slow behind the ramp's strain";
  EXPECT_LT(number(fast, "energy_error").value, 5e-3);
  EXPECT_LT(fast.n_steps, plain.n_steps);
  const double peak = number(fast, "peak_strain").value;
  EXPECT_NEAR(number(fast, "slow_share").value, 1.0 - (until + 2e-5) / peak, 1e-9);
}

// E is read between 40 and 60 % of the strength: at a strain near half of the peak's.
TEST(Approach, WhatIsReadWhileTheSpeedChangesSaysSo) {
  const double peak = number(approach(0.0, 0.0), "peak_strain").value;
  const TestResult within = approach(0.5 * peak, 0.15), before = approach(0.25 * peak, 0.15);
  EXPECT_THAT(number(within, "E_tangent").note, testing::HasSubstr("the bodies slowed down in this range"));
  EXPECT_THAT(number(within, "nu").note, testing::HasSubstr("slowed down"));
  EXPECT_EQ(number(within, "E_small").note, "");
  EXPECT_EQ(number(before, "E_tangent").note, "");
}

TEST(Approach, AtTheSpeedOfTheTestChangesNoBit) {
  const TestResult same = approach(1e-3, 0.05);
  EXPECT_EQ(same.hash, approach(0.0, 0.0).hash);
  EXPECT_EQ(analysis::find(same.numbers, "slow_share"), nullptr);
}

// 330 grains loose in four times their place: nothing to go on for.
TEST(Uniaxial, SpecimenOfLooseGrainsIsNotToBePressedFurther) {
  Recipe r = small_rock(TestKind("uniaxial"));
  r.specimen = {0.010, 0.020};
  r.test.platen_speed = 0.5;
  r.test.max_strain = 1e-3;
  const TestResult loose = run_alone(r);
  ASSERT_EQ(loose.outcome.status, Status::not_peaked);
  EXPECT_THAT(loose.outcome.advice, testing::HasSubstr("put more discs into the box"));
  r.specimen = {0.008, 0.016};
  r.test.platen_speed = 0.1;
  EXPECT_THAT(run_alone(r).outcome.advice, testing::HasSubstr("raise test.max_strain"));
}

TEST(Uniaxial, DefinitionsSpeakOfTheAxialStress) {
  const History h = marble_of("uniaxial");
  expect_speaks_of("axial stress", analysis::axial_numbers(h, analysis::loading_branch(h), {}, {}));
}

}  // namespace
}  // namespace phy::lab
