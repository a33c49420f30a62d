// Opening under stress: a block of rock with a circular hole, a borehole or a tunnel, under the stress of its
// depth. The hole is in the middle of the block, test.opening_diameter wide.
//
//   far field   bottom and top, rigid walls without friction in balance (docs/decisions/0007), bring up
//               test.vertical_stress, a jacket on the sides test.horizontal_stress. Sides bend, so that
//               layered rock may shear: between four rigid walls it would be under a shear stress. The wall
//               of the hole carries the traction that the rock in its place would exert, sigma n, so that the
//               block is stressed as if there were no hole.
//   excavation  that traction is taken away in proportion, down to test.internal_pressure (relaxation, as in
//               two-dimensional calculations of tunnels; Panet & Guenot 1982, Tunnelling '82). Here the
//               history begins.
//   standing    until the forces on the grains balance: closure, hoop stress and breakout of this moment
//   raising     top and bottom approach at test.platen_speed, the sides keep the ratio of the far-field
//               stresses, until the opening collapses. The internal pressure stays.
//
// The stress that the opening bears is the vertical far-field stress, times the share of the traction taken
// away while it is excavated. Its largest value is the collapse stress; over test.vertical_stress it is the
// factor by which the stress may rise, or below one the share of the excavation at which the opening closes.
// Stop rule: lab/procedure.hpp, and a closure of a twentieth of the radius. Where nothing can break the test
// ends when the opening stands.
//
// Closure: area that the wall has swept since the excavation began, over the perimeter and the radius.
// Numbers: reading.hpp.
#pragma once
#include "lab/room.hpp"

namespace phy::lab {

/// Bottom and top (bodies 0 and 1), and jackets on the sides and in the hole.
TestBoundary block_with_hole(const Packing& packing, double diameter);

/// Of the recipe's opening [m].
double opening_diameter(const Recipe& recipe);

const TestRoom& opening_room();

}  // namespace phy::lab
