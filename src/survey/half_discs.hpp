// Is the model fine enough for the half discs of a table? A notch in few grains is blunt, and K_Ic of it too
// low.
#pragma once
#include <vector>

#include "records/evidence.hpp"
#include "records/finding.hpp"

namespace phy::survey {

/// Half discs of a table that few grains of the model go into, once for each size.
std::vector<Finding> coarse_half_discs(const Evidence& evidence);

}  // namespace phy::survey
