// The methods text says what was done to these specimens, not what is usual.
#include "report/methods.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "records/assembly.hpp"

namespace phy::report {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Stress over strain, straight lines, in MPa; signs and columns of the kind.
SpecimenRecord test_of(const Recipe& recipe, const std::string& name, Outcome outcome,
                       const std::vector<std::pair<double, double>>& curve) {
  const Specimen s = assembly(hexagonal(5, 8, 0.001), MatrixRecipe{});
  TestResult r;
  r.name = name, r.kind = r.history.kind = recipe.test.kind, r.outcome = std::move(outcome);
  const double sign = recipe.test.kind == TestKind("direct_tension") ? -1.0 : 1.0;
  for (const auto& [strain, stress] : curve) {
    HistoryRow row;
    row.axial_strain = sign * strain;
    row.axial_stress = row.deviatoric_stress = sign * stress * 1e6;
    if (recipe.test.kind == TestKind("biaxial")) row.axial_stress += recipe.test.confining_stress;
    r.history.rows.push_back(row);
  }
  return record_of(recipe, "9.9", s, r);
}

std::string methods(const std::vector<SpecimenRecord>& tests) {
  RunRecord run;
  run.tests = tests;
  return fmt::format("{}", fmt::join(methods_text(run), "\n"));
}

const Outcome peaked{Status::peaked, "", ""};

TEST(Methods, AMatrixOfFlatJoints) {
  Recipe r;
  r.matrix.model = MatrixModel::flat_joint, r.matrix.elements = 2, r.matrix.break_at = BreakAt::edge;
  r.matrix.gapped_fraction = 0.2, r.matrix.initial_gap = 1e-5;
  const std::string text = methods({test_of(r, "intact", peaked, {{1e-3, 50}, {2e-3, 100}})});
  EXPECT_THAT(text, AllOf(HasSubstr("Potyondy 2012"), HasSubstr("Interfaces of 2 elements"),
                          HasSubstr("at the edge of an element"), HasSubstr("20 % of the contacts"),
                          Not(HasSubstr("parallel bonds"))));
}

TEST(Methods, AnOpeningIsSaid) {
  Recipe r;
  const auto text = [&] { return methods({test_of(r, "intact", peaked, {{1e-3, 50}, {2e-3, 100}})}); };
  EXPECT_THAT(text(), AllOf(Not(HasSubstr("hole")), Not(HasSubstr("flaw"))));
  r.specimen.hole_diameter = 0.01;
  EXPECT_THAT(text(), HasSubstr("load along the height), with a circular hole of 10 mm in the middle. The"));
  r.specimen.hole_diameter = 0.0, r.specimen.flaw_length = 0.012, r.specimen.flaw_angle = 30.0;
  EXPECT_THAT(text(), HasSubstr("with an open flaw of 12 mm in the middle, inclined by 30 deg from the "
                                "horizontal and as wide as the largest disc. The"));
  r.specimen.flaw_width = 0.002;
  EXPECT_THAT(text(), HasSubstr("from the horizontal and 2 mm wide. The"));
}

// How a test of an opening ended is said of each alone, and nothing of a stress that was never raised.
TEST(Methods, OpeningsEndAsTheyDid) {
  Recipe r;
  r.test.kind = TestKind("opening");
  r.test.vertical_stress = 20e6;
  r.bedding.resize(1);
  SpecimenRecord closed = test_of(
      r, "theta = 0 deg",
      {Status::peaked, "closure of 5.1 % of the radius when 80 % of it was excavated", ""}, {{1e-3, 50}});
  closed.result.history.rows.back().closure = 0.051;
  EXPECT_THAT(methods({closed}),
              AllOf(HasSubstr("theta = 0 deg: closure of 5.1 % of the radius when 80 %"),
                    HasSubstr("Where it stood, bottom and top then approached at"),
                    HasSubstr("inclination of the planes from the horizontal."), Not(HasSubstr("exceeded"))));
  r.matrix.unbreakable = true;
  EXPECT_THAT(methods({test_of(r, "theta = 0 deg", {Status::not_peaked, "it stands", ""}, {{1e-3, 50}})}),
              AllOf(HasSubstr("a test ended when its opening stood"), Not(HasSubstr("approached"))));
}

TEST(Methods, RadiiHaveFourDigits) {
  Recipe r;
  r.packing.n_grains = 684, r.packing.radius_min = 0.25e-3 * 3.30712345678901,
  r.packing.radius_max = 1.3725e-3;
  const std::string text = methods({test_of(r, "intact", peaked, {{1e-3, 50}, {2e-3, 100}})});
  EXPECT_THAT(text, AllOf(HasSubstr("0.8268 mm"), Not(HasSubstr("0.82678"))));
}

TEST(Methods, EveryTestEndsAsItDid) {
  Recipe r;
  r.test.stop_at = 0.6, r.test.post_peak = 1.0;
  const std::string text = methods(
      {test_of(r, "theta = 0 deg", peaked, {{1e-3, 50}, {2e-3, 100}, {2.5e-3, 59}}),
       test_of(r, "theta = 30 deg", peaked, {{1e-3, 50}, {2e-3, 100}, {4.1e-3, 90}}),
       test_of(r, "theta = 60 deg",
               {Status::not_peaked, "no drop to 60 % of the largest axial stress", "raise"}, {{1e-2, 50}}),
       test_of(r, "theta = 90 deg", peaked, {{1e-3, 50}, {2e-3, 80}, {2.5e-3, 40}}),
       test_of(r, "theta = 45 deg", peaked, {{1e-3, 50}, {2e-3, 100}, {3e-3, 85}}),
       test_of(r, "intact", {Status::unstable, "a grain flew off", ""}, {})});
  EXPECT_THAT(
      text,
      AllOf(
          HasSubstr("theta = 0 deg, theta = 90 deg: the axial stress had fallen below 60 % of its peak"),
          HasSubstr("theta = 30 deg: the axial strain exceeded its value at the peak by 100 %"),
          HasSubstr("theta = 45 deg: past a peak that the axial stress fell from by 10 %, at the full axial "
                    "strain of 0.3 %"),
          HasSubstr("theta = 60 deg: not peaked, no drop to 60 %"),
          HasSubstr("intact: unstable, a grain flew off")));
  EXPECT_THAT(text, AllOf(HasSubstr("free sides"), Not(HasSubstr("confining"))));
}

TEST(Methods, BeddingIsDescribedAsItWasLaid) {
  Recipe r;
  r.bedding.resize(1);
  const auto text = [&] { return methods({test_of(r, "theta = 0 deg", peaked, {{1e-3, 50}})}); };
  EXPECT_THAT(text(),
              AllOf(HasSubstr("Bedding planes, 5 mm apart"), Not(HasSubstr("standard deviation of 20")),
                    Not(HasSubstr("jointed, in patches")), Not(HasSubstr("Duan"))));
  BeddingRecipe& set = r.bedding[0];
  set.spacing_sd = 0.2, set.theta_sd = 3.0, set.persistence = 0.7, set.patch_length = 0.004;
  set.sigma_n_sd = 2e6, set.bridges = false;
  EXPECT_THAT(text(), AllOf(HasSubstr("the spacing has a standard deviation of 20 %; the inclination has a "
                                      "standard deviation of 3 deg"),
                            HasSubstr("70 % of the planes are jointed, in patches of 4 mm"),
                            HasSubstr("10 MPa with standard deviation 2 MPa"),
                            HasSubstr("and to all contacts that cross a plane")));
  set = {};
  set.rule = BeddingRule::oriented, set.orientation_range = 20.0;
  EXPECT_THAT(text(), AllOf(HasSubstr("within 20 deg"), HasSubstr("Duan & Kwok"), Not(HasSubstr("apart"))));
  set = {};
  set.persistence = 0.0, set.layer_thickness = 0.002, set.layer_stiffness = 0.5;
  EXPECT_THAT(text(),
              AllOf(HasSubstr("layered without joints"), HasSubstr("0.5 times the moduli of the matrix"),
                    Not(HasSubstr("times the strengths")), Not(HasSubstr("Mas Ivars"))));
  r.bedding.clear();
  r.matrix.tension_ratio = 2.0;
  EXPECT_THAT(text(), HasSubstr("theta is the inclination of the foliation"));
}

// A test that ended at a knee defines its strength otherwise than one with a peak.
TEST(Methods, EachDefinitionIsGivenWithItsSpecimens) {
  const Recipe r;
  SpecimenRecord one = test_of(r, "theta = 0 deg", peaked, {{1e-3, 50}}),
                 two = test_of(r, "intact", peaked, {{1e-3, 50}});
  one.result.numbers = {{"ucs", 5e7, "Pa", "largest stress", ""}, {"nu", 0.2, "1", "slope", ""}};
  two.result.numbers = {{"ucs", 6e7, "Pa", "stress at the knee", ""}, {"nu", 0.2, "1", "slope", ""}};
  EXPECT_THAT(methods({one, two}),
              AllOf(HasSubstr("ucs of theta = 0 deg: largest stress."),
                    HasSubstr("ucs of intact: stress at the knee."), HasSubstr("nu: slope.")));
}

TEST(Methods, AConfinedTestNamesStressAndSides) {
  Recipe r;
  r.test.kind = TestKind("biaxial"), r.test.confining_stress = 12e6, r.test.stop_at = 0.8;
  const auto one = [&] {
    return methods({test_of(r, "intact", peaked, {{1e-3, 90}, {2e-3, 100}, {2.5e-3, 79}})});
  };
  EXPECT_THAT(one(), AllOf(HasSubstr("confining stress of 12 MPa"), HasSubstr("rigid walls without friction"),
                           HasSubstr("intact: the deviatoric stress had fallen below 80 %")));
  r.test.confinement = Confinement::jacket;
  EXPECT_THAT(one(), AllOf(HasSubstr("jacket"), Not(HasSubstr("walls"))));
  r.test.confining_stress = 0.0;
  EXPECT_THAT(one(), AllOf(HasSubstr("The sides were free"), Not(HasSubstr("jacket"))));
}

TEST(Methods, OtherTestsAreDescribedByTheirOwnToolsAndEnds) {
  Recipe r;
  r.bedding.resize(1);
  r.test.kind = TestKind("direct_shear"), r.test.normal_stress = 4e6;
  const auto one = [&] { return methods({test_of(r, "s", peaked, {{1e-4, 3}, {2e-4, 2}})}); };
  EXPECT_THAT(one(), AllOf(HasSubstr("normal stress of 4 MPa, kept constant"),
                           HasSubstr("at the full shear displacement of 0.2 mm"),
                           Not(HasSubstr("load along the height")), Not(HasSubstr("load being vertical")),
                           Not(HasSubstr("strain"))));
  r.test.normal_stiffness = 1e12;
  EXPECT_THAT(one(), AllOf(HasSubstr("grew with dilation"), Not(HasSubstr("kept constant"))));
  r.test.kind = TestKind("brazilian");
  EXPECT_THAT(one(), AllOf(HasSubstr("Discs of 38 mm"), HasSubstr("arc of 10 deg")));
  r.test.loading_angle = 0.0;
  EXPECT_THAT(one(), HasSubstr("two flat platens"));
  r.test.kind = TestKind("direct_tension");
  EXPECT_THAT(one(), AllOf(HasSubstr("Grips"), HasSubstr("the elongation exceeded"),
                           HasSubstr("load being vertical")));
}

TEST(Methods, OfACalibrationSayModelDataTestsAndOutcome) {
  Calibration c;
  c.rock = "grey shale", c.E_is = ModulusReading::secant_50, c.recipe.packing.n_grains = 1197;
  c.recipe.bedding.resize(1);
  for (const double theta : {0.0, 45.0, 90.0}) {
    Comparison row;
    row.target = {Property::ucs, theta, 60e6, 3e6, 4, false};
    row.mean = 63e6, row.n_packings = 5;
    c.fitted.push_back(row);
  }
  c.verification = c.fitted;
  c.recipe.matrix.sigma_c = 19.966108594791677e6;
  c.counts = {300, 100, 0, 700};
  ParameterEstimate open;
  open.symbol = "mu_sj";
  c.parameters = {open};
  std::string text;
  for (const std::string& paragraph : methods_text(c, "0.9")) text += paragraph + "\n";
  for (const char* part :
       {"1197 per specimen", "phyllite 0.9",
        "grey shale: UCS at inclinations of 0, 45, 90 deg (3 means of 12 "
        "values)",
        "E was compared as secant 50 %", "200 compression and 100 tensile tests", "700 direct elastic",
        "verified on 5 packings", "UCS 5.0 % (5 unseen packings)", "Verdict: Calibrated.",
        "do not constrain mu_sj", "tensile strength 19.97 MPa", "Potyondy & P.A. Cundall", "smooth joints"})
    EXPECT_THAT(text, testing::HasSubstr(part));
  EXPECT_THAT(text, Not(HasSubstr("another model")));
  c.discarded = {"joints on planes"};
  EXPECT_THAT(methods_text(c, "0.9"),
              testing::Contains(HasSubstr("include solutions and tests of another model that was "
                                          "not taken: joints on planes.")));
  c.discarded.emplace_back("directions of the bonds");
  EXPECT_THAT(methods_text(c, "0.9"),
              testing::Contains(HasSubstr("other models that were not taken: joints on planes; directions")));
  c.discarded.clear();
  c.method = CalibrationMethod::sequence;
  text.clear();
  for (const std::string& paragraph : methods_text(c, "0.9")) text += paragraph + "\n";
  EXPECT_THAT(text, AllOf(HasSubstr("step by step, by Eq. 1"), HasSubstr("one after the other by bisection"),
                          Not(HasSubstr("posterior")), Not(HasSubstr("least squares"))));
}

}  // namespace
}  // namespace phy::report
