// Does a table mean theta or beta = 90 - theta? Asked of each property by itself.
//
// What layers make of a property over theta has a sense: slip on a plane is easiest between 45 and 75
// degrees, E grows towards 90 degrees, a disc splits more easily with its layers along the load. Each
// property is held against a family of such curves, once with its angles as they are and once with their
// complements:
//
//   m = mean over the curves of exp(-chi^2/2),   chi^2 = sum (log value - log curve - level)^2/(s^2 + t^2)
//
// s: standard error of the cell, t: by how much rocks are off such curves, the level free. Half of the weight
// has a flat curve, so that chance in a rock without anisotropy says nothing. A share e of rocks breaks the
// rule though their table is right, so that a property speaks for its complement by the odds
//
//   ((1 - e) m' + e m)/((1 - e) m + e m')      between e/(1 - e) and (1 - e)/e, however good the data
//
// The prior: one table in ten means the other angle than the one by which it is read, and one column in
// twenty counts otherwise than its table. The likeliest of all 2^n readings decides. How often that accuses
// and finds: docs/theory/calibration.md.
#pragma once
#include <vector>

#include "records/finding.hpp"

namespace phy::survey {

/// Where the likeliest reading of a table is not the one as it is written: `angles_exchanged` or
/// `columns_exchanged`, with what planes miss of each property both ways. `from_load`: the table counts beta.
std::vector<Finding> angle_question(const std::vector<Target>& targets, bool from_load);

}  // namespace phy::survey
