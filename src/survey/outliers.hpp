// Values of a table that do not belong to the others: typing errors, other rocks, failed tests.
//
// A specimen: its deviation from the mean of its cell over the scatter inside all cells of the property
// without it (externally studentised residual of a one-way layout; Student's t with the degrees of freedom
// that are left), judged over all specimens of the table at once (Bonferroni): a table without outliers
// names one in a time out of twenty at most. Deviations are relative (of nu absolute), so scatter is taken to
// grow with the mean; what is below the tolerance of the verdict is not reported, whatever its t.
//
// A cell of UCS: what the others predict there, by a straight line between its neighbours or by Jaeger's
// plane through all others, whichever is nearer. E and nu are held against layered bodies instead
// (elastic_limits.hpp).
#pragma once
#include <vector>

#include "records/finding.hpp"

namespace phy::survey {

/// Single specimens of cells of three or more.
std::vector<Finding> outlying_specimens(const Rock& rock);

/// Relative deviation of a UCS from the nearer of the two predictions by the others; NaN at the ends and
/// where these are too few for a plane.
double out_of_line(const std::vector<Target>& ucs, std::size_t cell);

/// Cells of UCS beyond three standard errors, of the cells and of the prediction, whose share is what it
/// misses of rocks of the maps (12 %).
std::vector<Finding> outlying_cells(const std::vector<Target>& targets);

}  // namespace phy::survey
