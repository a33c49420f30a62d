// A panel on a terminal: eight dots to a character (Unicode's Braille patterns), axes left and below.
#pragma once
#include <string>
#include <vector>

#include "report/figure.hpp"

namespace phy::report {

/// A picture of exactly `rows` lines, each at most `columns` characters wide, of a panel with ends: what is
/// measured upwards first, what to the right and the names of the series last, as far as there is room.
/// `colored`: with ANSI escapes. Needs rows >= 6 and columns >= 30.
std::vector<std::string> terminal_plot(const Panel& panel, int columns, int rows, bool colored);

}  // namespace phy::report
