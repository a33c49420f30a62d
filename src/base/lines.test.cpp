// What is said of several things stands on one line.
#include "base/lines.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace phy {
namespace {

TEST(Lines, ThatSayTheSameAreOneAndOthersStayApart) {
  std::vector<std::string> lines;
  add_line(lines, "E(0)", "no answer");
  add_line(lines, "nu(0)", "another answer");
  add_line(lines, "E(15)", "no answer");
  add_line(lines, "E(30)", "answer");
  EXPECT_THAT(lines,
              testing::ElementsAre("E(0), E(15): no answer", "nu(0): another answer", "E(30): answer"));
}

}  // namespace
}  // namespace phy
