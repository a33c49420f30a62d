// What a calibration says in few lines: like cells once, nothing that the findings do not say.
#include "report/calibration_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report/calibration_tables.hpp"
#include "report/words.hpp"

namespace phy::report {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Comparison row(Property p, double theta, double laboratory, double model) {
  Comparison c;
  c.target = {p, theta, laboratory, 0.05 * laboratory, 3, false};
  c.mean = model, c.n_packings = 5;
  return c;
}

Finding missed(FindingKind kind, const Comparison& c) {
  return {kind, {cell_of(c.target)}, {{"model", c.mean}, {"laboratory", c.target.mean}, {"margin", 0.06}}};
}
const Finding something_else{FindingKind::strengths_missed, {}, {{"rms", 0.1}}};

/// UCS at 0, 30, 75 and BTS at 30 degrees; the findings are of a verdict.
Calibration found() {
  Calibration c;
  c.fitted = {row(Property::nu, 0, 0.26, 0.21), row(Property::ucs, 0, 50e6, 50e6),
              row(Property::ucs, 30, 40e6, 44e6), row(Property::ucs, 75, 60e6, 60e6),
              row(Property::brazilian, 30, 10e6, 8e6)};
  c.verification = c.fitted;
  c.verification[2].mean = 45e6, c.verification[3].mean = 54e6;
  c.verdict.status = VerdictStatus::out_of_reach;
  c.verdict.findings = {missed(FindingKind::fit_missed, c.fitted[0]),
                        missed(FindingKind::value_missed, c.verification[2]),
                        missed(FindingKind::value_missed, c.verification[3]),
                        {FindingKind::ratio_missed,
                         {{Property::ucs, 30}, {Property::brazilian, 30}},
                         {{"model", 45.0 / 8.0}, {"laboratory", 4.0}}},
                        something_else};
  ParameterEstimate open;
  open.symbol = "mu";
  c.parameters = {open, open};
  c.parameters[1].symbol = "phi";
  return c;
}

TEST(CalibrationSummary, CellsOfOnePropertyAreOneLine) {
  EXPECT_THAT(summary_lines(found()),
              ElementsAre("nu is 0.05 off at 0 degrees.", "UCS is 10 to 12 % off at 30 and 75 degrees.",
                          "UCS/BTS is 4.0 in the table and 5.6 in the nearest model at 30 degrees.",
                          sentence(something_else), "The data do not determine mu and phi."));
}

TEST(CalibrationSummary, CellsThatNoFindingNamesStaySilent) {
  Calibration c = found();
  c.verdict.findings = {something_else};
  c.parameters.clear();
  EXPECT_THAT(summary_lines(c), ElementsAre(sentence(something_else)));
}

TEST(CalibrationSummary, CellsWithoutAnAnswerShareALineToo) {
  Calibration c = found();
  c.verification[1].mean = c.verification[2].mean = std::nan("");
  c.verdict.findings = {{FindingKind::no_usable_peak, {{Property::ucs, 0}}, {}, {"never"}},
                        {FindingKind::no_usable_peak, {{Property::ucs, 30}}, {}, {"never"}}};
  c.parameters.clear();
  EXPECT_THAT(summary_lines(c), ElementsAre("UCS has no answer at 0 and 30 degrees."));
}

TEST(CalibrationSummary, NoMoreThanTenLinesOfAnyTerminal) {
  Calibration c = found();
  for (int i = 0; i < 30; ++i)
    c.verdict.findings.push_back(
        {FindingKind::parameter_at_edge, {}, {{"value", 1.0}}, {"number " + std::to_string(i)}});
  c.notes = {something_else};
  for (const int width : {0, 30, 60, 80}) {
    const std::string text = summary_text(c, width);
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 10) << width;
    EXPECT_THAT(text, HasSubstr("more in tables.txt"));
  }
  EXPECT_THAT(summary_text(found(), 80), Not(HasSubstr("more in")));
}

TEST(CalibrationTables, AnglesStandAcrossAndNarrowTerminalsBreakNoRow) {
  const std::string text = angle_table(found(), 80);
  EXPECT_THAT(text, HasSubstr("theta [deg]      0     30     75\n"));
  EXPECT_THAT(text, HasSubstr("UCS [MPa]     50.0   40.0   60.0\n  model       50.0   45.0   54.0\n"
                              "  error %     +0.0  +12.5  -10.0\n"));
  EXPECT_THAT(text, HasSubstr("nu           0.260      -      -\n  model      0.210      -      -\n"
                              "  error      -0.05      -      -\n"));
  const std::string narrow = angle_table(found(), 25);  // two angles, then the third
  EXPECT_THAT(narrow, HasSubstr("theta [deg]      0     30\n"));
  EXPECT_THAT(narrow, HasSubstr("theta [deg]     75\n"));
  for (std::size_t from = 0; from < narrow.size(); from = narrow.find('\n', from) + 1)
    if (from > 0) {
      EXPECT_LE(narrow.find('\n', from) - from, 25U);
    }
}

}  // namespace
}  // namespace phy::report
