// What a table's E(theta) and nu(theta) say by themselves, before and beside any model of discs: whether a
// layered elastic body has them (theory/layered_fit.hpp), and whether planes in an isotropic rock have them.
#pragma once
#include <vector>

#include "records/finding.hpp"

namespace phy::survey {

/// What the E and nu of a bedded rock cannot be, with the cells that do not fit and what would; empty:
/// nothing of the kind. Cells without which the others are those of a body are named with the value that
/// these want; where there is none, the farthest from the nearest body.
std::vector<Finding> elastic_limits(const std::vector<Target>& targets);

/// What E read before the peak cannot be: other under another confining
/// stress, for bonds are as stiff under any (docs/theory/calibration.md). Empty: nothing of the kind.
std::vector<Finding> confinement_limits(const std::vector<Target>& targets, ModulusReading reading);

}  // namespace phy::survey
