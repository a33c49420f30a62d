// Figures over the inclination: a run beside a laboratory, and what a calibration has compared. Both are the
// same panels; the symbols, not the colours alone, tell the series apart.
#pragma once
#include <vector>

#include "records/calibration.hpp"
#include "records/rock.hpp"
#include "records/specimen_record.hpp"
#include "report/gnuplot.hpp"

namespace phy::report {

/// Each draws a figure that is `width` mm wide and returns its height.

/// E, strength and nu of the specimens, theory fitted to them, the laboratory.
double draw_anisotropy(GnuplotScript& s, const RunRecord& run, const std::vector<Target>& laboratory,
                       double width);

/// A panel per test of the table, from the numbers of calibration.json: those that report.html shows.
double draw_comparison(GnuplotScript& s, const Calibration& calibration, double width);

}  // namespace phy::report
