// Stress in an elastic disc of any plane anisotropy that two opposite arcs of its rim press together.
//
// In a homogeneous body with the compliances S the stresses follow from two functions of z_k = x + mu_k y,
//
//   S_xx mu^4 - 2 S_xs mu^3 + (2 S_xy + S_ss) mu^2 - 2 S_ys mu + S_yy = 0          roots with Im mu > 0
//   sigma_x = 2 Re sum mu_k^2 phi_k',   sigma_y = 2 Re sum phi_k',   tau = -2 Re sum mu_k phi_k'
//
// (S.G. Lekhnitskii, "Anisotropic Plates", Gordon & Breach, 1968; for the Brazilian test B. Amadei, IJRMMS 33
// (1996) 293-325, J. Claesson & B. Bohloli, IJRMMS 39 (2002) 991-1004). On the rim of the unit disc
//
//   z_k = c_k (e^iw + t_k e^-iw),   c_k = (1 - i mu_k)/2,   t_k = (1 + i mu_k)/(1 - i mu_k),   |t_k| < 1
//
// so the polynomials P_n(z_k) with P_0 = 2, P_1 = z_k/c_k, P_(n+1) = P_1 P_n - t_k P_(n-1) are
// e^inw + t_k^n e^-inw there. phi_k = sum a_kn P_n, and every harmonic e^inw of the tractions gives two
// complex equations for a_1n and a_2n alone. The first harmonic is a uniform stress. Derived by hand here,
// not copied from the papers; the tests hold it against Hondros' disc and against the tractions on the rim.
// Left out: friction of the jaws, a contact that grows with the load.
#pragma once
#include <array>
#include <complex>
#include <vector>

#include "theory/transverse_isotropy.hpp"

namespace phy::theory {

/// A disc pressed along y by uniform radial pressure on two arcs of its rim.
struct PressedDisc {
  PlaneCompliance S;      ///< in the axes x and y
  double diameter = 0.0;  ///< D [m]
  double alpha = 0.0;     ///< half a loaded arc [deg], 0 < alpha < 90
  double P = 0.0;         ///< force on one arc, per metre of thickness [N/m], compression positive
};

/// Stress [Pa], compression positive.
struct DiscStress {
  double x = 0.0, y = 0.0, xy = 0.0;
};

class AnisotropicDisc {
 public:
  explicit AnisotropicDisc(const PressedDisc& disc);

  /// At a place in the disc, from its centre [m].
  DiscStress at(double x, double y) const;

  /// Mean over a circle of that radius [m] about the centre.
  DiscStress mean(double radius) const;

 private:
  using Complex = std::complex<double>;
  double radius_ = 1.0;
  std::array<Complex, 2> mu_, c_, t_;
  std::array<std::vector<Complex>, 2> a_;  // of the odd harmonics n = 3, 5, ...
  DiscStress uniform_;                     // the first harmonic, tension positive
};

}  // namespace phy::theory
