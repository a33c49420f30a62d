// Is the model fine enough for its planes and for the half discs of a table? Few grains between planes blur
// the layers; a notch in few grains is blunt, and K_Ic of it too low.
#pragma once
#include <vector>

#include "records/evidence.hpp"
#include "records/finding.hpp"

namespace phy::survey {

constexpr double fewest_in_radius = 20.0;  ///< grains (docs/theory/calibration.md, "Fracture toughness")

/// Radius of the half disc of a target [m].
double radius_of(Recipe model, const Target& toughness);
/// Rounding errors forgiven.
double grains_in(double radius, double grain_size);

/// Planes with fewer grains between them than a test should have (records/quality.hpp).
std::vector<Finding> few_grains_between(const Evidence& evidence);

/// Half discs of a table that few grains of the model go into, once for each size.
std::vector<Finding> coarse_half_discs(const Evidence& evidence);

}  // namespace phy::survey
