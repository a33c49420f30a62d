// The paper's sequence on a press of closed forms, whose rock has what the paper assumes: Eq. 1 holds, K of
// the joints is a line over k, strengths grow with the parameter that is sought.
#include "calibrate/sequence.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/check.hpp"
#include "calibrate/calibration.hpp"
#include "calibrate/paper_press_fixture.hpp"
#include "records/reading_fixture.hpp"

namespace phy::calibrate {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// A rock whose ratios of strengths are those of the recipe, and other numbers are not.
Recipe truth() {
  Recipe r;
  r.bedding.resize(1);
  BeddingRecipe& b = r.bedding[0];
  r.matrix.E_c = r.matrix.E_b = 21e9;
  b.k_n = 2100e9, b.k_s = 1500e9;
  r.matrix.sigma_c = 0.6 * MatrixRecipe{}.sigma_c, r.matrix.tau_c = 0.6 * MatrixRecipe{}.tau_c;
  b.cohesion = 0.4 * BeddingRecipe{}.cohesion, b.sigma_n = 0.4 * BeddingRecipe{}.sigma_n;
  return r;
}

/// Its table: moduli and UCS as the press has them without scatter.
Rock rock() {
  Rock made;
  made.name = "shale", made.model.bedding.resize(1);
  Recipe r = truth();
  const BeddingRecipe& b = r.bedding[0];
  const theory::JointedRock macro{1.8 * r.matrix.E_c, 1.8 * b.k_n * b.spacing, 1.8 * b.k_s * b.spacing, 0.25};
  for (const double theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
    r.bedding[0].theta = theta;
    made.readings.push_back(reading(Property::E, theta, theory::goodman_E(macro, theta)));
    made.readings.push_back(reading(Property::ucs, theta, PaperPress::ucs(r)));
  }
  return made;
}

PaperPress quiet() {
  PaperPress press;
  press.packing_scatter = press.run_scatter = 0.0;
  return press;
}

Calibration calibrated(const Rock& rock, PaperPress& press, std::int64_t max_tests = 500) {
  CalibrationOptions options;
  options.method = CalibrationMethod::sequence, options.max_tests = max_tests;
  return calibrate(Evidence(rock), options, press);
}

TEST(Sequence, FindsARockThatIsAsThePaperAssumes) {
  PaperPress press = quiet();
  const Calibration c = calibrated(rock(), press);
  const Recipe is = truth();
  EXPECT_EQ(c.verdict.status, VerdictStatus::calibrated);
  EXPECT_NEAR(c.recipe.matrix.E_c / is.matrix.E_c, 1.0, 1e-3);
  EXPECT_NEAR(c.recipe.bedding[0].k_n / is.bedding[0].k_n, 1.0, 1e-3);
  EXPECT_NEAR(c.recipe.bedding[0].k_s / is.bedding[0].k_s, 1.0, 1e-3);
  // UCS is met within 2 %; sliding shares it with the matrix, and cohesion with sigma_n
  EXPECT_NEAR(c.recipe.matrix.sigma_c / is.matrix.sigma_c, 1.0, 0.03);
  EXPECT_NEAR(c.recipe.matrix.tau_c / is.matrix.tau_c, 1.0, 0.03);
  EXPECT_NEAR(c.recipe.bedding[0].cohesion / is.bedding[0].cohesion, 1.0, 0.06);
  for (const Comparison& row : c.verification) EXPECT_NEAR(row.error(), 0.0, 0.03) << row.target.theta;
  int n_lines = 0;
  for (const Finding& f : c.notes)
    if (f.kind == FindingKind::eq2_line) {
      EXPECT_NEAR(f.number("slope"), 1.8, 0.05) << f.names.front();
      ++n_lines;
    }
  EXPECT_EQ(n_lines, 2);
}

TEST(Sequence, GivesNoIntervalsAndDoesNotSayWhatIsOpen) {
  PaperPress press = quiet();
  const Calibration c = calibrated(rock(), press);
  EXPECT_EQ(c.method, CalibrationMethod::sequence);
  EXPECT_TRUE(c.left_out.empty());
  EXPECT_EQ(c.parameters.size(), 7U);  // without nu: E_c, k_n, k_s, sigma_c, tau_c, C, sigma_n
  for (const ParameterEstimate& e : c.parameters) {
    EXPECT_FALSE(e.has_interval() || e.open()) << e.symbol;
    EXPECT_NE(e.rests_on.basis, Basis::none) << e.symbol;
    EXPECT_GE(e.value, e.box_low);
    EXPECT_LE(e.value, e.box_high);
  }
}

TEST(Sequence, EveryTestIsCountedAndTheBudgetIsKept) {
  for (const ModulusReading reading : {ModulusReading::small_strain, ModulusReading::tangent_50}) {
    Rock r = rock();
    r.E_is = reading;
    const std::int64_t least = 7 * (8 + 5 + (reading == ModulusReading::small_strain ? 0 : 5));
    for (const std::int64_t budget : {least, std::int64_t{500}}) {
      PaperPress press;  // with scatter: rounds go on
      const Calibration c = calibrated(r, press, budget);
      EXPECT_EQ(c.counts.tests, press.n_tests);
      EXPECT_LE(c.counts.tests, budget);
      EXPECT_EQ(c.counts.coarse, 0);
    }
    PaperPress press;
    EXPECT_THROW(calibrated(r, press, least - 1), InputError);
    EXPECT_EQ(press.n_tests, 0);
  }
}

TEST(Sequence, ATangentIsMetByStifferContacts) {
  PaperPress press = quiet();
  press.tangent = 0.8;
  Rock tangents = rock();
  tangents.E_is = ModulusReading::tangent_50;
  const Calibration c = calibrated(tangents, press);
  EXPECT_NEAR(c.recipe.matrix.E_c / truth().matrix.E_c, 1.25, 0.01);
  EXPECT_NEAR(c.recipe.bedding[0].k_n / truth().bedding[0].k_n, 1.25, 0.02);
}

TEST(Sequence, StopsInTheMiddleOfAStrengthAndOfSolutions) {
  PaperPress press = quiet();
  press.stop_after = 3;
  const Calibration c = calibrated(rock(), press);
  EXPECT_EQ(c.verdict.status, VerdictStatus::interrupted);
  EXPECT_EQ(press.n_tests, 3);
  press = quiet();
  press.stops_statics = true;
  EXPECT_EQ(calibrated(rock(), press).verdict.status, VerdictStatus::interrupted);
}

TEST(Sequence, WhatItDoesNotUseIsToldInOneNoteAndComparedAllTheSame) {
  Rock r = rock();
  r.readings.push_back(reading(Property::brazilian, 0.0, 10e6));
  PaperPress press = quiet();
  const Calibration c = calibrated(r, press);
  const Finding* unused = first_of(c.notes, FindingKind::values_unused);
  ASSERT_NE(unused, nullptr);
  EXPECT_THAT(unused->cells,
              AllOf(Contains(Cell{Property::ucs, 0.0}), Contains(Cell{Property::brazilian, 0.0}),
                    Not(Contains(Cell{Property::ucs, 90.0}))));
  EXPECT_TRUE(std::any_of(c.verification.begin(), c.verification.end(),
                          [](const Comparison& row) { return row.target.property == Property::brazilian; }));
  EXPECT_EQ(c.counts.tension, 1 + 5);
}

TEST(Sequence, ATestWithoutAPeakLeavesTheStrengthAndIsTold) {
  PaperPress press = quiet();
  press.peaks = [](const Recipe& r) { return r.bedding.front().theta != 90.0; };
  EXPECT_NE(first_of(calibrated(rock(), press).notes, FindingKind::peaks_skipped), nullptr);
}

TEST(Sequence, WithoutBeddingThereIsTheMatrixAlone) {
  Rock r = rock();
  r.bedded = false;
  std::erase_if(r.readings, [](const RockReading& one) { return one.theta != 0.0; });
  PaperPress press = quiet();
  const Calibration c = calibrated(r, press);
  EXPECT_EQ(c.parameters.size(), 3U);  // E_c, sigma_c, tau_c
  for (const Comparison& row : c.verification) EXPECT_NEAR(row.error(), 0.0, 0.03);
}

TEST(Sequence, RefusesWhatItCannotWorkWithAllAtOnce) {
  PaperPress press = quiet();
  Rock r = rock();
  r.layers = LayerModel::directions;
  std::erase_if(r.readings, [](const RockReading& one) { return one.property == Property::E; });
  try {
    calibrated(r, press);
    FAIL() << "not refused";
  } catch (const InputError& e) {
    ASSERT_EQ(e.problems().size(), 2U);
    EXPECT_THAT(to_line(e.problems()[0]), AllOf(HasSubstr("layers"), HasSubstr("planes")));
    EXPECT_THAT(to_line(e.problems()[1]), HasSubstr("no E"));
  }
  Rock bridged = rock();
  bridged.layers = LayerModel::planes_with_bridges;
  EXPECT_THROW(calibrated(bridged, press), InputError);
  Rock flat = rock();
  flat.matrix = MatrixModel::flat_joint;
  EXPECT_THROW(calibrated(flat, press), InputError);
  Rock few = rock();
  std::erase_if(few.readings, [](const RockReading& one) { return one.theta > 20.0 && one.theta < 80.0; });
  EXPECT_THROW(calibrated(few, press), InputError);  // nothing oblique: K_s would rest on nothing
  EXPECT_EQ(press.n_tests, 0);
}

// Stiffer across its planes than along them: no joints do that, and the verdict says what came of it.
TEST(Sequence, ARockThatEq1DoesNotHoldIsAFindingNotAnError) {
  Rock r = rock();
  for (RockReading& one : r.readings)
    if (one.property == Property::E) one.value = one.theta == 90.0 ? 20e9 : 30e9;
  PaperPress press = quiet();
  const Calibration c = calibrated(r, press);
  EXPECT_NE(first_of(c.notes, FindingKind::eq1_refused), nullptr);
  const Finding* edge = first_of(c.verdict.findings, FindingKind::parameter_at_edge);
  ASSERT_NE(edge, nullptr);
  EXPECT_EQ(edge->names.front(), "k_n,sj");
  EXPECT_EQ(c.verdict.status, VerdictStatus::out_of_reach);
}

}  // namespace
}  // namespace phy::calibrate
