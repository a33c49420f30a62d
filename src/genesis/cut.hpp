// Cutting: a round specimen from the middle of a packing.
#pragma once
#include "records/specimen.hpp"

namespace phy {

/// The discs whose centres lie within diameter / 2 [m] of the box's centre, in their order, in a square box
/// that holds them all, centre on centre. Centres decide, not outlines: on average the rough rim then lies at
/// the diameter asked for. The report stays that of the packing it was cut from. 0 < diameter <= the smaller
/// side.
Packing cut_disc(const Packing& packing, double diameter);

/// Diameter of the disc that the recipe's Brazilian test cuts [m]: test.disc_diameter, or the smaller side of
/// the specimen where that is 0.
double disc_diameter(const Recipe& recipe);

}  // namespace phy
