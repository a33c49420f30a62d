// Everything a contact law may know.
//
// A law is a pure function of numbers: parameters, state, motion -> reaction. It never sees another law, the
// contact list, the clock or a file. It is written once over the number type R (double, or a pack whose lanes
// are specimens) with select() instead of branches, so that the reference, the fast engine and the contact
// bench run the same source.
//
// Frame and signs (docs/conventions.md). The contact joins grain 1 to grain 2; n points from 1 to 2, t = n
// turned anticlockwise by 90 degrees; the motion is that of grain 2 relative to grain 1 at the contact point.
// Compression and closure are positive:
//   force on grain 2 = F_n n + F_s t,   couple on grain 2 = M,   grain 1 gets the opposite.
// The engine turns velocities into these scalars (with rolling: slide = t.(v2 - v1) - (w1 a1 + w2 a2),
// physics: Cundall & Strack 1979), so a law needs no vectors, and a rigid rotation of the pair gives no
// motion.
#pragma once
#include <span>

#include "base/pack.hpp"
#include "laws/tangent.hpp"

namespace phy::laws {

template <class R>
struct Motion {
  R closure;            ///< approach since the law's reference state, positive = closer [m]
  R d_closure;          ///< its increment in this step [m]
  R d_slide;            ///< increment of the shear displacement of grain 2 along t [m]
  R rotation;           ///< rotation of grain 2 relative to grain 1 since the reference state [rad]
  R d_rotation = R(0);  ///< its increment in this step [rad]; asked for where a moment works while it drops
};

template <class R>
struct Reaction {
  R F_n;         ///< normal force, compression positive [N/m]
  R F_s;         ///< shear force on grain 2 along t [N/m]
  R M;           ///< couple on grain 2 [N]
  R dissipated;  ///< work lost to slip in this step [J/m]
  R released;    ///< strain energy lost by breakage in this step; only set where a mask below is true [J/m]
  MaskOf<R> broke_tension;
  MaskOf<R> broke_shear;
};

template <class R>
MaskOf<R> broke(const Reaction<R>& r) {
  return r.broke_tension | r.broke_shear;
}
inline bool broke(const Reaction<double>& r) { return r.broke_tension || r.broke_shear; }
inline bool broke(const Reaction<float>& r) { return r.broke_tension || r.broke_shear; }

/// Description of one parameter of a law: the source of the contact bench, the manual and the conformance
/// tests.
struct ParameterInfo {
  const char* name;
  const char* unit;
  double min, max, typical;
  const char* pfc_name;
  const char* meaning;
  bool whole = false;  ///< a whole number
};

}  // namespace phy::laws
