// Figures of what varies: the paper's Figs. 4 (macro stiffnesses), 5 (E) and 6 (strength) over its
// parameters.
#pragma once
#include <vector>

#include "records/variation.hpp"
#include "report/gnuplot.hpp"

namespace phy::report {

// All return the height of the figure [mm] for its width.

/// K_n and K_s over every parameter, divided by its base, from Eq. 1 fitted to E(theta); dashed: what others
/// found for them.
double draw_stiffness(GnuplotScript& script, const Variation& variation, double width);
/// E(theta), one panel per stiffness of the joints and one colour per value; lines: Eq. 1 fitted.
double draw_modulus(GnuplotScript& script, const Variation& variation, double width);
/// UCS(theta), one panel per parameter and one colour per value.
double draw_strength(GnuplotScript& script, const Variation& variation, double width);

}  // namespace phy::report
