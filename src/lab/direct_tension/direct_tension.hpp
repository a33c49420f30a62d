// Direct tension: two grips pull the ends of the specimen apart.
//
// A grip holds the grains whose centres lie within test.grip_thickness of an end, along the load only: they
// may move sideways and turn, so that the ends do not hinder the lateral contraction (glued steel caps
// would). The specimen starts with the velocity field of uniform straining, so that no wave runs in from the
// grips. Grips move at the speed of the test each until the stress has fallen (stop rule: lab/procedure.hpp,
// on tension).
//
// History, compression positive as everywhere, so stress and strain are negative: stress is the mean grip
// force over the initial width; strain the approach of the grips over the free length between them. Numbers
// (reading.hpp) are read from the mirrored history: tensile strength is positive.
#pragma once
#include "lab/room.hpp"

namespace phy::lab {

/// Thickness of a grip [m]: the recipe's, or four times the largest radius where that is 0.
double grip_thickness(const Recipe& recipe, const Packing& packing);

/// Two grips that hold the grains within `thickness` of the bottom and the top, along y only. Bodies 0 and 1.
TestBoundary grips(const Packing& packing, double thickness);

const TestRoom& direct_tension_room();

}  // namespace phy::lab
