// Direct shear along a horizontal plane half-way up, as in a shear box.
//
//   prepare   the upper box presses down with test.normal_stress, as slowly as it shears later
//   load      displacements count from here; the boxes slide past each other, each at test.platen_speed, to a
//             shear displacement of test.max_strain times the width
//
// The boxes hold all grains but those within test.shear_gap / 2 of the plane, in both directions and against
// turning, like rock cast into grout; with a gap of 0 two rigid halves meet on the plane. The upper box
// carries the normal load: constant (test.normal_stiffness = 0), or growing with dilation,
//   sigma = normal_stress + normal_stiffness * dilation
// Bedding at theta = 0 with a plane through the centre is sheared along a plane; other angles shear across.
//
// History: shear stress and normal stress are the forces of the boxes over the initial width; shear
// displacement and normal closure (dilation negative) are those of the boxes [m]. The test always runs to its
// end, for the residual stress. Numbers: reading.hpp.
#pragma once
#include "lab/room.hpp"

namespace phy::lab {

/// Two boxes (bodies 0 lower, 1 upper) that hold all grains farther than gap / 2 [m] from half the height.
/// Axial: sliding along x, lateral: closing along y, both as displacements [m]; stresses over the width.
TestBoundary shear_boxes(const Packing& packing, double gap);

const TestRoom& direct_shear_room();

}  // namespace phy::lab
