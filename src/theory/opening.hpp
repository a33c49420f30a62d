// Stress around a circular opening (borehole, drift, tunnel) in an infinite elastic body: isotropic, and of
// any anisotropy in the plane.
//
// The hole has radius R; far away the stress is uniform, and a uniform pressure p acts on the wall.
// Compression is positive, also far away: the tensor is minus that of a book in which tension is positive.
// Angles a are from +x, anticlockwise.
//
// Isotropic, with m = (xx + yy)/2, d = ((xx - yy)/2) cos 2a + xy sin 2a, e = (R/r)^2:
//
//   radial = m (1 - e) + d (1 - 4 e + 3 e^2) + p e
//   hoop   = m (1 + e) - d (1 + 3 e^2) - p e
//   shear  = (xy cos 2a - ((xx - yy)/2) sin 2a) (1 + 2 e - 3 e^2)
//
// G. Kirsch, "Die Theorie der Elastizitaet und die Beduerfnisse der Festigkeitslehre", Z. VDI 42 (1898)
// 797-807, as in textbooks (Timoshenko & Goodier, "Theory of Elasticity").
//
// Anisotropic (S.G. Lekhnitskii, "Anisotropic Plates", Gordon & Breach, 1968; for rock B. Amadei, "Rock
// Anisotropy and the Theory of Stress Measurements", Springer, 1983): stresses follow from two functions of
// z_k = x + mu_k y (theory/anisotropic_roots.hpp), in tension positive
//
//   sigma_x = 2 Re sum mu_k^2 phi_k',   sigma_y = 2 Re sum phi_k',   tau = -2 Re sum mu_k phi_k'
//   u_x = 2 Re sum (S_xx mu_k^2 + S_xy - S_xs mu_k) phi_k,   u_y = 2 Re sum (S_xy mu_k + S_yy/mu_k - S_ys)
//   phi_k
//
// The exterior map z_k = R ((1 - i mu_k) w_k + (1 + i mu_k)/w_k)/2 takes the wall to the unit circle. What
// the hole adds to the uniform stress is phi_k = A_k/w_k: the wall needs one harmonic alone, which gives two
// equations for A_1 and A_2. The derivation of A_k is our own. A body with equal roots (isotropic, for one)
// is answered to 1e-8 of the stress. Left out: an axis out of the plane that couples with it, and all that
// breaks.
#pragma once
#include <array>
#include <complex>

#include "theory/transverse_isotropy.hpp"

namespace phy::theory {

/// Stress in the plane [Pa], compression positive.
struct StressInPlane {
  double x = 0.0, y = 0.0, xy = 0.0;
};

/// The same in the axes of a polar angle [Pa].
struct PolarStress {
  double radial = 0.0, hoop = 0.0, shear = 0.0;
};

/// The stress seen along and across the direction `angle` [deg from +x].
PolarStress polar(const StressInPlane& stress, double angle);

/// Hole, stress far away and pressure on its wall.
struct Opening {
  double radius = 0.0;    ///< R [m], > 0
  StressInPlane far;      ///< [Pa]
  double pressure = 0.0;  ///< p on the wall [Pa]
};

/// When the stress far away came: it decides from where the wall has moved.
enum class Loaded {
  with_hole,   ///< the body was loaded with the hole in it
  before_hole  ///< the body was loaded, then cut; the pressure came last
};

/// Isotropic body, at a place from the centre of the hole [m], not inside it.
StressInPlane kirsch(const Opening& opening, double x, double y);

/// How far the wall has moved towards the centre [m] at an angle [deg]. `seen`: the constants of a test in
/// the plane (theory/transverse_isotropy.hpp, `seen_in_plane_strain` for a long drift).
double kirsch_closure(const Opening& opening, const PlaneConstants& seen, double angle, Loaded when);

/// The same questions of a body with the compliances S in the axes x and y.
class AnisotropicOpening {
 public:
  AnisotropicOpening(const PlaneCompliance& S, const Opening& opening);

  /// At a place from the centre of the hole [m], not inside it.
  StressInPlane at(double x, double y) const;

  /// How far the wall has moved towards the centre [m] at an angle [deg].
  double closure(double angle, Loaded when) const;

 private:
  using Complex = std::complex<double>;
  PlaneCompliance S_;
  Opening opening_;
  std::array<Complex, 2> mu_, A_;
};

}  // namespace phy::theory
