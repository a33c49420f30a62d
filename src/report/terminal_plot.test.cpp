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

/// A panel with ends, of lines through points.
Panel panel_of(std::vector<Series> series) {
  Panel panel{"", "", Axis{"axial strain", "%"}, Axis{"axial stress", "MPa"}};
  panel.series = std::move(series);
  fit_axes(panel);
  return panel;
}
Series line(const std::string& name, std::vector<Point> points) {
  Series s{name, Mark::line};
  s.points = std::move(points);
  return s;
}

// From the lower left to the upper right corner: the first and last character hold one corner dot each.
TEST(TerminalPlot, ALineRunsFromCornerToCorner) {
  const auto lines = terminal_plot(panel_of({line("45°", {{0.0, 0.0}, {0.5, 80.0}})}), 34, 16, false);
  ASSERT_EQ(lines.size(), 16U);
  EXPECT_EQ(lines[0], "axial stress [MPa]");
  EXPECT_THAT(lines[1], StartsWith("     80│"));
  EXPECT_EQ(lines[1].substr(lines[1].size() - 3), "⠊");
  EXPECT_THAT(lines[13], StartsWith("      0│⡠"));
  EXPECT_THAT(lines[15], HasSubstr("0 ... 0.5 %  axial strain  ─ 45°"));
  for (const std::string& l : lines) EXPECT_LE(width_of(l), 34);
}

TEST(TerminalPlot, BoxesStandAboveTheirNamesInAPatternOfTheKey) {
  Panel panel{"", "", Axis{"specimen", "", -0.5, 1.5}, Axis{"share", "%", 0.0, 100.0}};
  panel.x.names = {"0°", "intact"};
  Series below{"tension", Mark::boxes}, above{"shear", Mark::boxes};
  above.number = 1, below.width = above.width = 0.8;
  below.points = {{0.0, nan, 0.0, 50.0}, {1.0, nan, 0.0, 100.0}}, above.points = {{0.0, nan, 50.0, 100.0}};
  panel.series = {below, above};
  const auto lines = terminal_plot(panel, 60, 14, false);
  EXPECT_THAT(lines[2], HasSubstr("⡪⡪"));
  EXPECT_THAT(lines[9], testing::Not(HasSubstr("⡪")));
  EXPECT_THAT(lines[12], testing::ContainsRegex("^ +0° +intact +$"));
  EXPECT_EQ(lines[13], "  specimen  ⣿ tension  ⡪ shear");
}

TEST(TerminalPlot, FitsAnyWidthInColourToo) {
  std::vector<Series> curves;
  for (int i = 0; i < 30; ++i)
    curves.push_back(line("theta " + std::to_string(i), {{0.0, 0.0}, {1.0, 3.0 + i}, {2.0, 1.0}}));
  for (const int columns : {30, 79, 200}) {
    const auto lines = terminal_plot(panel_of(curves), columns, 9, true);
    EXPECT_EQ(lines.size(), 9U);
    for (const std::string& l : lines) EXPECT_LE(width_of(l), columns);
  }
}

// 2^32 dots below the axis must not come back from above as a number that has run round.
TEST(TerminalPlot, FarBelowTheAxisIsBelowThePicture) {
  const double far_below = 0.5 - 4294967296.0 / 39;  // 10 lines of text hold 40 dots
  Panel drawn = panel_of({line("a", {{0.9, 1.0}, {1.0, 1.0}})}), empty = drawn;
  drawn.series[0].points = {{0.9, far_below}, {1.0, far_below}};
  empty.series[0].points = {{0.9, nan}};
  EXPECT_EQ(terminal_plot(drawn, 32, 14, false), terminal_plot(empty, 32, 14, false));
}

TEST(TerminalPlot, NothingIsDrawnFromAPointThatIsNotKnown) {
  Panel drawn = panel_of({line("a", {{0.0, nan}, {1.0, 1.0}})}), empty = drawn;
  empty.series[0].points = {{1.0, 1.0}};
  EXPECT_EQ(terminal_plot(drawn, 32, 14, false), terminal_plot(empty, 32, 14, false));
}

TEST(TerminalPlot, PointsHaveTheirBarsAndTextsTheirLetters) {
  Series bar{"a", Mark::points}, label{"", Mark::text};
  bar.points = {{0.5, 50.0, 0.0, 100.0}}, label.points = {{0.5, 100.0, nan, nan, "30°"}};
  const auto lines = terminal_plot(panel_of({bar, line("", {{0.0, 0.0}, {1.0, 0.0}}), label}), 32, 14, false);
  EXPECT_THAT(lines[1], HasSubstr("30°"));
  for (std::size_t row = 2; row < 11; ++row)
    EXPECT_NE(lines[row].substr(lines[row].find("│") + 3).find_first_not_of(' '), std::string::npos) << row;
}

TEST(TerminalPlot, NothingToDrawIsAnEmptyFrame) {
  EXPECT_EQ(terminal_plot(panel_of({}), 30, 6, true).size(), 6U);
  EXPECT_EQ(terminal_plot(panel_of({line("a", {{0.0, 0.0}})}), 30, 6, true).size(), 6U);
}

}  // namespace
}  // namespace phy::report
