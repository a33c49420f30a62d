// Curves on a terminal: eight dots to a character (Unicode's Braille patterns), axes left and below.
#pragma once
#include <string>
#include <vector>

#include "report/palette.hpp"

namespace phy::report {

struct TerminalCurve {
  std::string label;
  Color color = 0;
  std::vector<double> x, y;  ///< of the same length
};

/// A picture of exactly `rows` lines, each at most `columns` characters wide, from 0 to the largest x and y;
/// the last line names the axes and the curves as far as there is room. `colored`: with ANSI escapes. Needs
/// rows >= 4 and columns >= 30.
std::vector<std::string> terminal_plot(const std::vector<TerminalCurve>& curves, const std::string& x_unit,
                                       const std::string& y_unit, int columns, int rows, bool colored);

}  // namespace phy::report
