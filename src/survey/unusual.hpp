// Values that hardly any rock has, usually a unit or a column mistaken for another, and conversions that the
// table allows in part only. Nothing here is refused.
#pragma once
#include <vector>

#include "records/finding.hpp"

namespace phy::survey {

/// One finding for each kind of doubt about a property; of pairs of tests or lines one for each.
std::vector<Finding> unusual_values(const Rock& rock);

/// Of moduli in plane strain: what is taken for the rock along its bedding, and what cannot be converted.
std::vector<Finding> conversion_in_part(const Rock& rock);

}  // namespace phy::survey
