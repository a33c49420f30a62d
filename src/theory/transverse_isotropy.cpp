#include "theory/transverse_isotropy.hpp"

#include <array>
#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"

namespace phy::theory {

bool is_admissible(const TransverseIsotropy& m) {
  return m.E > 0.0 && m.E_n > 0.0 && m.G_n > 0.0 && std::abs(m.nu) < 1.0 &&
         // Positive strain energy of every strain; nu and nu' alone may well be beyond 0.5.
         1.0 - m.nu - 2.0 * m.nu_n * m.nu_n * m.E / m.E_n > 0.0;
}

double ti_E(const TransverseIsotropy& m, double theta) {
  const SinCos a = sin_cos_degrees(theta);
  const double c2 = a.cos * a.cos;
  const double s2 = a.sin * a.sin;
  // S_2222 of the body turned by theta, theta being that of the planes from +x, load along y.
  return 1.0 / (c2 * c2 / m.E_n + s2 * s2 / m.E + s2 * c2 * (1.0 / m.G_n - 2.0 * m.nu_n / m.E_n));
}

double ti_nu(const TransverseIsotropy& m, double theta) {
  const SinCos a = sin_cos_degrees(theta);
  const double c2 = a.cos * a.cos;
  const double s2 = a.sin * a.sin;
  return ti_E(m, theta) *
         // -S_1122 of the turned body over S_2222.
         (m.nu_n / m.E_n * (c2 * c2 + s2 * s2) - s2 * c2 * (1.0 / m.E + 1.0 / m.E_n - 1.0 / m.G_n));
}

double saint_venant_G(double E, double E_n, double nu_n) {
  // Saint-Venant's guess of what no uniaxial test along or across the planes measures.
  return 1.0 / (1.0 / E + 1.0 / E_n + 2.0 * nu_n / E_n);
}

double saint_venant_E(double E, double E_n, double theta) {
  const SinCos a = sin_cos_degrees(theta);
  // With his G the mixed term drops out, and the curve is straight in cos^2.
  return 1.0 / (a.cos * a.cos / E_n + a.sin * a.sin / E);
}

TransverseIsotropy ti_from_three_tests(double E_0, double E_45, double E_90, double nu_0, double nu) {
  TransverseIsotropy m;
  m.E = E_90;
  m.E_n = E_0;
  m.nu = nu;
  m.nu_n = nu_0;
  // 1/E(45) = (1/E' + 1/E + 1/G' - 2 nu'/E')/4, solved for G'.
  m.G_n = 1.0 / (4.0 / E_45 - 1.0 / E_90 - 1.0 / E_0 + 2.0 * nu_0 / E_0);
  return m;
}

TransverseIsotropy ti_from_goodman(const JointedRock& rock) {
  TransverseIsotropy m;
  m.E = rock.E;
  m.E_n = 1.0 / (1.0 / rock.E + 1.0 / rock.K_n_delta);
  m.nu = rock.nu;
  // Joints add nothing to nu'/E': they close without moving sideways.
  m.nu_n = rock.nu * m.E_n / rock.E;
  m.G_n = 1.0 / (2.0 * (1.0 + rock.nu) / rock.E + 1.0 / rock.K_s_delta);
  return m;
}

JointedRock goodman_from_ti(const TransverseIsotropy& m) {
  JointedRock rock;
  rock.E = m.E;
  rock.nu = m.nu_n * m.E / m.E_n;
  // What the planes add to the compliance of the rock, across and along them.
  rock.K_n_delta = 1.0 / (1.0 / m.E_n - 1.0 / m.E);
  rock.K_s_delta = 1.0 / (1.0 / m.G_n - 2.0 * m.nu_n / m.E_n - 2.0 / m.E);
  return rock;
}

PlaneCompliance plane_compliance(const TransverseIsotropy& m, PlaneState state) {
  PlaneCompliance S;
  S.S_xx = 1.0 / m.E;
  S.S_yy = 1.0 / m.E_n;
  S.S_xy = -m.nu_n / m.E_n;
  // Of the engineering shear strain.
  S.S_ss = 1.0 / m.G_n;
  if (state == PlaneState::strain) {  // sigma_33 = nu sigma_11 + nu' (E/E') sigma_22 keeps eps_33 at zero
    const double p = m.nu;
    const double q = m.nu_n * m.E / m.E_n;
    S.S_xx -= p * p / m.E;
    S.S_xy -= p * q / m.E;
    S.S_yy -= q * q / m.E;
  }
  return S;
}

PlaneCompliance rotated(const PlaneCompliance& S, double theta) {
  using Matrix = std::array<std::array<double, 3>, 3>;
  const SinCos a = sin_cos_degrees(theta);
  const double c = a.cos;
  const double s = a.sin;
  // Takes stresses to the axes of the body; its transpose takes engineering strains back.
  const Matrix Q = {
      {{c * c, s * s, 2.0 * s * c}, {s * s, c * c, -2.0 * s * c}, {-s * c, s * c, c * c - s * s}}};
  const Matrix body = {{{S.S_xx, S.S_xy, S.S_xs}, {S.S_xy, S.S_yy, S.S_ys}, {S.S_xs, S.S_ys, S.S_ss}}};
  Matrix fixed{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) fixed[i][j] += Q[k][i] * body[k][l] * Q[l][j];
  return {fixed[0][0], fixed[1][1], fixed[0][1], fixed[0][2], fixed[1][2], fixed[2][2]};
}

PlaneConstants seen_at(const PlaneCompliance& S, double theta) {
  const SinCos a = sin_cos_degrees(theta);
  const double c2 = a.cos * a.cos, s2 = a.sin * a.sin, s2c2 = s2 * c2;
  const double axial = S.S_yy * c2 * c2 + S.S_xx * s2 * s2 + (S.S_ss + 2.0 * S.S_xy) * s2c2;
  const double lateral = S.S_xy * (c2 * c2 + s2 * s2) + (S.S_xx + S.S_yy - S.S_ss) * s2c2;
  return {1.0 / axial, -lateral / axial};
}

PlaneConstants seen_in_plane_strain(const PlaneConstants& body) {
  // Strains along the axis of the drift, or of a slab, cannot arise.
  return {body.E / (1.0 - body.nu * body.nu), body.nu / (1.0 - body.nu)};
}

PlaneConstants body_from_plane_strain(const PlaneConstants& seen) {
  // nu first: E needs it.
  const double nu = seen.nu / (1.0 + seen.nu);
  return {seen.E * (1.0 - nu * nu), nu};
}

}  // namespace phy::theory
