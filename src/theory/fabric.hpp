// Strength of rock whose cohesion changes smoothly with the direction of its load: a fabric tensor in place
// of a plane of weakness.
//
//   sigma_1 = N sigma_3 + 2 c sqrt(N),   N = (1 + sin phi)/(1 - sin phi)
//   c = c_0 (1 + Omega x + Omega_2 x^2),   x = 1 - 3 l^2
//   l^2 = (sigma_1^2 cos^2 theta + sigma_3^2 sin^2 theta) / (sigma_1^2 + 2 sigma_3^2)
//
// l: the part of the generalised loading vector that lies along the normal of the bedding, in triaxial
// compression; without confinement l = cos theta. Omega: eigenvalue of the deviatoric, axisymmetric fabric
// tensor along the bedding; across it the eigenvalue is -2 Omega. Source: S. Pietruszczak & Z. Mroz, "On
// failure criteria for anisotropic cohesive-frictional materials", Int. J. Numer. Anal. Meth. Geomech. 25
// (2001) 509-524 (as cited elsewhere; the text could not be opened); with the square, x times Omega is the
// first term of their series. Left out: a friction that changes with direction, tension. docs/design.md
#pragma once

namespace phy::theory {

struct Fabric {
  double cohesion = 0.0;  ///< c_0 [Pa], of a load whose x is 0
  double friction = 0.0;  ///< [deg]
  double omega = 0.0;     ///< Omega [-]
  double omega_2 = 0.0;   ///< Omega_2 [-]
};

/// x of a load [-], from -2 across the bedding to 1 along it.
double fabric_load(double theta, double sigma_1, double sigma_3);

/// Peak sigma_1 [Pa] at which the load and the cohesion of its own direction agree; NaN: they do not settle.
double fabric_sigma_1(const Fabric& rock, double theta, double sigma_3);

}  // namespace phy::theory
