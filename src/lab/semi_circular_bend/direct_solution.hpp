// K_I and K_II of the notched half disc from the elastic solution without time steps: beside the apparent
// K_Ic, which takes the specimen for isotropic.
//
// The same grains and bonds as in the test, loaded on the lines of the rollers: half of P on each support, P
// on top, each shared by the grains of the roller next to its line on either side, so that forces and moments
// balance and the one grain that is held, for a solution without rigid movement, carries nothing. Where there
// is a grain on one side only it takes all, at most two of the largest radii off the line, and the held grain
// the moment of that. Linear: contacts also pull (statics/crack_tip.hpp).
//
// K belongs to a homogeneous body. Bedded rock is one only where the ring around the notch that is read spans
// many planes: with 9 of them K_I of planes across the notch is 2 % off that of finite elements, with 5 some
// 8 %, with 2 some 20 %, all too high; of inclined planes more (docs/theory/semi-circular-bend.md). With
// fewer than `least_planes` there is no answer.
#pragma once
#include "engine/boundary.hpp"
#include "lab/semi_circular_bend/reading.hpp"
#include "records/elastic.hpp"
#include "records/specimen.hpp"

namespace phy::lab {

constexpr double least_planes = 4.0;  ///< spacings of the bedding within the width of the ring

struct DirectIntensity {
  std::string missing;           ///< why there is no answer; empty: there is one
  double K_I = 0.0, K_II = 0.0;  ///< over the nominal stress P/(2 R B) [sqrt(m)]
};

/// `bend`: as sawn; `rollers`: support rollers and loading roller of this specimen (bend_rollers).
DirectIntensity direct_intensity(const Specimen& specimen, const BendSpecimen& bend,
                                 const engine::Boundary& rollers);

/// K_I and K_II at the largest nominal stress `peak` [Pa]; NaN: there was none.
std::vector<Number> direct_numbers(const DirectIntensity& direct, double peak);

}  // namespace phy::lab
