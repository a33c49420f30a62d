#include "base/option.hpp"

#include <gtest/gtest.h>

namespace phy {
namespace {

TEST(Option, AtTheCommandLine) {
  EXPECT_EQ(option("max-tests"), "--max-tests");
  EXPECT_EQ(option("LAW"), "LAW");
  EXPECT_EQ(option_set("resume"), "--resume");
  EXPECT_EQ(option_set("method", "sequence"), "--method sequence");
  EXPECT_EQ(option_set("to", "1 um, 8 um"), "--to \"1 um, 8 um\"");
  EXPECT_EQ(option_set("set k_n", "1 N/m"), "--set \"k_n=1 N/m\"");
  EXPECT_EQ(to_line(option_problem("max-tests", "60", "at least 90", "")),
            "command line: --max-tests = 60: expected at least 90");
}

}  // namespace
}  // namespace phy
