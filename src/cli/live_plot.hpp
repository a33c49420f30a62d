// Stress-strain curves of the running tests on a terminal (report/terminal_plot.hpp), above the line of
// progress.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "records/specimen.hpp"
#include "records/test_description.hpp"
#include "report/figure.hpp"

namespace phy::cli {

class LivePlot {
 public:
  /// A curve for each specimen of a test.
  LivePlot(const TestCurve& test, const std::vector<std::shared_ptr<const Specimen>>& specimens);
  /// Strain and stress [Pa] of one specimen, growing while it is loaded. A test that starts over gives a
  /// smaller strain, and its curve begins anew.
  void add(std::size_t specimen, double strain, double stress);
  /// The picture, or nothing where it does not belong: no terminal, a dumb one, one without UTF-8, or with
  /// fewer than 72 columns or 24 lines.
  std::vector<std::string> lines() const;

 private:
  double strain_factor_;  // to the unit of the axis
  report::Panel panel_;
};

}  // namespace phy::cli
