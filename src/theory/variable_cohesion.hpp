// Strength constants that vary smoothly with the inclination of the bedding.
//
//   x(theta) = A - B [ cos 2 (theta_min - theta) ]^n          x: unconfined strength, cohesion or
//   tan(friction)
//
// n = 1, one A and B:                       Donath's curve, Jaeger's variable cohesion
// n = 1..6, A and B different on both sides of theta_min, cohesion *and* tan(friction) varying:  McLamore &
// Gray
//
// With beta = 90 - theta (angle between load and plane) the same A, B and n hold, because the cosine is even.
// Peak strength follows from Coulomb's law with the constants of that inclination (jaeger.hpp:
// coulomb_sigma_1). Sources: F.A. Donath, "Experimental study of shear failure in anisotropic rocks", Geol.
// Soc. Am. Bull. 72 (1961) 985-990; J.C. Jaeger (1960) and R. McLamore & K.E. Gray, "The mechanical behavior
// of anisotropic sedimentary rocks", J. Eng. Ind. 89 (1967) 62-73, both as reported by Brady & Brown, "Rock
// Mechanics for Underground Mining" (text after Eq. 4.31). The originals could not be opened; the exponents
// usually quoted are 1 or 3 (cleavage), 5 or 6 (bedding). Limits: fits, not mechanics. The branches agree at
// theta_min only if A - B is the same on both sides; more than 45 degrees from theta_min an even n turns the
// curve down again. docs/theory/strength.md
#pragma once
#include "theory/jaeger.hpp"

namespace phy::theory {

/// One branch: x = A - B cos^n.
struct CosineBranch {
  double A = 0.0;  ///< value 45 degrees away from the minimum [unit of x]
  double B = 0.0;  ///< depth of the minimum [unit of x], >= 0 and <= A
};

/// x(theta) with a branch on either side of the minimum; theta is folded to [0, 90] first.
struct OrientationLaw {
  CosineBranch below;      ///< theta <= theta_min (planes more across the load)
  CosineBranch above;      ///< theta > theta_min (planes more along the load)
  double theta_min = 0.0;  ///< [deg], 0..90
  int n = 1;               ///< exponent, >= 1
  double at(double theta) const;
};

/// One branch on both sides, n = 1: Donath's curve A - B cos 2(theta_min - theta).
OrientationLaw donath_law(double A, double B, double theta_min);

/// Peak sigma_1 [Pa] of Jaeger's variable cohesion: c(theta) [Pa] from the law, constant friction angle
/// [deg].
double variable_cohesion_sigma_1(const OrientationLaw& cohesion, double friction, double theta,
                                 double sigma_3);

/// McLamore & Gray: cohesion [Pa] and tan(friction) [-] each follow a law of their own.
struct McLamoreGray {
  OrientationLaw cohesion;
  OrientationLaw tan_friction;
};

/// Peak sigma_1 [Pa].
double mclamore_gray_sigma_1(const McLamoreGray& rock, double theta, double sigma_3);

}  // namespace phy::theory
