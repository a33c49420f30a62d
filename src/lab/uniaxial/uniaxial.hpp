// Uniaxial compression between two rigid platens, as a rock laboratory does it.
//
//   prepare   only with test.pre_strain > 0: affine strain with breakage off, damped cycles; if a bond or
//             joint is then at its strength the specimen starts again without the pre-strain
//   load      both platens close at the speed of the test after a short ramp
//
// History: stress is the mean platen force over the initial width, strain the closure over the initial
// height. Numbers: analysis/analyse.hpp. Common phases and stop rule: lab/procedure.hpp.
#pragma once
#include "lab/room.hpp"

namespace phy::lab {

const TestRoom& uniaxial_room();

}  // namespace phy::lab
