// Semi-circular bend (SCB): half a disc with a notch, bent over two rollers until a crack runs from the
// notch. Suggested method of the ISRM for the static fracture toughness in mode I (Kuruppu, Obara,
// Ayatollahi, Chong & Funatsu 2014, Rock Mech. Rock Eng. 47:267-274).
//
// The half disc is cut from the middle of the recipe's packing, flat face down, the notch sawn upwards from
// the middle of that face (genesis/cut.hpp): whole grains are taken out, so the flanks touch nowhere and the
// end of the notch is as blunt as a grain. Bedding at theta = 0 lies across the notch and the load, at 90
// along them. Two rollers support the flat face at +-s/2, one loads the top of the arc; loading and support
// rollers approach at the speed of the test each. Stop rule: lab/procedure.hpp.
//
// A roller is a rigid vertical push, without friction unless test.platen_friction is given, on the grains of
// the surface that rays within one largest radius of its line meet first, stress-free at the start as a
// roller bedded on a rough face. Its line does not wander: a real roller rolls along the arc and the face a
// little. Both support rollers are one body: they move together, and their sum is recorded.
//
// History: load P per thickness [N/m] and nominal stress P/(2 R B); load-point displacement, the approach of
// the rollers [m], which contains the seating of the rollers; crack mouth opening [m], between the grains of
// the two flanks one largest radius above the flat face. Numbers: reading.hpp, and K_I, K_II of the direct
// elastic solution under the largest load (statics/crack_tip.hpp).
#pragma once
#include "lab/room.hpp"
#include "lab/semi_circular_bend/reading.hpp"

namespace phy::lab {

/// The half disc of the recipe. Its diameter is test.disc_diameter, or the largest that the packing holds.
BendSpecimen bend_specimen(const Recipe& recipe);

/// The same with the notch as it is: up to the centre of the first grain on its axis. A laboratory measures
/// it, too; elastic K of lattices and packings is that of this length (docs/theory/semi-circular-bend.md).
BendSpecimen as_sawn(const Packing& half, BendSpecimen specimen);

/// Support rollers and loading roller (bodies 0 and 1) of a half disc as genesis::cut_half_disc leaves it.
/// Axial: approach along y as a displacement [m]; stress over the diameter.
TestBoundary bend_rollers(const Packing& half, const BendSpecimen& specimen);

/// The grains of the left and the right flank whose distance is the crack mouth opening; -1: none.
struct NotchMouth {
  std::int64_t left = -1, right = -1;
};
NotchMouth notch_mouth(const Packing& half, const BendSpecimen& specimen);

const TestRoom& semi_circular_bend_room();

}  // namespace phy::lab
