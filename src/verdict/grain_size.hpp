// Which grains would meet a fracture toughness: at the same strengths K_Ic grows with the root of their size
// (Potyondy & Cundall 2004, Int. J. Rock Mech. Min. Sci. 41:1329-1364).
#pragma once
#include <vector>

#include "records/calibration.hpp"

namespace phy::verdict {

/// Mean diameter of the grains [m] that would meet the table at the same strengths:
/// d (K_Ic of the table/K_Ic of the model)^2, the geometric mean over the rows; NaN without an answer.
double grain_size_to_meet(const std::vector<Comparison>& toughness, double grain_size);

/// May a specimen of the model's size be made of grains of this mean diameter [m]?
bool can_hold(const Recipe& model, double grain_size);

}  // namespace phy::verdict
