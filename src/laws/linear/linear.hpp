// Linear contact: two grains that touch press on each other like springs and slip by Coulomb's law.
//
//   F_n = k_n max(closure, 0)                       absolute in the overlap; no tension
//   F_s <- F_s - k_s d_slide, |F_s| <= mu F_n       incremental; shear memory is lost when the contact opens
//   slip work = (F_s,old + F_s,new)/2 * slip,  slip = d_slide + (F_s,new - F_s,old)/k_s
//
// Source: Cundall & Strack 1979 (Geotechnique 29:47-65); Itasca PFC `linear` model with lin_mode 0.
// Stiffness from a modulus, plane discs of unit thickness (t = 1 m):
//   pfc31: every grain is a spring 2 E_c t, two in series: k_n = E_c t, independent of the radii
//   pfc5:  k_n = 2 r_min t E_c / (R1 + R2)
// Units: forces N per metre of thickness, stiffness N/m per metre. Signs: law.hpp.
// Left out: viscous dashpots; the fraction of the step in which a contact becomes active (its shear is
// bounded by mu F_n of that step). Valid for overlaps small against the radii.
#pragma once
#include "laws/law.hpp"

namespace phy::laws::linear {

template <class R>
struct Parameters {
  R k_n;      ///< normal stiffness [N/m per m], > 0
  R k_s;      ///< shear stiffness [N/m per m], > 0
  R inv_k_s;  ///< 1/k_s; given so that no lane has to divide in every step
  R mu;       ///< friction coefficient [-], >= 0
};

template <class R>
struct State {
  R F_s;  ///< shear force of the last step [N/m]
};

template <class R>
PHY_HOT inline Reaction<R> respond(const Parameters<R>& p, State<R>& s, const Motion<R>& m) {
  const R F_n = p.k_n * max0(m.closure);
  const R trial = s.F_s - p.k_s * m.d_slide;
  const R F_s = clip(trial, p.mu * F_n);
  const R dissipated = R(0.5) * (s.F_s + F_s) * (trial - F_s) * p.inv_k_s;
  s.F_s = F_s;
  const auto never = F_n < R(0);
  return {F_n, F_s, R(0), dissipated, R(0), never, never};
}

/// Tangent stiffness of a closed contact that sticks; an open one has none.
template <class R>
Tangent<R> tangent(const Parameters<R>& p) {
  return {p.k_n, p.k_s, R(0)};
}

/// Strain energy held [J/m].
template <class R>
R strain_energy(const Parameters<R>& p, R F_n, R F_s) {
  return R(0.5) * (F_n * F_n / p.k_n + F_s * F_s * p.inv_k_s);
}

/// k_n / E* [-] of a contact between discs of radii r1, r2: pfc5 (true) or pfc31 (false).
inline double stiffness_factor(bool pfc5, double r1, double r2) {
  return pfc5 ? 2.0 * (r1 < r2 ? r1 : r2) / (r1 + r2) : 1.0;
}
/// k_n / E* of a disc against a rigid platen: 2 t in both conventions (pfc31: one grain spring).
constexpr double wall_stiffness_factor = 2.0;

inline constexpr ParameterInfo schema[] = {
    {"k_n", "N/m", 1e3, 1e15, 38e9, "kn", "normal stiffness per metre of thickness"},
    {"k_s", "N/m", 1e3, 1e15, 11.4e9, "ks", "shear stiffness per metre of thickness"},
    {"mu", "1", 0.0, 10.0, 0.8, "fric", "friction coefficient"},
};

/// The law as the list sees it: one contact with its parameters in the order of the schema.
template <class R>
struct Contact {
  static constexpr const char* name = "linear";
  static constexpr const char* sentence = "springs that push and slip";
  static constexpr std::span<const ParameterInfo> parameters = schema;
  Parameters<R> p;
  State<R> s{R(0)};
  explicit Contact(std::span<const double> v) : p{R(v[0]), R(v[1]), R(1.0 / v[1]), R(v[2])} {}
  Reaction<R> step(const Motion<R>& m) { return respond(p, s, m); }
  R energy(const Motion<R>&, const Reaction<R>& r) const { return strain_energy(p, r.F_n, r.F_s); }
  R capacity() const { return R(0); }
};

}  // namespace phy::laws::linear
