// Eq. 2 of the paper on the packings at hand: K_n = a k_n + b and K_s = a k_s + b, how the stiffness of the
// planes that Eq. 1 reads from E(theta) follows that of the joints. And how far these lines move with what a
// user has to assume of the planes, the spacing and which contacts become joints (docs/theory/eq2.md): who
// takes Eq. 2 from another specimen, as the paper's method does, is wrong by as much.
#pragma once
#include <cstdint>
#include <vector>

#include "calibrate/simulator.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

/// Packings that eq2_band() takes the mean of, and its direct solutions for each setting.
constexpr int eq2_packings = 2;

/// The lines of a recipe, first as it is, then with the spacing times 0.7 and 1.4, by the other of the rules
/// zone and crossing, and by the zone rule with the thickness times 0.7 and 1.4. Joints have half, once and
/// twice their stiffness; E(theta) is of seven angles by direct solutions whose contacts also pull, Eq. 1
/// takes its E at 90 degrees. Empty where Eq. 1 is not of the model: no joints, or more than regular planes
/// of them in a matrix without directions. Lines that Eq. 1 gives no two points of are NaN.
std::vector<StiffnessRelation> eq2_band(const Recipe& recipe, const std::vector<std::int64_t>& seeds,
                                        Simulator& simulator);

/// Direct solutions behind a band.
std::int64_t n_solutions_of(const std::vector<StiffnessRelation>& band);

}  // namespace phy::calibrate
