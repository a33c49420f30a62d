// Views that several texts share, and the table of angles.
#include "report/calibration_summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/calibration_tables.hpp"

namespace phy::report {
namespace {

using testing::HasSubstr;

Comparison row(Property p, double theta, double laboratory, double model) {
  Comparison c;
  c.target = {p, theta, laboratory, 0.05 * laboratory, 3, false};
  c.mean = model, c.n_packings = 5;
  return c;
}

/// UCS at 0, 30, 75 and BTS at 30 degrees.
Calibration found() {
  Calibration c;
  c.fitted = {row(Property::nu, 0, 0.26, 0.21), row(Property::ucs, 0, 50e6, 50e6),
              row(Property::ucs, 30, 40e6, 44e6), row(Property::ucs, 75, 60e6, 60e6),
              row(Property::brazilian, 30, 10e6, 8e6)};
  c.verification = c.fitted;
  c.verification[2].mean = 45e6, c.verification[3].mean = 54e6;
  ParameterEstimate open;
  open.symbol = "mu";
  c.parameters = {open, open};
  c.parameters[1].symbol = "phi";
  return c;
}

TEST(CalibrationSummary, ValuesAreJudgedOnUnseenPackingsAndOpenParametersNamed) {
  const Calibration c = found();
  EXPECT_EQ(judged(c, c.fitted[2]).mean, 45e6);
  EXPECT_EQ(open_parameters(c), "mu and phi");
  EXPECT_THAT(open_lines(c), testing::ElementsAre(HasSubstr("mu and phi")));
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
