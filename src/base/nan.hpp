// A number that could not be determined, and one that nothing bounds.
#pragma once
#include <limits>

namespace phy {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace phy
