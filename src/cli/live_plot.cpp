#include "cli/live_plot.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "cli/terminal.hpp"

namespace phy::cli {
namespace {

constexpr int least_columns = 72, least_rows = 24, most_columns = 120, height = 14;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// As the C library chooses: the first of the three that is set.
bool speaks_utf8() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    std::string value = environment(name);
    if (value.empty()) continue;
    std::transform(value.begin(), value.end(), value.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    return value.find("utf-8") != value.npos || value.find("utf8") != value.npos;
  }
  return false;
}

/// Columns for the picture; 0: none.
int picture_columns() {
  const TerminalSize size = terminal_size(STDERR_FILENO);
  const std::string terminal = environment("TERM");
  if (size.columns < least_columns || size.lines < least_rows || terminal.empty() || terminal == "dumb")
    return 0;
  return speaks_utf8() ? std::min(size.columns - 1, most_columns) : 0;
}

}  // namespace

void LivePlot::add(std::size_t specimen, double strain, double stress) {
  report::TerminalCurve& c = curves_.at(specimen);
  if (!c.x.empty() && 100.0 * strain < c.x.back()) c.x.clear(), c.y.clear();
  c.x.push_back(100.0 * strain), c.y.push_back(1e-6 * stress);
}

std::vector<std::string> LivePlot::lines() const {
  const int columns = picture_columns();
  if (columns == 0) return {};
  return report::terminal_plot(curves_, "%", "MPa", columns, height, environment("NO_COLOR").empty());
}

}  // namespace phy::cli
