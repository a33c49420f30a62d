// Deformability of rock cut by one set of parallel, evenly spaced joints (or bedding planes).
//
//   1/E(theta)  = 1/E + cos^2(theta) ( cos^2(theta) / (K_n delta) + sin^2(theta) / (K_s delta) )
//   nu(theta)   = E(theta) ( nu/E + sin^2(theta) cos^2(theta) ( 1/(K_s delta) - 1/(K_n delta) ) )
//
// theta: inclination of the planes, load along y (theory/angles.hpp). Derivation: an axial stress s puts s
// cos^2(theta) across and s sin(theta) cos(theta) along the plane; the joint closes and slips in proportion;
// both movements, resolved on the load axis and divided by the spacing delta, add to the strain of the intact
// rock.
//
// Source: the equivalent continuum of Duncan & Goodman (1968) and R.E. Goodman, "Methods of Geological
// Engineering in Discontinuous Rocks", West, 1976; E(theta) is called "Eq. 1" in this project. Left out:
// thickness of the planes, opening, slip and dilation (all strains elastic), a second set. Valid while the
// specimen holds several planes.
//
// K_n and K_s never appear without delta, so the products [Pa] are the parameters. docs/theory/goodman.md
#pragma once

namespace phy::theory {

/// Isotropic rock with one joint set. Infinite K_n_delta or K_s_delta: the planes do not yield in that
/// direction.
struct JointedRock {
  double E = 0.0;          ///< Young's modulus of the intact rock [Pa], > 0
  double K_n_delta = 0.0;  ///< macro normal stiffness times spacing [Pa], not 0
  double K_s_delta = 0.0;  ///< macro shear stiffness times spacing [Pa], not 0
  double nu = 0.0;         ///< Poisson's ratio of the intact rock [-]; only goodman_nu uses it
};

/// Young's modulus [Pa] seen by a load along y. goodman_E(rock, 90) is rock.E exactly.
double goodman_E(const JointedRock& rock, double theta);

/// Apparent Poisson's ratio [-]: lateral expansion in the plane that holds load and joint normal, per axial
/// shortening.
double goodman_nu(const JointedRock& rock, double theta);

/// The two courses that E(theta) can take.
enum class CurveType {
  incremental,  ///< E grows from theta = 0 to 90: K_n <= 2 K_s
  shoulder      ///< E falls to a minimum at theta_star, then grows: K_n > 2 K_s
};

struct CurveShape {
  CurveType type = CurveType::incremental;
  double theta_star = 0.0;  ///< where E is smallest [deg]: cos^2 = K_n / (2 (K_n - K_s)); 0 if incremental
  double E_min = 0.0;       ///< E(theta_star) [Pa]
  double E_0 = 0.0;         ///< E(0) [Pa] = 1 / (1/E + 1/(K_n delta))
  double E_90 = 0.0;        ///< E(90) [Pa] = E
};

/// Type, minimum and ends of the curve; needs K_n_delta > 0 and K_s_delta > 0.
CurveShape goodman_shape(const JointedRock& rock);

}  // namespace phy::theory
