// Cutting: a round specimen from the middle of a packing.
#pragma once
#include <memory>

#include "records/recipe.hpp"
#include "records/specimen.hpp"

namespace phy::genesis {

/// The discs whose centres lie within diameter / 2 [m] of the box's centre, in their order, in a square box
/// that holds them all, centre on centre. Centres decide, not outlines: on average the rough rim then lies at
/// the diameter asked for. The report stays that of the packing it was cut from. 0 < diameter <= the smaller
/// side.
Packing cut_disc(const Packing& packing, double diameter);

/// The packing in the shape that the recipe's test needs: as it is, or the disc cut from it.
std::shared_ptr<const Packing> shaped(std::shared_ptr<const Packing> packing, const Recipe& recipe);

}  // namespace phy::genesis
