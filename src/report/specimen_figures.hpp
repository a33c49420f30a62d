// Figures of specimens as pictures of discs: pixels in a gnuplot script, with titles and a key about them.
#pragma once
#include "records/specimen_record.hpp"
#include "report/gnuplot.hpp"

namespace phy::report {

// All are `width` mm wide, return their height [mm], and throw InputError when no specimen of the run has
// displacements.

/// All side by side before the test.
double draw_specimens(GnuplotScript& script, const RunRecord& run, double width);
/// The same at its end, with cracks by mode and place.
double draw_cracks(GnuplotScript& script, const RunRecord& run, double width);
/// The specimen nearest to 30 degrees before the test, and a window on its bedding.
double draw_model(GnuplotScript& script, const RunRecord& run, double width);

}  // namespace phy::report
