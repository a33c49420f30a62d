// Mean stress in a circle, from contact forces: what a measurement circle of PFC reads.
//
//   sigma_ij = 1/(pi a^2) sum_c s_c F_i l_j
//
// F: force of a contact on its second grain, l: branch vector from the first to the second centre, s_c: share
// of the branch inside the circle of radius a. Love-Weber; couples of bonds do not enter the mean of the
// symmetric part. Compression positive.
#pragma once
#include <vector>

#include "records/result.hpp"

namespace phy::analysis {

/// Stress [Pa]; xy is the mean of both shear components.
struct PlaneStress {
  double xx = 0.0, yy = 0.0, xy = 0.0;
};

/// Mean stress of a snapshot in the circle (centre, radius [m]) of the deformed packing.
PlaneStress stress_in_circle(const Packing& packing, const Snapshot& snapshot, Vec2 centre, double radius);

}  // namespace phy::analysis
