// Stress intensity at the end of a notch, from the movements of the grains around it.
//
// Around the end of a straight crack with free flanks in a homogeneous body of any plane anisotropy,
//
//   u = u_0 + sum_n sum_k 2 Re( (p_k, q_k) c_kn z_k^(n/2) ),   z_k = x_1 + mu_k x_2,   n = 1, 2, ...
//   S_11 mu^4 - 2 S_16 mu^3 + (2 S_12 + S_66) mu^2 - 2 S_26 mu + S_22 = 0            roots with Im mu > 0
//   p = S_11 mu^2 + S_12 - S_16 mu,   q = S_12 mu + S_22/mu - S_26
//
// in axes 1 ahead of the crack and 2 across it (Sih, Paris & Irwin 1965, Int. J. Fract. Mech. 1:189-203). The
// flanks are free when sum c_k and sum mu_k c_k are real for odd n and imaginary for even n: two numbers per
// n. The first two are K_I = sqrt(2 pi) sum c_k1 and K_II = -sqrt(2 pi) sum mu_k c_k1. All are found by least
// squares from the movements in a ring around the end (the over-deterministic method; for anisotropic planes
// Ayatollahi, Nejati & Ghouli 2020, Eng. Fract. Mech. 231:106982). A grain assembly is no continuum and the
// end of its notch no point: the ring leaves out the grains next to it.
//
// S is that of the assembly itself: the rock beside the notch is driven by three uniform gradients, and mean
// stress and mean gradient are read in windows. Bedded rock is so taken as homogeneous; that holds where the
// ring spans several planes. Contacts also pull in this solution (as `bilateral` in uniaxial.hpp): K of a
// body that is softer in tension than in compression has no such field. docs/theory/semi-circular-bend.md
#pragma once
#include <array>
#include <span>

#include "statics/system.hpp"

namespace phy::statics {

/// A rectangle in which mean stress and strain are read.
struct Window {
  Vec2 lo, hi;
};

/// strain (11, 22, 2 12) = S stress (11, 22, 12) [1/Pa].
using Compliance = std::array<std::array<double, 3>, 3>;

struct EffectiveCompliance {
  ElasticOutcome outcome;
  Compliance S{};
};

/// Compliance of what lies in the windows, in axes 1 = `axis` (unit vector) and 2 = to the left of it. All
/// grains more than `margin` [m] outside the windows are moved with uniform gradients.
EffectiveCompliance effective_compliance(const Network& network, std::span<const Window> windows,
                                         double margin, Vec2 axis);

/// The end of a crack, and the ring around it that is read.
struct CrackTip {
  Vec2 end;
  Vec2 ahead;                            ///< unit vector
  double nearest = 0.0, farthest = 0.0;  ///< of the ring [m]
};

struct StressIntensity {
  double K_I = 0.0, K_II = 0.0;  ///< [Pa sqrt(m)]; K_II > 0: the flank to the left slides ahead of the other
  double residual = 0.0;         ///< root mean square of what is not fitted, over that of the movements [1]
};

/// K of the movements (signs: network.hpp) in a body of that compliance, in the axes of the crack.
StressIntensity stress_intensity(const Network& network, const Movements& u, const CrackTip& tip,
                                 const Compliance& compliance);

}  // namespace phy::statics
