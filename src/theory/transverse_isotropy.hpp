// Transversely isotropic elasticity: rock whose bedding planes are planes of isotropy.
//
// In the axes of the bedding (1 along, 2 = normal, 3 along and out of the paper), shortening positive:
//
//   eps_11 = sigma_11 / E - (nu'/E') sigma_22 - (nu/E) sigma_33
//   eps_22 = -(nu'/E') (sigma_11 + sigma_33) + sigma_22 / E'
//   gamma_12 = sigma_12 / G'
//
//   1/E(theta) = cos^4/E' + sin^4/E + sin^2 cos^2 ( 1/G' - 2 nu'/E' )
//   nu(theta)/E(theta) = (nu'/E') (cos^4 + sin^4) - sin^2 cos^2 ( 1/E + 1/E' - 1/G' )
//
// theta: inclination of the planes, load along y (theory/angles.hpp). Sources: B. Amadei, "Importance of
// anisotropy when estimating and measuring in situ stresses in rock", IJRMMS 33 (1996) 293-325, for the
// constants and the notation; S.G. Lekhnitskii, "Theory of Elasticity of an Anisotropic Elastic Body",
// Holden-Day, 1963, for the rotation. The formulas are re-derived in transverse_isotropy.test.cpp by rotating
// the compliance matrix. docs/theory/transverse-isotropy.md
#pragma once
#include "theory/goodman.hpp"

namespace phy::theory {

/// The five constants. Primes of the literature are written `_n`: "normal to the planes".
struct TransverseIsotropy {
  double E = 0.0;     ///< Young's modulus along the planes [Pa], > 0
  double E_n = 0.0;   ///< E', Young's modulus normal to the planes [Pa], > 0
  double nu = 0.0;    ///< lateral strain in the plane under load in the plane [-], -1 < nu < 1
  double nu_n = 0.0;  ///< nu', lateral strain in the plane under load normal to it [-]
  double G_n = 0.0;   ///< G', shear modulus of planes normal to the bedding [Pa], > 0
};

/// True when no strain has negative energy: E, E', G' > 0, |nu| < 1 and 1 - nu - 2 nu'^2 E/E' > 0.
bool is_admissible(const TransverseIsotropy& m);

/// Young's modulus [Pa] under a load along y (uniaxial, plane stress).
double ti_E(const TransverseIsotropy& m, double theta);

/// Apparent Poisson's ratio [-] in the plane that holds load and bedding normal (uniaxial, plane stress).
double ti_nu(const TransverseIsotropy& m, double theta);

/// Saint-Venant's empirical relation 1/G' = 1/E + 1/E' + 2 nu'/E' [Pa].
double saint_venant_G(double E, double E_n, double nu_n);

/// What E(theta) becomes with that relation: 1/E(theta) = cos^2/E' + sin^2/E [Pa]; always monotone.
double saint_venant_E(double E, double E_n, double theta);

/// The constants from uniaxial tests at 0, 45 and 90 degrees: E' = E_0, E = E_90, nu' = lateral/axial strain
/// at 0 and 1/G' = 4/E_45 - 1/E - 1/E' + 2 nu'/E'. `nu` (both strains in the plane) needs the 90 degree
/// test's third axis. G_n comes out negative or infinite when the three moduli belong to no elastic rock: ask
/// is_admissible.
TransverseIsotropy ti_from_three_tests(double E_0, double E_45, double E_90, double nu_0, double nu);

/// Jointed rock as a continuum: 1/E' = 1/E + 1/(K_n delta), 1/G' = 2(1+nu)/E + 1/(K_s delta), nu'/E' = nu/E.
/// It obeys Saint-Venant's relation exactly when K_n = K_s.
TransverseIsotropy ti_from_goodman(const JointedRock& rock);

/// The jointed rock that has the same E(theta) and nu_0 as `m` at every angle:
/// 1/(K_n delta) = 1/E' - 1/E and 1/(K_s delta) = 1/G' - 2 nu'/E' - 2/E. There always is one, because Eq. 1
/// with free E, K_n, K_s is the general orthotropic law in two dimensions; a negative stiffness says that the
/// continuum is no jointed rock.
JointedRock goodman_from_ti(const TransverseIsotropy& m);

/// Compliance in the plane, axes x and y (load): eps_xx = S_xx sigma_xx + S_xy sigma_yy + S_xs tau and so on
/// [1/Pa]. `s` is the engineering shear gamma_xy.
struct PlaneCompliance {
  double S_xx = 0.0, S_yy = 0.0, S_xy = 0.0;
  double S_xs = 0.0, S_ys = 0.0, S_ss = 0.0;
};

/// What is held fixed across the paper.
enum class PlaneState {
  stress,  ///< sigma_33 = 0: a thin plate
  strain   ///< eps_33 = 0: a long body whose bedding strikes along axis 3
};

/// Compliance in the axes of the bedding (x along, y normal).
PlaneCompliance plane_compliance(const TransverseIsotropy& m, PlaneState state);

/// The same body turned counter-clockwise by `theta` degrees, seen from fixed axes; S' = Q^T S Q with the
/// matrix Q that takes fixed-axes stresses to body-axes stresses.
PlaneCompliance rotated(const PlaneCompliance& S, double theta);

/// What a uniaxial test in the plane shows [Pa, -].
struct PlaneConstants {
  double E = 0.0;
  double nu = 0.0;
};

/// E(theta) and nu(theta) of a body without S_xs and S_ys in the axes of its bedding, linear in its
/// compliances:
///   1/E(theta)         = S_yy cos^4 + S_xx sin^4 + (S_ss + 2 S_xy) sin^2 cos^2
///   nu(theta)/E(theta) = -S_xy (cos^4 + sin^4) - (S_xx + S_yy - S_ss) sin^2 cos^2
/// Hence nu(0)/E(0) = nu(90)/E(90) = -S_xy, and (1 - nu)/E = (S_yy + S_xy) cos^2 + (S_xx + S_xy) sin^2: what
/// two tests at 0 and 90 degrees say of nu at every other angle, given E there.
PlaneConstants seen_at(const PlaneCompliance& S, double theta);

/// What an isotropic body (E, nu) shows in a two-dimensional test under plane strain: E/(1-nu^2), nu/(1-nu).
PlaneConstants seen_in_plane_strain(const PlaneConstants& body);

/// The body whose plane-strain test shows (E_2D, nu_2D): nu = nu_2D/(1+nu_2D), E = E_2D (1-nu^2).
/// Joint terms of Eq. 1 are the same in both readings; only 1/E changes.
PlaneConstants body_from_plane_strain(const PlaneConstants& seen);

}  // namespace phy::theory
