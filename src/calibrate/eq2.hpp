// Eq. 2 of the paper on the packings at hand: K_n = a k_n + b and K_s = a k_s + b, how the stiffness of the
// planes that Eq. 1 reads from E(theta) follows that of the joints. And how far these lines move with what a
// user has to assume of the planes: their spacing, and which contacts become joints. The relation is no line
// (docs/theory/eq2.md); where it bends much K/k at the calibrated joints says more than slope and intercept.
#pragma once
#include <cstdint>
#include <vector>

#include "calibrate/simulator.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

/// Is Eq. 1 of the model? One set of regular planes in a matrix without directions.
bool has_eq2(const Recipe& recipe);

/// The lines of a recipe that has them, first as it is, then with the spacing times 0.7 and 1.4, by the other
/// of the rules zone and crossing, and by the zone rule with the thickness times 0.7 and 1.4. Joints have
/// half, once and twice their stiffness; E(theta) is of seven angles by direct solutions whose contacts also
/// pull, mean over the packings `seeds`; Eq. 1 takes its E at 90 degrees. NaN where Eq. 1 does not hold of
/// all three.
std::vector<PlaneStiffness> eq2_band(const Recipe& recipe, const std::vector<std::int64_t>& seeds,
                                     Simulator& simulator);

}  // namespace phy::calibrate
