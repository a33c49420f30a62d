// The angle of the bedding, and how other people write it.
//
// Here (and everywhere in this project) theta is the inclination of the *plane*, counter-clockwise from +x,
// with the load along y. theta = 0: the planes lie across the load (load normal to the bedding); theta = 90:
// the planes lie along the load. theta is also the angle between the load and the normal of the plane. Most
// strength papers use beta, the angle between the load and the plane: beta = 90 - theta. All angles are in
// degrees.
#pragma once
#include <cmath>

namespace phy::theory {

/// Angle between load axis and plane [deg] from the inclination theta [deg]; its own inverse.
inline double beta_from_theta(double theta) { return 90.0 - theta; }

/// The inclination in [0, 90] that an axial test cannot tell from `theta` [deg]: its period is 180, and
/// theta and 180 - theta are equal, because a mirror about the load axis changes neither modulus nor
/// strength.
inline double folded_theta(double theta) {
  const double turn = theta - 180.0 * std::floor(theta / 180.0);
  return turn <= 90.0 ? turn : 180.0 - turn;
}

}  // namespace phy::theory
