// What a calibration says in few lines: like cells once, nothing that the findings do not say.
#include "report/calibration_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report/calibration_tables.hpp"

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

/// UCS at 0, 30, 75 and BTS at 30 degrees; the findings are of a verdict.
Calibration found() {
  Calibration c;
  c.fitted = {row(Property::nu, 0, 0.26, 0.21), row(Property::ucs, 0, 50e6, 50e6),
              row(Property::ucs, 30, 40e6, 44e6), row(Property::ucs, 75, 60e6, 60e6),
              row(Property::brazilian, 30, 10e6, 8e6)};
  c.verification = c.fitted;
  c.verification[2].mean = 45e6, c.verification[3].mean = 54e6;
  c.verdict.status = VerdictStatus::out_of_reach;
  c.verdict.findings = {"nu(0) = 0.210 instead of 0.260",
                        "UCS(30) = 45.0 MPa on unseen packings, +12.5 % from 40.0 MPa",
                        "UCS(75) = 54.0 MPa on unseen packings, -10.0 % from 60.0 MPa",
                        "UCS/BTS(30) = 4.0 in the laboratory, 5.6 in the nearest model", "something else"};
  ParameterEstimate open;
  open.symbol = "mu";
  c.parameters = {open, open};
  c.parameters[1].symbol = "phi";
  return c;
}

TEST(CalibrationSummary, CellsOfOnePropertyAreOneLine) {
  EXPECT_THAT(summary_lines(found()),
              ElementsAre("nu 0.05 off at 0 degrees", "UCS 10 - 12 % off at 30, 75 degrees",
                          "UCS/BTS 4.0 in the laboratory, 5.6 in the nearest model, at 30 degrees",
                          "something else", "left open by the data: mu, phi"));
}

TEST(CalibrationSummary, CellsThatNoFindingNamesStaySilent) {
  Calibration c = found();
  c.verdict.findings = {"the strengths as a whole are 10 % off"};
  c.parameters.clear();
  EXPECT_THAT(summary_lines(c), ElementsAre("the strengths as a whole are 10 % off"));
}

TEST(CalibrationSummary, CellsWithoutAnAnswerShareALineToo) {
  Calibration c = found();
  c.verification[1].mean = c.verification[2].mean = std::nan("");
  c.verdict.findings = {"UCS(0), UCS(30): no test on unseen packings gave a usable peak (never)"};
  c.parameters.clear();
  EXPECT_THAT(summary_lines(c), ElementsAre("UCS: no answer at 0, 30 degrees"));
}

TEST(CalibrationSummary, NoMoreThanTenLinesOfAnyTerminal) {
  Calibration c = found();
  for (int i = 0; i < 30; ++i)
    c.verdict.findings.push_back("a finding of some length, number " + std::to_string(i));
  c.notes = {"a note"};
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
