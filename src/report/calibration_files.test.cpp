// calibration.json, and input for Yade: the numbers of the recipe in the other program's terms.
#include "report/calibration_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "records/file_key_fixture.hpp"
#include "report/paper_recipe_fixture.hpp"

namespace phy::report {
namespace {

using testing::HasSubstr;

TEST(YadeScript, MatchesTheStiffnessPerBondArea) {
  const std::string text = yade_script(paper());
  EXPECT_THAT(text, HasSubstr("young=1.1938052e+11"));  // pi/2 (38 + 38) GPa
  EXPECT_THAT(text, HasSubstr("jointCohesion=30000000"));
  EXPECT_THAT(text, HasSubstr("bedded=True"));
}

TEST(YadeScript, SaysThatBridgesAreLeftOut) {
  EXPECT_THAT(yade_script(paper()), testing::Not(HasSubstr("Bridges")));
  Recipe r = paper();
  r.bedding[0].persistence = 0.65;
  EXPECT_THAT(yade_script(r), HasSubstr("# Bridges are left out: here all of each plane is jointed, in this "
                                        "calibration 0.65 of it.\n"));
}

TEST(RecipeComments, SayTheVerdictAndWhatTheDataLeaveOpen) {
  Calibration c;
  c.rock = "grey\nshale",
  c.verdict.good_for = {{FindingKind::tests_met, {{Property::E, 0.0}}, {{"of", 2.0}}}};
  ParameterEstimate known{"matrix.E_c", "E_c", "Pa", 3e10, 2.9e10, 3.1e10, 1e9, 1e11, true, {}, {}},
      open{"matrix.tau_c", "tau_c", "Pa", 6e7, 2e7, 1.5e9, 1e6, 1e10, false, {}, {}};
  Comparison met;
  met.target.mean = 30e9, met.mean = 30.3e9;
  c.fitted = {met};
  c.parameters = {known, open};
  const std::string text = recipe_comments(c);
  EXPECT_THAT(text, HasSubstr("Good for: E at 0 degrees."));
  EXPECT_THAT(text, HasSubstr("#   matrix.tau_c = 60 MPa, 95 % interval 20 MPa to 1.5 GPa\n"));
  EXPECT_THAT(text, Not(HasSubstr("matrix.E_c")));
  for (std::size_t from = 0; from + 1 < text.size(); from = text.find('\n', from) + 1)
    EXPECT_TRUE(text[from] == '#' || text[from] == '\n')
        << text.substr(from);  // a comment, whatever the name
  c.parameters = {known};
  EXPECT_THAT(recipe_comments(c), HasSubstr("constrain what was fitted: E_c."));
}

/// A calibration that has everything.
Calibration complete() {
  Calibration c;
  c.asked = {{"effort", std::string("quick")}};
  c.method = CalibrationMethod::sequence, c.effort = "quick";
  c.verdict.counts.numbers = {{"values", 3.0}, {"met", 3.0},   {"missed", 0.0},
                              {"open", 0.0},   {"alone", 0.0}, {"by_chance", 0.1}};
  Finding finding{
      FindingKind::value_missed, {{Property::ucs, 45.0, 1e6}}, {{"model", 40e6}, {"laboratory", 50e6}}};
  finding.cells[0].diameter = 0.05;
  finding.names = {"x"}, finding.advice = Advice::check_value;
  c.verdict.findings = c.verdict.good_for = c.verdict.not_good_for = c.verdict.causes = {finding};
  c.notes = c.reach = {finding};
  Comparison row;
  row.target = {Property::brazilian, 45.0, 5e6, 2e5, 3, false};
  row.target.specimens = {5e6}, row.target.diameter = 0.05, row.target.confining = 1e6;
  row.mean = row.with_discrepancy = 5e6, row.missing = "no peak", row.failure.n_tests = 2;
  c.fitted = c.verification = c.compared = c.tangent_from_test = {row};
  for (const double theta : {0.0, 45.0, 90.0}) {
    row.target = {Property::ucs, theta, 50e6, 2e6, 3, false};
    c.fitted.push_back(row), c.left_out.push_back(row);
  }
  c.discrepancy = {{row.target, 45.0}};
  c.residuals = {{row.target, 0.1, 4e-4, 1e-4, {0.1}}};
  c.eq2 = {{"as calibrated", {}, {}}};
  LabTest between{Property::ucs, Inclination::between, 30.0, 60.0, StressAsked::higher};
  ParameterEstimate e{"matrix.E_c", "E_c", "Pa", 3e10, 2e10, 4e10, 1e9, 1e11, true, {}, {}};
  e.rests_on = {Basis::tests, {{{between}}}}, e.next = {Remedy::test, {{{between}}}};
  c.parameters = {e};
  return c;
}

// Neither more nor fewer than docs/calibration-tables.md lists.
TEST(CalibrationJson, EveryKeyIsListed) {
  std::set<std::string> met;
  EXPECT_THAT(unlisted_keys(calibration_json(complete(), "1.2"), calibration_keys(), met),
              testing::IsEmpty());
  EXPECT_THAT(met, testing::ContainerEq(listed_keys(calibration_keys())));
}

TEST(CalibrationJson, HoldsVerdictAndTablesAndNullForNoNumber) {
  Calibration c;
  c.rock = "r", c.verdict.status = VerdictStatus::calibrated_except;
  c.verdict.findings = {{FindingKind::value_missed,
                         {{Property::ucs, 45.0, 1e6}},
                         {{"model", 40e6}, {"laboratory", 50e6}, {"sd", nan}}}};
  c.verdict.next.advice = Advice::check_value, c.verdict.next.cells = {{Property::ucs, 45.0}};
  Comparison row;
  row.target = {Property::ucs, 45.0, 50e6, 2e6, 3, false};
  c.fitted = {row};
  c.seconds = 17.0;
  const auto j = nlohmann::json::parse(calibration_json(c, "1.2"));
  EXPECT_EQ(j["verdict"]["status"], "calibrated except");
  EXPECT_EQ(j["fitted"][0]["theta [deg]"], 45.0);
  EXPECT_TRUE(j["fitted"][0]["model"].is_null());
  EXPECT_FALSE(j.contains("seconds"));
  const auto& finding = j["verdict"]["findings"][0];
  EXPECT_EQ(finding["kind"], "value_missed");
  EXPECT_EQ(finding["cells"][0]["property"], "UCS");
  EXPECT_EQ(finding["cells"][0]["confining [Pa]"], 1e6);
  EXPECT_EQ(finding["numbers"]["laboratory"], 50e6);
  EXPECT_TRUE(finding["numbers"]["sd"].is_null());
  EXPECT_FALSE(finding.contains("advice"));
  EXPECT_EQ(j["verdict"]["next"]["advice"], "check_value");
  EXPECT_FALSE(j["verdict"]["next"]["text"].get<std::string>().empty());
}

TEST(CalibrationJson, AnEstimateWithoutAnIntervalIsNeitherDeterminedNorOpen) {
  Calibration c;
  c.method = CalibrationMethod::sequence;
  ParameterEstimate e{"matrix.E_c", "E_c", "Pa", 3e10, nan, nan, 1e9, 1e11, false, {}, {}};
  c.parameters = {e};
  const auto j = nlohmann::json::parse(calibration_json(c, "1.2"));
  EXPECT_EQ(j["method"], "sequence");
  EXPECT_TRUE(j["parameters"][0]["determined"].is_null());
  EXPECT_TRUE(j["parameters"][0]["low"].is_null());
  EXPECT_THAT(recipe_comments(c), testing::AllOf(HasSubstr("no intervals"), Not(HasSubstr("constrain"))));
  c.method = CalibrationMethod::posterior;
  EXPECT_FALSE(nlohmann::json::parse(calibration_json(c, "1.2")).contains("method"));
}

}  // namespace
}  // namespace phy::report
