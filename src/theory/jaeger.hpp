// Strength of rock with a plane of weakness: Coulomb slip on the plane, capped by the strength of the matrix.
//
//   sigma_1 = sigma_3 + 2 (c_w + sigma_3 tan phi_w) / ( (1 - tan phi_w cot theta) sin 2 theta ),   phi_w <
//   theta < 90 smallest at theta = 45 + phi_w/2:  sigma_3 + 2 (c_w + sigma_3 mu) ( sqrt(1 + mu^2) + mu ), mu
//   = tan phi_w
//
// theta: inclination of the plane = angle between load and its normal (theory/angles.hpp); compression
// positive. Source: J.C. Jaeger, "Shear failure of anisotropic rocks", Geol. Mag. 97 (1960) 65-72; read in
// B.H.G. Brady & E.T. Brown, "Rock Mechanics for Underground Mining", section on anisotropic rock in triaxial
// compression, Eq. 4.31 and the two lines below it. Left out: tensile opening of the plane, failure partly
// through plane and matrix, and the slow variation of real strength near theta = 0 and 90.
// docs/theory/strength.md
#pragma once

namespace phy::theory {

/// Coulomb shear strength tau = cohesion + sigma tan(friction).
struct Coulomb {
  double cohesion = 0.0;  ///< [Pa], >= 0
  double friction = 0.0;  ///< friction angle [deg], 0 <= friction < 90
};

/// Peak sigma_1 [Pa] of isotropic Coulomb rock: sigma_3 + 2 (c + sigma_3 mu)(sqrt(1 + mu^2) + mu).
double coulomb_sigma_1(const Coulomb& rock, double sigma_3);

/// sigma_1 [Pa] at which the plane slips, +infinity where it cannot (theta folded to [0, 90] is <= phi_w or
/// is 90).
double weak_plane_sigma_1(const Coulomb& plane, double theta, double sigma_3);

/// Peak sigma_1 [Pa]: slip on the plane or failure of the matrix, whichever comes first. `matrix_sigma_1` is
/// the strength of the matrix at the same sigma_3, from any criterion.
double jaeger_sigma_1(const Coulomb& plane, double matrix_sigma_1, double theta, double sigma_3);

struct StrengthMinimum {
  double theta = 0.0;    ///< [deg]
  double sigma_1 = 0.0;  ///< [Pa]
};

/// Weakest inclination and its strength, without the cap of the matrix.
StrengthMinimum weak_plane_minimum(const Coulomb& plane, double sigma_3);

/// Inclinations between which the plane decides; `any` is false when the matrix fails first at every angle.
struct SlipRange {
  bool any = false;
  double from = 0.0;  ///< [deg]
  double to = 0.0;    ///< [deg]
};

/// Where weak_plane_sigma_1 <= matrix_sigma_1: sin(2 theta - phi) >= sin phi + 2 (c cos phi + sigma_3 sin
/// phi) / (s1 - s3).
SlipRange slip_range(const Coulomb& plane, double matrix_sigma_1, double sigma_3);

}  // namespace phy::theory
