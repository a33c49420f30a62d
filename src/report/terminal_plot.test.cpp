#include "report/terminal_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/nan.hpp"

namespace phy::report {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// Characters, not bytes; escapes are none.
int width_of(const std::string& line) {
  int n = 0;
  bool escape = false;
  for (const char c : line) {
    if (c == '\033') escape = true;
    if (!escape && (static_cast<unsigned char>(c) & 0xC0U) != 0x80U) ++n;
    if (escape && c == 'm') escape = false;
  }
  return n;
}

// From the lower left to the upper right corner: the first and last character hold one corner dot each.
TEST(TerminalPlot, ALineRunsFromCornerToCorner) {
  const auto lines = terminal_plot({{"45", 0, {0.0, 0.5}, {0.0, 80.0}}}, "%", "MPa", 32, 14, false);
  ASSERT_EQ(lines.size(), 14U);
  EXPECT_THAT(lines[0], StartsWith("     80│"));
  EXPECT_THAT(lines[1], StartsWith("    MPa│"));
  EXPECT_EQ(lines[0].substr(lines[0].size() - 3), "⠊");
  EXPECT_THAT(lines[11], StartsWith("      0│⡠"));
  EXPECT_THAT(lines[13], HasSubstr("0 ... 0.5 %  45"));
  for (const std::string& line : lines) EXPECT_LE(width_of(line), 32);
}

TEST(TerminalPlot, FitsAnyWidthInColourToo) {
  std::vector<TerminalCurve> curves;
  for (int i = 0; i < 30; ++i)
    curves.push_back({"theta " + std::to_string(i), 0xff0000, {0.0, 1.0, 2.0}, {0.0, 3.0 + i, 1.0}});
  for (const int columns : {30, 79, 200})
    for (const std::string& line : terminal_plot(curves, "%", "MPa", columns, 8, true))
      EXPECT_LE(width_of(line), columns);
}

// 2^32 dots below the axis must not come back from above as a number that has run round.
TEST(TerminalPlot, FarBelowTheAxisIsBelowThePicture) {
  const TerminalCurve frame{"frame", 0, {1.0}, {1.0}};
  const double far_below = 0.5 - 4294967296.0 / 47;  // 12 lines of text hold 48 dots
  const auto lines =
      terminal_plot({frame, {"a", 0, {0.9, 1.0}, {far_below, far_below}}}, "%", "MPa", 32, 14, false);
  const auto empty = terminal_plot({frame, {"a", 0, {}, {}}}, "%", "MPa", 32, 14, false);
  EXPECT_EQ(lines, empty);
}

TEST(TerminalPlot, NothingIsDrawnFromAPointThatIsNotKnown) {
  const double unknown = nan;
  const auto lines = terminal_plot({{"a", 0, {0.0, 1.0}, {unknown, 1.0}}}, "%", "MPa", 32, 14, false);
  const auto empty = terminal_plot({{"a", 0, {1.0}, {1.0}}}, "%", "MPa", 32, 14, false);
  EXPECT_EQ(lines, empty);
}

TEST(TerminalPlot, NothingToDrawIsAnEmptyFrame) {
  EXPECT_EQ(terminal_plot({}, "%", "MPa", 30, 4, true).size(), 4U);
  EXPECT_EQ(terminal_plot({{"a", 0, {0.0}, {0.0}}}, "%", "MPa", 30, 4, true).size(), 4U);
}

}  // namespace
}  // namespace phy::report
