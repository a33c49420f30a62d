// The parameters of a calibration as its stages hand them on.
#pragma once
#include "records/parameters.hpp"

namespace phy::calibrate {

/// The elastic parameters of another recipe; everything else stays.
Recipe with_moduli(Recipe recipe, const Recipe& moduli);

}  // namespace phy::calibrate
