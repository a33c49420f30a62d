// calibration.json, and input for Yade: the numbers of the recipe in the other program's terms.
#include "report/calibration_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace phy::report {
namespace {

using testing::HasSubstr;

Recipe paper() {
  Recipe r;
  r.bedding.resize(1);
  r.bedding[0].theta = 30.0;
  return r;
}

TEST(YadeScript, MatchesTheStiffnessPerBondArea) {
  const std::string text = yade_script(paper());
  EXPECT_THAT(text, HasSubstr("young=1.1938052e+11"));  // pi/2 (38 + 38) GPa
  EXPECT_THAT(text, HasSubstr("jointCohesion=30000000"));
  EXPECT_THAT(text, HasSubstr("bedded=True"));
}

TEST(CalibrationJson, HoldsVerdictAndTablesAndNullForNoNumber) {
  Calibration c;
  c.rock = "r", c.verdict = {VerdictStatus::calibrated_except, {"why"}};
  Comparison row;
  row.target = {Property::ucs, 45.0, 50e6, 2e6, 3, false};
  c.fitted = {row};
  c.seconds = 17.0;
  const auto j = nlohmann::json::parse(calibration_json(c, "1.2"));
  EXPECT_EQ(j["verdict"]["status"], "calibrated except");
  EXPECT_EQ(j["fitted"][0]["theta [deg]"], 45.0);
  EXPECT_TRUE(j["fitted"][0]["model"].is_null());
  EXPECT_FALSE(j.contains("seconds"));
}

}  // namespace
}  // namespace phy::report
