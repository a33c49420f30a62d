// Fracture toughness in a calibration: K_Ic of the semi-circular bend test (lab/semi_circular_bend).
//
// A bonded model breaks at the end of a notch where the first bond there does, and what a bond feels of K_I
// shrinks with the root of its distance from that end: K_Ic = sigma_t sqrt(pi alpha R), sigma_t the tensile
// strength, R the mean radius of the grains (Potyondy & Cundall 2004, Int. J. Rock Mech. Min. Sci.
// 41:1329-1364). At strengths that the rest of a table fixes, K_Ic is a matter of the size of the grains: it
// is fitted where somebody has stated that size, else compared with, and the size that would meet it is told.
#pragma once
#include <string>
#include <vector>

#include "records/calibration.hpp"
#include "records/evidence.hpp"

namespace phy::calibrate {

/// K_Ic that was compared and not fitted, and the size of the grains that would meet it at the same strengths
/// (verdict/grain_size.hpp).
std::vector<Finding> toughness_findings(const std::vector<Comparison>& toughness, const Recipe& model);

}  // namespace phy::calibrate
