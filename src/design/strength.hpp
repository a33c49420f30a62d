// Laws of strength that other codes compute with, each fitted to the peaks of one rock at several
// inclinations and confining stresses. The list `strength_laws` has all of them: fit, and what it predicts.
//
//   ubiquitous joint   the weaker of slip on a plane (c_j, phi_j) and failure of the rock (c, phi): Jaeger
//   Hoek-Brown         sigma_1 = sigma_3 + sigma_ci sqrt(m sigma_3/sigma_ci + 1) at every inclination, with
//                      m = k_beta m_i and m_i that of planes across the load (Saroglou & Tsiambaos 2008)
//   fabric             one friction, and a cohesion that changes smoothly (theory/fabric.hpp)
#pragma once
#include <span>

#include "design/fit.hpp"

namespace phy::design {

/// c_j, phi_j, c, phi. Both branches need tests under two stresses.
Fit fit_ubiquitous_joint(const StrengthPoints& points);
/// sigma_ci, m and k_beta of every inclination with three stresses; no k_beta without planes within 15
/// degrees of across the load.
Fit fit_hoek_brown(const StrengthPoints& points);
/// c_0, phi_0, Omega, Omega_2.
Fit fit_fabric(const StrengthPoints& points);
/// sigma_tj and sigma_t: means of the direct tension across the planes and along them. Points have their
/// tensile strength [Pa] in `ucs`.
Fit fit_tension(const StrengthPoints& points);

/// What constants are of: a part of the sheet, a group of rows in files.
enum class Part { elasticity, ubiquitous_joint, tension, hoek_brown, fabric };
constexpr int n_parts = 5;
/// "ubiquitous joint", as files and sentences call a part.
const char* word_of(Part part);

struct StrengthLaw {
  Part part;
  Fit (*fit)(const StrengthPoints& points);
  /// The same of tests that lack a stress: two are enough, as nothing but a prediction comes of it.
  Fit (*fit_without)(const StrengthPoints& points);
  /// Peak sigma_1 [Pa]; NaN: the fit says nothing there.
  double (*sigma_1)(const Fit& fit, double theta, double sigma_3);
};
std::span<const StrengthLaw> strength_laws();

/// What is left of a law when the tests of one stress are left out and predicted: root of the mean square of
/// the differences of logarithms, over all stresses in turn; NaN: fewer than three stresses have tests, or
/// no fit.
double left_out_error(const StrengthLaw& law, const StrengthPoints& points);

}  // namespace phy::design
