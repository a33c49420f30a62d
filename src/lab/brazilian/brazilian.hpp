// Brazilian test: a disc pressed along a diameter until it splits.
//
// The disc is cut from the middle of the recipe's packing (genesis/cut.hpp) and loaded along y; bedding at
// theta = 0 lies across the loading diameter. With test.loading_angle = 0 two flat rigid platens touch the
// rim where it stands out most; a few grains carry the load, and the rim may crush before the centre splits.
// With an angle (usual: 10 degrees) two rigid jaws hold that arc of the rim: every grain that a ray from
// outside meets first has a contact along its radius, stress-free at the start, as a jaw bedded on the rough
// rim. Platens and jaws approach at the speed of the test each. Stop rule: lab/procedure.hpp.
//
// Jaws hold the disc by friction, test.jaw_friction. Without it nothing but inertia does: a jaw holds a few
// grains whose radii do not add up to the load line, and oblique bedding pushes sideways. A coarse disc then
// rolls or slides out while it is loaded, the later the faster the platens, and its strength depends on their
// speed and on the damping (docs/decisions/0012-jaw-friction.md has the numbers).
//
// History: stress is the tension at the centre of an elastic isotropic disc under the platen force,
// 2P/(pi D t) times Hondros' factor for the arc; strain is the approach of the platens over the diameter.
// Numbers: reading.hpp.
#pragma once
#include "lab/room.hpp"

namespace phy::lab {

/// Diameter of the disc that the recipe's Brazilian test cuts [m]: test.disc_diameter, or the smaller side of
/// the specimen where that is 0.
double disc_diameter(const Recipe& recipe);

/// Bottom and top of a Brazilian test on a disc in the middle of the box: flat platens against the outermost
/// grains, or jaws that hold an arc of `angle` [deg] of the rim. Bodies 0 and 1. Axial stress: tension at the
/// centre (reading.hpp); axial strain: approach over `diameter` [m].
TestBoundary jaws(const Packing& packing, double diameter, double angle);

const TestRoom& brazilian_room();

}  // namespace phy::lab
