#include "report/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/nan.hpp"
#include "io/base64.hpp"
#include "io/store.hpp"
#include "records/assembly.hpp"
#include "report/calibration_files.hpp"
#include "report/curves.hpp"
#include "theory/goodman.hpp"

namespace phy::report {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::Not;

SpecimenRecord test_at(double theta) {
  Specimen s = assembly(hexagonal(5, 8, 0.001), MatrixRecipe{});
  Recipe recipe;
  recipe.name = "<script>alert('name')</script>";
  recipe.bedding.resize(1);
  recipe.test.angles = {0.0, 45.0, 90.0};
  s.bedding = recipe.bedding;
  s.bedding[0].theta = theta;
  s.bedding_report.resize(1);
  TestResult r;
  r.name = specimen_name(theta);
  r.intact = false, r.theta = theta;
  r.outcome = {Status::not_peaked, "</script><b>no drop</b>", "<!-- raise -->"};
  r.numbers = {{"ucs", 1e8 / 3.0 * (1.0 + theta / 300.0), "Pa", "largest & first", ""},
               {"E_tangent", 2e10 + 1e8 / 7.0 * theta, "Pa", "slope", ""},
               {"nu", nan, "1", "ratio", "too \"few\" rows"}};
  r.history.rows.resize(3);
  r.history.rows[2].axial_strain = 1.0 / 3.0;
  r.cracks.resize(2);
  r.cracks[1].normal = {0.0, 1.0};
  for (int k = 0; k < 3; ++k)
    r.frames.push_back({1.0 * k, 1e-3 * k, 0.0, {s.packing->discs.size(), {0.0F, 0.0F}}});
  return record_of(recipe, "9.9", s, r);
}

RunRecord three() {
  RunRecord run;
  for (const double theta : {0.0, 45.0, 90.0}) run.tests.push_back(test_at(theta));
  return run;
}

/// The block of data in a page, found as a browser finds it: up to the first end tag.
Json data_of(const std::string& page) {
  const std::string begin = "id=\"report-data\">";
  const std::size_t from = page.find(begin) + begin.size();
  return Json::parse(page.substr(from, page.find("</script", from) - from));
}

TEST(Page, EveryNumberIsThatOfResultJson) {
  const RunRecord run = three();
  const Json data = data_of(report_page(run));
  ASSERT_EQ(data["tests"].size(), 3U);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(data["tests"][i]["result"], Json::parse(io::result_json(run.tests[i])));
  EXPECT_EQ(data["tests"][1]["result"]["numbers"]["ucs"]["value"].get<double>(),
            1e8 / 3.0 * (1.0 + 45.0 / 300.0));
  EXPECT_TRUE(data["tests"][1]["result"]["numbers"]["nu"]["value"].is_null());
}

TEST(Page, HeadIsThatOfTheExtras) {
  PageExtras extras;
  extras.head = {{"author", "A. <b>N.</b>"}};
  EXPECT_EQ(data_of(report_page(three(), extras))["head"], Json::parse(R"([["author", "A. <b>N.</b>"]])"));
}

TEST(Page, TextOfTheUserIsNeverMarkup) {
  const std::string page = report_page(three());
  for (const char* bad : {"<script>alert", "<b>no drop", "<!-- raise"})
    EXPECT_THAT(page, Not(HasSubstr(bad)));
  EXPECT_EQ(data_of(page)["name"], "<script>alert('name')</script>");
  EXPECT_EQ(data_of(page)["tests"][0]["result"]["outcome"]["reason"], "</script><b>no drop</b>");
}

TEST(Page, SaysWhatIsMissingAndStandsWithoutSpecimens) {
  RunRecord run = three();
  run.missing = {{"theta = 60 deg", "stopped by the user"}};
  EXPECT_EQ(data_of(report_page(run))["missing"][0]["reason"], "stopped by the user");
  RunRecord none;
  none.missing = run.missing;
  const Json data = data_of(report_page(none));
  EXPECT_EQ(data["tests"].size(), 0U);
  EXPECT_EQ(data["missing"][0]["name"], "theta = 60 deg");
}

TEST(Page, RefersToNothingOutside) {
  const std::string page = report_page(three());
  for (const char* reference : {"src=\"", "href=\"http", "@import", "url(http"})
    EXPECT_THAT(page, Not(HasSubstr(reference)));
}

TEST(Page, CarriesCalibrationAndLaboratory) {
  Calibration c;
  c.rock = "shale & co";
  c.verdict.status = VerdictStatus::calibrated_except;
  c.verdict.findings = {{FindingKind::value_missed,
                         {{Property::nu, 45.0}},
                         {{"model", 0.3}, {"laboratory", 0.2}, {"margin", 0.03}}}};
  c.parameters = {{"matrix.E_c", "E_c", "Pa", 3.8e10, 3.5e10, 4e10, 1e9, 1e11, true, {}, {}}};
  Comparison row;
  row.target = {Property::ucs, 45.0, 6e7, 3e6, 4, false};
  row.mean = 5.9e7;
  c.fitted = {row};
  PageExtras extras;
  extras.calibration_json = calibration_json(c, "9.9");
  extras.calibration = c;
  const Json data = data_of(report_page(three(), extras));
  EXPECT_EQ(data["calibration"], Json::parse(extras.calibration_json));
  EXPECT_EQ(data["calibration"]["fitted"][0]["model"].get<double>(), 5.9e7);
  const Json& series = data["figures"]["calibration"]["panels"][0]["series"];
  const auto laboratory =
      std::find_if(series.begin(), series.end(), [](const Json& s) { return s["role"] == "laboratory"; });
  ASSERT_NE(laboratory, series.end());
  EXPECT_EQ((*laboratory)["y"][0].get<double>(), 60.0) << "in the unit of its axis";
}

TEST(TheoryCurves, OfATableGoThroughIt) {
  std::vector<Target> table;
  for (const double theta : {0.0, 30.0, 45.0, 60.0, 90.0}) {
    // Coulomb on a plane of 10 MPa with a friction of 0.3 in rock of 70 MPa; a continuum for E
    const double a = theta * std::acos(-1.0) / 180.0;
    const double drive = std::sin(a) * std::cos(a) - 0.3 * std::cos(a) * std::cos(a);
    table.push_back(
        {Property::ucs, theta, drive > 1e-9 ? std::min(70e6, 10e6 / drive) : 70e6, 1e6, 3, false});
    table.push_back({Property::E, theta, theory::goodman_E({4e10, 5e10, 2e10, 0.0}, theta), 1e9, 3, false});
  }
  const TheoryCurves curves = theory_curves(table);
  EXPECT_NEAR(curves.ucs.value[45], 10e6 / 0.35, 1e5);
  EXPECT_NEAR(curves.ucs.value[5], 70e6, 1e5);
  EXPECT_NEAR(curves.E.value[20], theory::goodman_E({4e10, 5e10, 2e10, 0.0}, 20.0), 1e7);
}

// A tension test is recorded as negative; its curve and cracks reach the page growing.
TEST(Page, CurvesGrowWhateverTheTest) {
  RunRecord press = three(), pull = press;
  for (SpecimenRecord& t : press.tests) {
    t.result.history.rows[1].axial_stress = 3e6;
    t.result.cracks[1].strain = 0.25;
  }
  for (SpecimenRecord& t : pull.tests) {
    t.recipe.test.kind = TestKind("direct_tension");
    t.result.history.rows[2].axial_strain *= -1.0;
    t.result.history.rows[1].axial_stress = -3e6;
    t.result.cracks[1].strain = -0.25;
  }
  const Json a = data_of(report_page(press)), b = data_of(report_page(pull));
  EXPECT_EQ(b["axes"]["sign"].get<double>(), -1.0);
  const auto curve = [](const Json& j) { return j["figures"]["stress_strain"]["panels"][0]["series"][0]; };
  EXPECT_EQ(curve(a)["y"], curve(b)["y"]);
  EXPECT_EQ(curve(a)["y"][1], 3.0);
  EXPECT_EQ(b["figures"]["stress_strain"]["panels"][0]["y"]["quantity"], "tensile stress");
  EXPECT_EQ(a["tests"][0]["end"], b["tests"][0]["end"]);
  // -0.0 differs from 0.0 in its bits: compared is the crack that is not at 0.
  EXPECT_EQ(a["tests"][0]["cracks"]["strain"].get<std::string>().substr(12),
            b["tests"][0]["cracks"]["strain"].get<std::string>().substr(12));
}

TEST(Page, CarriesStudiesWithoutSpecimens) {
  // Two packings of a continuum: K_n = 7e12 and 7.2e12 Pa/m, K_s = 1e12 Pa/m.
  const auto moduli = [](double E, double K_n) {
    std::vector<AngleValue> all;
    for (const double theta : {0.0, 45.0, 90.0}) {
      AngleValue a;
      a.theta = theta, a.value.n = 1;
      a.value.mean = theory::goodman_E({E, 0.005 * K_n, 0.005 * 1e12, 0.0}, theta);
      all.push_back(a);
    }
    return all;
  };
  AngleValue E;
  E.theta = 30.0, E.value.n = 2, E.value.mean = 2.5e10, E.value.half_width = 1e9;
  const std::vector<std::vector<AngleValue>> each = {moduli(2e10, 7e12), moduli(3e10, 7.2e12)};
  VariedSetting base{"3360 GPa/m", 3.36e12, 1.0, true, {E}, {}, {}},
      other{"1680 GPa/m <b>", 1.68e12, 0.5, false, {E}, {AngleValue{}}, each};
  PageExtras extras;
  extras.name = "study";
  extras.variation = Variation{"study", 0.005, 0.0, {{"bedding.k_n", {other, base}}}, {}};
  extras.effects = {{"number", "slope"}, {"ucs", "1e-5"}};
  const std::string page = report_page(RunRecord{}, extras);
  EXPECT_THAT(page, Not(HasSubstr("GPa/m <b>")));
  const Json data = data_of(page);
  EXPECT_EQ(data["name"], "study");
  const Json& study = data["figures"]["study"];
  EXPECT_EQ(study["parameters"][0]["key"], "bedding.k_n");
  const Json& panels = study["parameters"][0]["figure"]["panels"];
  ASSERT_EQ(panels.size(), 1U) << "E; none of the specimens has a strength";
  EXPECT_EQ(panels[0]["series"].back()["y"][0], 25.0);
  EXPECT_EQ(panels[0]["series"].back()["text"][0], "± 1.00");
  const Json& macro = study["macro"]["panels"];
  ASSERT_EQ(macro.size(), 2U);
  const Json& K_n = macro[0]["series"].back();
  ASSERT_EQ(K_n["x"].size(), 1U) << "one angle gives no fit";
  EXPECT_NEAR(K_n["y"][0].get<double>(), 7100.0, 1e-3);
  EXPECT_EQ(K_n["text"][0], "± 1270.62");  // t of one degree of freedom times 100 GPa/m
  EXPECT_NEAR(macro[1]["series"].back()["y"][0].get<double>(), 1000.0, 1e-3);
  EXPECT_EQ(data["effects"][1][1], "1e-5");
}

TEST(TheoryCurves, GoThroughReadingsThatTheyMade) {
  RunRecord run;
  const theory::JointedRock rock{60e9, 40e9, 8e9, 0.2};
  for (const double theta : {0.0, 30.0, 45.0, 60.0, 90.0}) {
    SpecimenRecord t = test_at(theta);
    t.result.numbers = {{"E_tangent", theory::goodman_E(rock, theta), "Pa", "", ""},
                        {"nu", theory::goodman_nu(rock, theta), "1", "", ""}};
    run.tests.push_back(t);
  }
  const TheoryCurves curves = theory_curves(run);
  ASSERT_EQ(curves.E.theta.size(), 91U);
  for (const int theta : {10, 40, 77}) {
    EXPECT_NEAR(curves.E.value[static_cast<std::size_t>(theta)] / theory::goodman_E(rock, theta), 1.0, 1e-9);
    EXPECT_NEAR(curves.nu.value[static_cast<std::size_t>(theta)], theory::goodman_nu(rock, theta), 1e-9);
  }
  EXPECT_TRUE(curves.ucs.theta.empty());
  EXPECT_THAT(curves.ucs.note, HasSubstr("No theory curve"));
  run.tests.push_back(test_at(15.0));  // another E altogether, not to be trusted: nothing moves
  run.tests.back().result.outcome.status = Status::untrusted;
  EXPECT_TRUE(std::isnan(value_of(run.tests.back(), "E_tangent")));
  EXPECT_EQ(theory_curves(run).E.value, curves.E.value);
}

TEST(CrackRose, CountsCracksByTheirOwnDirection) {
  std::vector<CrackEvent> cracks(4);
  cracks[0].normal = {0.0, 1.0};                         // the crack lies along x: 0 degrees
  cracks[1].normal = {1.0, 0.0};                         // along y: 90
  cracks[2].normal = {-std::sqrt(0.5), std::sqrt(0.5)};  // along 45
  cracks[3].normal = {std::sqrt(0.5), -std::sqrt(0.5)};  // the same line, seen from the other side
  cracks[1].mode = CrackMode::shear;
  const Rose rose = crack_rose(cracks, 8);  // bins of 22.5 degrees
  EXPECT_EQ(rose.tension[0], 1.0);
  EXPECT_EQ(rose.shear[4], 1.0);
  EXPECT_EQ(rose.tension[2], 2.0);
}

TEST(Base64, MatchesTheExamplesOfTheStandard) {
  for (const auto& [bytes, text] :
       {std::pair{"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}})
    EXPECT_EQ(io::base64(bytes), text);
  EXPECT_EQ(io::base64(std::string("\xff\x00\xfe", 3)), "/wD+");
}

}  // namespace
}  // namespace phy::report
