// A number that could not be determined.
#pragma once
#include <limits>

namespace phy {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

}  // namespace phy
