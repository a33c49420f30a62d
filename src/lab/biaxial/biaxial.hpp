// Biaxial compression: a specimen under constant confining stress, shortened along y.
//
//   prepare   platens and sides bring the specimen to test.confining_stress all round, along a ramp as slow
//             as the later loading; done when both stresses are within 0.5 % for ten blocks in a row. Bonds
//             may break.
//   load      strains count from here; platens close at the speed of the test, the sides keep the stress
//
// Sides (test.confinement): "walls", two frictionless rigid walls without mass, each in balance with the
// confining stress in every step (engine/boundary.hpp, docs/decisions/0007), as in a press with side platens;
// "jacket", a pressure on the grains that are the surface of the sides at the time (engine/jacket.hpp,
// docs/decisions/0008), as a rubber jacket: sides may bulge. Without confining stress there are no sides:
// the uniaxial press.
//
// History: axial stress is the mean platen force over the initial width, lateral stress that of the walls
// over the initial height, both of the instant, or the jacket's pressure.
// Numbers: reading.hpp. Stop rule on the deviatoric stress.
#pragma once
#include "lab/room.hpp"

namespace phy::lab {

/// The press with sides: walls (bodies 2 left, 3 right) or a jacket; none without confining stress.
TestBoundary confined_platens(const Packing& packing, const TestRecipe& test);

const TestRoom& biaxial_room();

}  // namespace phy::lab
