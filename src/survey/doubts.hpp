// What to look at twice in a table before anything else is asked of it.
#pragma once
#include <vector>

#include "records/evidence.hpp"
#include "records/finding.hpp"

namespace phy::survey {

/// The sense of the angles, then units and ratios, then values that do not belong to the others. Whoever
/// reads a table for a user shows these first; they stop nothing.
std::vector<Finding> doubts_about(const Evidence& evidence);

}  // namespace phy::survey
