#include "cli/live_plot.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "report/run_figures.hpp"
#include "report/terminal_plot.hpp"
#include "system/terminal.hpp"

namespace phy::cli {
namespace {

// On fewer lines than 24 the picture would push away what was printed before it.
constexpr int least_columns = 72, least_rows = 24, most_columns = 120, height = 14;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// As the C library chooses: the first of the three that is set.
bool speaks_utf8() {
  // The variables and not the C locale: the program never leaves the locale "C", so that numbers keep their
  // points.
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
  const system::TerminalSize size = system::terminal_size(system::standard_error);
  const std::string terminal = environment("TERM");
  // An empty TERM is no terminal that understands cursor movement, as in some editors.
  if (size.columns < least_columns || size.lines < least_rows || terminal.empty() || terminal == "dumb")
    return 0;
  // Curves are drawn in Braille dots, which other encodings lack. The last column stays free: filled, it
  // wraps.
  return speaks_utf8() ? std::min(size.columns - 1, most_columns) : 0;
}

}  // namespace

LivePlot::LivePlot(const TestCurve& test, const std::vector<std::shared_ptr<const Specimen>>& specimens)
    : strain_factor_(test.strain_factor), panel_(report::curve_panel(test)) {
  for (const auto& specimen : specimens) {
    TestResult r;
    // A result that exists only for its name and colour: they must be those of the figures.
    r.intact = !layered(*specimen);
    r.theta = r.intact ? 0.0 : inclination(*specimen);
    panel_.series.push_back(report::series_of(r, report::Mark::line, static_cast<int>(panel_.series.size())));
    panel_.series.back().name = report::heading(r);
  }
}

void LivePlot::add(std::size_t specimen, double strain, double stress) {
  std::vector<report::Point>& points = panel_.series.at(specimen).points;
  const report::Point next{strain_factor_ * strain, 1e-6 * stress};
  // A test may start over, from a smaller strain: its curve of before would make a loop.
  if (!points.empty() && next.x < points.back().x) points.clear();
  points.push_back(next);
}

std::vector<std::string> LivePlot::lines() const {
  const int columns = picture_columns();
  if (columns == 0) return {};
  report::Panel shown = panel_;
  report::fit_axes(shown);
  // NO_COLOR is a common agreement of terminal programs: set to anything, it forbids colours.
  return report::terminal_plot(shown, columns, height, environment("NO_COLOR").empty());
}

}  // namespace phy::cli
