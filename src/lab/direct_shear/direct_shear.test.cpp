// The shear box: constant normal load, constant normal stiffness, energy. Strength and stiffness of rigid
// halves are V20 of `phyllite verify`.
#include "lab/direct_shear/direct_shear.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lab/direct_shear/reading.hpp"
#include "lab/procedure_fixture.hpp"
#include "records/quality.hpp"

namespace phy::lab {
namespace {

Recipe box() {
  Recipe r = small_rock(TestKind("direct_shear"));
  r.specimen = {0.016, 0.008};
  r.bedding.resize(1);
  r.bedding.front().spacing = 0.05, r.bedding.front().rule = BeddingRule::crossing;
  r.bedding.front().mu = 0.5, r.bedding.front().psi = 10.0;
  r.test.normal_stress = 4e6;
  r.test.max_strain = 3e-3;
  r.test.platen_speed = 0.01;
  return r;
}

TEST(DirectShear, ConstantNormalLoadAndDilation) {
  const TestResult r = run_alone(box());
  ASSERT_EQ(r.outcome.status, Status::peaked) << r.outcome.reason;
  EXPECT_THAT(r.outcome.reason,
              testing::AllOf(testing::HasSubstr("a shear displacement of"),
                             testing::HasSubstr("of the width"), testing::Not(testing::HasSubstr("strain"))));
  EXPECT_NEAR(number(r, "sigma_n").value, 4e6, 0.02 * 4e6);
  EXPECT_GT(number(r, "tau_peak").value, number(r, "tau_residual").value);
  EXPECT_NEAR(number(r, "mu_residual").value, 0.5, 0.01);
  EXPECT_LT(number(r, "energy_error").value, 5e-3);
  EXPECT_NEAR(number(r, "dilation").value, 10.0, 0.2) << "that of the joints";
}

// With a stiff normal support dilation raises the normal stress along the line asked for.
TEST(DirectShear, ConstantNormalStiffness) {
  Recipe r = box();
  r.test.normal_stiffness = 1000e9;
  const TestResult result = run_alone(r);
  const HistoryRow& last = result.history.rows.back();
  ASSERT_LT(last.lateral_strain, -1e-6);
  EXPECT_NEAR(last.lateral_stress / (4e6 - 1000e9 * last.lateral_strain), 1.0, 0.02);
  EXPECT_GT(last.lateral_stress, 6e6);
}

// Without damping a stress brought on at a blow swings for ever: told, not waited for.
TEST(DirectShear, ANormalStressThatNeverSettlesEndsTheTest) {
  Recipe r = box();
  r.engine.damping = 0.0;
  r.test.shear_gap = 0.004;
  r.test.platen_speed = 1.0;
  const TestResult result = run_alone(r);
  EXPECT_EQ(result.outcome.status, Status::not_settled);
  EXPECT_THAT(result.outcome.reason, testing::HasSubstr("after 40000 cycles"));
  EXPECT_THAT(result.outcome.advice,
              testing::AllOf(testing::HasSubstr("engine.damping"), testing::HasSubstr("test.platen_speed")));
}

// One soft plane and layers of sound rock: the plane's stiffness counts once, however wide the gap is.
TEST(DirectShear, TheNormalStressSettlesOnASoftPlaneInAWideGap) {
  for (const double k_n : {3360e9, 336e9}) {
    Recipe r = box();
    r.bedding.front().rule = BeddingRule::zone;
    r.bedding.front().k_n = k_n;
    r.test.shear_gap = 0.004;
    r.test.max_strain = 1e-4;
    const TestResult result = run_alone(r);
    EXPECT_NE(result.outcome.status, Status::not_settled) << k_n << ": " << result.outcome.reason;
  }
}

TEST(DirectShear, BoxesHoldAllButTheGap) {
  const Recipe r = box();
  const auto packing = small_packing(r);
  for (const double gap : {0.0, 0.002}) {
    const engine::Boundary boundary = shear_boxes(*packing, gap).boundary;
    std::size_t free = 0;
    for (const Disc& d : packing->discs) free += std::fabs(d.y - 0.5 * packing->height) < 0.5 * gap ? 1 : 0;
    EXPECT_EQ(boundary.bodies[0].grips.size() + boundary.bodies[1].grips.size() + free,
              packing->discs.size());
  }
}

/// A hundred rows 1 um apart, the peak in row 20; normal stress by row number, 5 MPa asked for.
std::vector<Number> kept(double (*normal_stress)(int)) {
  History h;
  h.kind = TestKind("direct_shear"), h.width = h.height = 0.1;
  for (int i = 1; i <= 100; ++i) {
    HistoryRow r;
    r.axial_strain = 1e-6 * i, r.lateral_strain = -1e-7 * i;
    r.axial_stress = i <= 20 ? 1e6 * i : 3e6;
    r.lateral_stress = normal_stress(i);
    h.rows.push_back(r);
  }
  std::vector<Number> numbers = shear_numbers(h, {}, {5e6, 0.0});
  note_marks(numbers);
  return numbers;
}

// Ten rows 20 % above the load asked for and ten as much below: the mean hides it.
TEST(DirectShear, ANormalStressThatSwingsIsNotHeld) {
  const auto swings = kept([](int i) { return i > 20 ? 5e6 : i % 2 == 0 ? 6e6 : 4e6; });
  EXPECT_NEAR(analysis::value(swings, "sigma_n"), 5e6, 1.0);
  EXPECT_NEAR(analysis::value(swings, "sigma_n_error"), 0.2, 1e-12);
  EXPECT_NEAR(analysis::value(swings, "sigma_n_error_rms"), 0.2, 1e-12);
  EXPECT_NEAR(analysis::value(swings, "sigma_n_error_residual"), 0.0, 1e-12);
  EXPECT_NEAR(analysis::value(swings, "tau_residual"), 3e6, 1.0);
}

// The last quarter is rows 75 to 100; half of its 26 rows have no load, the others the double.
TEST(DirectShear, WhereTheBoxLiftsNothingIsReadBehindThePeak) {
  const auto lifts = kept([](int i) { return i < 75 ? 5e6 : i % 2 == 0 ? 0.0 : 10e6; });
  EXPECT_NEAR(analysis::value(lifts, "sigma_n_error_rms"), 0.0, 1e-12);
  EXPECT_NEAR(analysis::value(lifts, "sigma_n_error_residual"), 1.0, 1e-12);
  EXPECT_NEAR(analysis::value(lifts, "box_lifted"), 13.0 / 41.0, 1e-12) << "dilation is read from row 60 on";
  EXPECT_EQ(analysis::value(lifts, "tau_peak"), 20e6);
  for (const char* name : {"tau_residual", "mu_residual", "dilation"}) {
    EXPECT_TRUE(std::isnan(analysis::value(lifts, name))) << name;
    EXPECT_THAT(analysis::note(lifts, name), testing::HasSubstr("the boxes lose touch"));
  }
}

// Under 4 MPa a box that is sheared as fast as this rides up, and comes down again behind the peak.
TEST(DirectShear, ABoxThatIsShearedTooFastIsNotTrusted) {
  Recipe r = box();
  r.bedding.clear();
  r.test.shear_gap = 0.002;
  r.test.max_strain = 0.02;
  r.test.platen_speed = 0.5;
  const TestResult fast = run_alone(r);
  EXPECT_EQ(fast.outcome.status, Status::untrusted);
  EXPECT_GT(number(fast, "sigma_n_error_rms").value, 1.0);
  EXPECT_EQ(grade_of(fast), Grade::untrusted);
  for (const char* name : {"tau_residual", "mu_residual", "dilation"})
    EXPECT_TRUE(std::isnan(number(fast, name).value)) << name << ": " << number(fast, name).value;
}

TEST(DirectShear, DefinitionsSpeakOfTheShearStress) {
  expect_speaks_of("shear stress", shear_numbers(marble_of("direct_shear"), {}, {}));
}

}  // namespace
}  // namespace phy::lab
