// The press room: the affine pre-strain and its rule.
#include "lab/uniaxial/uniaxial.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

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
  EXPECT_FALSE(number(too_far, "sigma_ci").note.starts_with("below")) << "nothing was jumped over";
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
