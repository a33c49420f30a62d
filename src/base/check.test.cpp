// In what order are problems told?
#include "base/check.hpp"

#include <gtest/gtest.h>

namespace phy {
namespace {

std::string reported(const std::vector<const char*>& places) {
  std::vector<Problem> problems;
  for (const char* where : places) problems.push_back({where, std::to_string(problems.size()), "", "", ""});
  return InputError(std::move(problems)).what();
}

TEST(InputError, TellsProblemsInTheOrderOfTheirLines) {
  EXPECT_EQ(reported({"a.toml:12", "a.toml:3", "a.toml", "a.toml:3"}),
            "a.toml: 2\na.toml:3: 1\na.toml:3: 3\na.toml:12: 0");
}

TEST(InputError, TellsFileByFile) {
  EXPECT_EQ(reported({"b.csv:7", "a.toml:2", "b.csv:1", "command line", "a.toml at x = 1:2", "a.toml:1"}),
            "b.csv:1: 2\nb.csv:7: 0\na.toml:1: 5\na.toml:2: 1\ncommand line: 3\na.toml at x = 1:2: 4");
}

TEST(InputError, LeavesEmptyPartsOut) {
  EXPECT_EQ(to_line({"a.toml:1", "mu", "-1", "mu >= 0", "take 0.5"}),
            "a.toml:1: mu = -1: expected mu >= 0; take 0.5");
  EXPECT_EQ(to_line({"", "mu", "", "", ""}), "mu");
}

}  // namespace
}  // namespace phy
