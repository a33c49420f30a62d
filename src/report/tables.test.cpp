#include "report/tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace phy {
namespace {

std::vector<TestResult> two() {
  std::vector<TestResult> all(2);
  all[0].name = "theta = 0 deg";
  all[0].outcome.status = Status::peaked;
  all[0].numbers = {{"ucs", 111.914e6, "Pa", "", ""}, {"E_tangent", 23.1e9, "Pa", "", ""}};
  all[1].name = "intact";
  all[1].outcome = {Status::unstable, "at step 7 all went wrong", "lower engine.step_safety"};
  return all;
}

TEST(PressTable, ShowsNumbersInTheirUnits) {
  const std::string t = press_table(two(), 200);
  EXPECT_THAT(t, testing::HasSubstr("111.91"));
  EXPECT_THAT(t, testing::HasSubstr("23.10"));
  EXPECT_THAT(t, testing::HasSubstr("MPa"));
}

TEST(PressTable, NeverExceedsTheTerminal) {
  for (const int width : {60, 80, 100, 160}) {
    std::istringstream lines(press_table(two(), width));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(static_cast<int>(line.size()), width);
  }
}

TEST(PressTable, BecomesAListOnANarrowTerminal) {
  EXPECT_THAT(press_table(two(), 40), testing::HasSubstr("  UCS      MPa     111.91\n"));
}

TEST(OutcomeLines, SayWhatFailedAndWhatToDo) {
  EXPECT_EQ(outcome_lines(two()), "intact: unstable: at step 7 all went wrong; lower engine.step_safety\n");
}

}  // namespace
}  // namespace phy
