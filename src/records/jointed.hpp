// What the closed forms of jointed rock take for granted: planes with joints, and between them rock that is
// the same in all directions.
#pragma once
#include "records/recipe.hpp"

namespace phy {

/// The first set of bedding has joints, and the matrix no directions: Eq. 1 (Goodman's continuum) can be
/// fitted.
inline bool jointed_isotropic(const Recipe& r) {
  return !r.bedding.empty() && !r.bedding.front().unjointed() && !r.matrix.directional();
}
/// And the joints lie on planes, one of which can be the plane of weakness of Jaeger's theory.
inline bool has_weak_planes(const Recipe& r) {
  return jointed_isotropic(r) && r.bedding.front().has_planes();
}
/// Why there is no such fit, where one of these is false.
inline const char* no_weak_planes(const Recipe& r) {
  return r.matrix.directional()          ? "the matrix has directions, the theory takes it for isotropic"
         : r.bedding.empty()             ? "no bedding"
         : r.bedding.front().unjointed() ? "the layers have no joints"
                                         : "the joints lie on no planes";
}

}  // namespace phy
