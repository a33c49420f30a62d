// Stress-strain curves of the running tests on a terminal (report/terminal_plot.hpp), above the line of
// progress.
#pragma once
#include <string>
#include <vector>

#include "report/terminal_plot.hpp"

namespace phy::cli {

class LivePlot {
 public:
  explicit LivePlot(std::vector<report::TerminalCurve> curves) : curves_(std::move(curves)) {}
  /// Strain and stress [Pa] of one specimen, growing while it is loaded. A test that starts over gives a
  /// smaller strain, and its curve begins anew.
  void add(std::size_t specimen, double strain, double stress);
  /// The picture, or nothing where it does not belong: no terminal, a dumb one, one without UTF-8, or with
  /// fewer than 72 columns or 24 lines.
  std::vector<std::string> lines() const;

 private:
  std::vector<report::TerminalCurve> curves_;
};

}  // namespace phy::cli
