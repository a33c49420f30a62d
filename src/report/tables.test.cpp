#include "report/tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include <sstream>

#include "base/nan.hpp"

namespace phy::report {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<TestResult> two() {
  std::vector<TestResult> all(2);
  all[0].name = "theta = 30 deg";
  all[0].intact = false, all[0].theta = 30.0;
  all[0].n_steps = 61200, all[0].seconds = 11.04;
  all[0].outcome.status = Status::peaked;
  all[0].numbers = {{"E_tangent", 23.104e9, "Pa", "", ""},
                    {"E_secant", 24.0e9, "Pa", "", ""},
                    {"nu", 0.2514, "1", "", ""},
                    {"ucs", 111.914e6, "Pa", "", ""},
                    {"sigma_ci", 44.4e6, "Pa", "", "below 44.4 MPa: the crack came early", true},
                    {"sigma_ci_strain", 70e6, "Pa", "", ""},
                    {"sigma_cd", 99.9e6, "Pa", "", ""},
                    {"energy_error", 0.00066, "1", "", ""},
                    {"porosity", 0.1, "1", "", ""},
                    {"cracks_tension_matrix", 850, "1", "", ""},
                    {"cracks_shear_matrix", 64, "1", "", ""},
                    {"cracks_tension_bedding", 12, "1", "", ""},
                    {"cracks_shear_bedding", 7, "1", "", ""}};
  all[1].name = "intact";
  all[1].outcome = {Status::unstable, "at step 7 all went wrong", "lower engine.step_safety"};
  all[1].numbers = {{"ucs", nan, "Pa", "", "no peak"}};
  return all;
}

std::size_t widest(const std::string& text) {
  std::size_t w = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) w = std::max(w, line.size());
  return w;
}

TEST(PressTable, OneTableWithUnits) {
  EXPECT_EQ(
      press_table(two(), 200),
      " theta  E tan50  E sec50     nu     UCS  sigma_ci  ci strain  sigma_cd   energy  cracks matrix  "
      "cracks "
      "bedding  steps   CPU   outcome    quality\n"
      "   deg      GPa      GPa            MPa       MPa        MPa       MPa    error  tension/shear   "
      "tension/shear            s\n"
      "------  -------  -------  -----  ------  --------  ---------  --------  -------  -------------  "
      "--------------  -----  ----  --------  ---------\n"
      "    30    23.10    24.00  0.251  111.91    <44.40      70.00     99.90  0.00066         850/64        "
      "    "
      "12/7  61200  11.0    peaked       good\n"
      "intact        -        -      -       -         -          -         -        -            -/-        "
      "     "
      "-/-      0   0.0  unstable  no result\n");
}

// What a measure says of nu alone stands beside nu alone, and below the table by name.
TEST(PressTable, AMeasureOfSingleNumbersMarksThese) {
  auto results = two();
  results[0].numbers.push_back({"nu_spread", 0.07, "1", "", ""});
  const std::string table = press_table(results, 0);
  EXPECT_THAT(table, testing::AllOf(HasSubstr("0.251*"), HasSubstr(" 23.10  "), HasSubstr(" 111.91  ")));
  EXPECT_THAT(table, HasSubstr("warning"));
  EXPECT_THAT(outcome_lines(results),
              testing::AllOf(HasSubstr("warning for nu, nu_platen: nu_spread above 0.05: "),
                             HasSubstr("(theta = 30 deg 0.07)")));
}

TEST(PressTable, NoLimitForOutputThatIsNoTerminal) {
  EXPECT_EQ(press_table(two(), 0), press_table(two(), 1000));
}

TEST(PressTable, TwoStackedTablesWhenOneIsTooWide) {
  const std::size_t full = widest(press_table(two(), 0));
  EXPECT_EQ(press_table(two(), static_cast<int>(full)), press_table(two(), 0));
  const std::string stacked = press_table(two(), static_cast<int>(full) - 1);
  EXPECT_EQ(press_table(two(), 80), stacked);
  const std::size_t gap = stacked.find("\n\n");
  ASSERT_NE(gap, std::string::npos);
  const std::string upper = stacked.substr(0, gap), lower = stacked.substr(gap + 2);
  for (const std::string& part : {upper, lower}) {
    EXPECT_THAT(part, HasSubstr(" theta"));
    EXPECT_THAT(part, HasSubstr("\nintact  "));
  }
  EXPECT_THAT(upper, HasSubstr("UCS"));
  EXPECT_THAT(lower, HasSubstr("12/7"));
  EXPECT_THAT(lower, Not(HasSubstr("UCS")));
}

TEST(PressTable, NeverExceedsTheTerminal) {
  auto long_run = two();
  long_run[0].n_steps = 1234567890123456789;  // now the lower table is the wider one
  for (const auto& results : {two(), long_run})
    for (std::size_t width = 40; width <= 160; ++width)
      EXPECT_LE(widest(press_table(results, static_cast<int>(width))), width) << width;
}

TEST(PressTable, NamesWhenTheAnglesDoNotTellSpecimensApart) {
  auto all = two();
  all[0].intact = true, all[0].name = "intact, seed 2";
  EXPECT_THAT(press_table(all, 0), HasSubstr("intact, seed 2"));
  EXPECT_THAT(press_table(all, 0), Not(HasSubstr("theta")));
}

TEST(PressTable, AnInterruptedTestHasNoNumbers) {
  auto all = two();
  all[0].outcome.status = Status::interrupted;
  EXPECT_THAT(press_table(all, 0), Not(HasSubstr("23.10")));
  EXPECT_THAT(press_table(all, 0), HasSubstr("-/-             -/-  61200  11.0  interrupted  no result\n"));
}

TEST(PressTable, NoResultsGiveTheHeadOnly) { EXPECT_THAT(press_table({}, 0), HasSubstr("UCS")); }

TEST(PressTable, MarksATensileStrengthWithAReservation) {
  std::vector<TestResult> discs(2);
  for (TestResult& r : discs) {
    r.kind = TestKind("brazilian"), r.outcome.status = Status::peaked;
    r.numbers = {{"bts", 9e6, "Pa", "", ""}};
  }
  discs[0].name = "theta = 30 deg", discs[0].intact = false, discs[0].theta = 30.0;
  discs[0].numbers[0].note = "no tensile strength: the first crack came 0.34 diameters from the centre";
  discs[1].name = "intact";
  const std::string table = press_table(discs, 0);
  EXPECT_THAT(table, HasSubstr("\n    30  9.00*  "));
  EXPECT_THAT(table, HasSubstr("\nintact   9.00  "));
  EXPECT_EQ(
      outcome_lines(discs),
      "BTS *: no tensile strength: the first crack came 0.34 diameters from the centre (theta = 30 deg)\n");
}

TEST(OutcomeLines, SayWhyADashStandsInTheTable) {
  std::vector<TestResult> all(3);
  for (std::size_t i = 0; i < 3; ++i) {
    all[i].name = "test " + std::to_string(i);
    all[i].outcome = {Status::peaked, "", ""};
    all[i].numbers = {{"sigma_cd", i == 1 ? 40e6 : std::nan(""), "Pa", "", i == 1 ? "" : "it never turns"}};
  }
  EXPECT_EQ(outcome_lines(all), "sigma_cd -: it never turns (test 0, test 2)\n");
}

TEST(OutcomeLines, AKneeIsAStrengthWithARemark) {
  std::vector<TestResult> all(1);
  all[0].name = "intact", all[0].outcome = {Status::knee, "the axial stress bends at 90.00 MPa", ""};
  all[0].numbers = {{"ucs", 90e6, "Pa", "", "a knee, no peak"}, {"rattlers", 0.16, "1", "", ""}};
  EXPECT_THAT(press_table(all, 0), HasSubstr("90.00*"));
  EXPECT_EQ(
      outcome_lines(all),
      "UCS *: a knee, no peak (intact)\n"
      "warning: rattlers above 0.1: this share of the grains can carry nothing; put more discs into the "
      "box (packing.n_grains, packing.porosity or the imported file) (intact 0.16)\n"
      "intact: knee: the axial stress bends at 90.00 MPa\n");
}

TEST(OutcomeLines, TellARemarkOnceWithTheTestsThatItIsSaidOf) {
  std::vector<TestResult> all(3);
  for (std::size_t i = 0; i < 3; ++i) {
    all[i].name = "test " + std::to_string(i);
    all[i].outcome = {Status::peaked, "", ""};
    all[i].numbers = {{"rattlers", i == 1 ? 0.02 : 0.16 + 0.02 * static_cast<double>(i), "1", "", ""}};
  }
  EXPECT_EQ(
      outcome_lines(all),
      "warning: rattlers above 0.1: this share of the grains can carry nothing; put more discs into the box "
      "(packing.n_grains, packing.porosity or the imported file) (test 0 0.16, test 2 0.2)\n");
  for (TestResult& r : all) r.outcome = {Status::untrusted, "rattlers 0.4", "raise it"};
  EXPECT_EQ(outcome_lines({all[0]}), "test 0: untrusted: rattlers 0.4; raise it\n");
}

TEST(OutcomeLines, SayWhatFailedAndWhatToDo) {
  EXPECT_EQ(outcome_lines(two()), "intact: unstable: at step 7 all went wrong; lower engine.step_safety\n");
  auto bare = two();
  bare[1].outcome = {Status::interrupted, "", ""};
  EXPECT_EQ(outcome_lines(bare), "intact: interrupted\n");
  EXPECT_EQ(outcome_lines({}), "");
}

}  // namespace
}  // namespace phy::report
