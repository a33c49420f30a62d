// Transversely isotropic elasticity from E and nu of specimens at several inclinations.
//
// A plane shows four constants: of the fifth, Poisson's ratio nu in the planes of isotropy, no test in the
// plane speaks. It is given, or that of isotropic rock between planes, nu = nu' E/E' (Goodman's continuum,
// theory/transverse_isotropy.hpp), which is an assumption and is stated as one.
//
// Reading of the plane. Plane stress: E and nu of the model are those of a cylinder. Plane strain: they are
// those of a body that cannot stretch along the strike, and its constants follow from them with nu:
//   S_xx = (1 - nu^2)/E,  S_xy = -(1 + nu) nu'/E',  S_yy = (1 - nu'^2 E/E')/E',  S_ss = 1/G'
#pragma once
#include <vector>

#include "design/fit.hpp"
#include "theory/transverse_isotropy.hpp"

namespace phy::design {

/// E [Pa] and nu of one specimen.
struct ElasticPoint {
  double theta = 0.0;  ///< [deg]
  double E = 0.0, nu = 0.0;
};

struct ElasticReadingOf2D {
  theory::PlaneState state = theory::PlaneState::stress;
  double nu = nan;  ///< in the planes of isotropy; NaN: of isotropic rock between the planes
};

/// E, E', nu, nu', G'. Needs three inclinations, one of them oblique.
Fit fit_elasticity(const std::vector<ElasticPoint>& points, const ElasticReadingOf2D& reading = {});

/// The constants of a fit, or of the mean of many.
theory::TransverseIsotropy body_of(const Fit& fit);

}  // namespace phy::design
