// Parallel bond: a patch of cement between two grains that carries tension, shear and bending until it breaks
// for good.
//
//   F_n = kb_n A closure
//   F_s <- F_s - kb_s A d_slide
//   M   = -kb_n I rotation
//   breaks in tension where   -F_n/A + beta_bar |M| R_bar/I >= sigma_c    (tested first)
//   breaks in shear where     |F_s|/A >= c + (F_n/A) tan(phi)
//   R_bar = lambda min(R1, R2);  A = 2 R_bar t;  I = (2/3) R_bar^3 t;  kb_n = E_b/(R1 + R2) [Pa/m];  t = 1 m
// Closure and rotation (of grain 2 against grain 1) count since bonding: the total form of dF_n = kb_n A
// du_n, free of drift. phi = 0 and c = tau_c: Potyondy & Cundall. A broken bond carries nothing; the linear
// contact beside it stays.
//
// Source: Potyondy & Cundall 2004 (IJRMMS 41:1329-1364), section on the parallel bond; the moment
// contribution beta_bar and the cohesion-friction strength are those of Itasca PFC's `linearpbond` (pb_mcf,
// pb_coh, pb_fa). The law works with forces, not stresses: capacity = sigma_c A and S_0 = tau_c A [N/m], arm
// = beta_bar A R_bar/I [1/m]. Left out: gradual softening; re-bonding.
#pragma once
#include "laws/law.hpp"

namespace phy::laws::parallel_bond {

template <class R>
struct Parameters {
  R k_n;             ///< kb_n A [N/m per m], > 0
  R k_s;             ///< kb_s A [N/m per m], > 0
  R k_m;             ///< kb_n I [N], >= 0
  R arm;             ///< beta_bar A R_bar / I = 3 beta_bar / R_bar [1/m], >= 0
  R S_0;             ///< shear capacity at zero normal force, tau_c A [N/m], > 0
  R tan_phi;         ///< slope of the shear strength [-], >= 0
  R extra_strength;  ///< added to both capacities [N/m]: 0, or huge while breakage is switched off
};

template <class R>
struct State {
  R F_s;       ///< shear force [N/m]
  R capacity;  ///< tensile capacity sigma_c A [N/m]; 0 = no bond (broken, or never bonded)
};

/// Tangent stiffness of an unbroken bond; a broken one has none.
template <class R>
Tangent<R> tangent(const Parameters<R>& p) {
  return {p.k_n, p.k_s, p.k_m};
}

/// Strain energy held [J/m].
template <class R>
R strain_energy(const Parameters<R>& p, R F_n, R F_s, R M) {
  const R bending = select(p.k_m > R(0), M * M / p.k_m, R(0));
  return R(0.5) * (F_n * F_n / p.k_n + F_s * F_s / p.k_s + bending);
}

template <class R>
PHY_HOT inline Reaction<R> respond(const Parameters<R>& p, State<R>& s, const Motion<R>& m) {
  const auto bonded = s.capacity > R(0);
  const R F_n = select(bonded, p.k_n * m.closure, R(0));
  const R F_s = select(bonded, s.F_s - p.k_s * m.d_slide, R(0));
  const R M = select(bonded, -(p.k_m * m.rotation), R(0));
  Reaction<R> r{F_n, F_s, M, R(0), R(0), {}, {}};
  r.broke_tension = bonded & (p.arm * abs(M) - F_n >= s.capacity + p.extra_strength);
  r.broke_shear = bonded & (!r.broke_tension) & (abs(F_s) >= p.S_0 + p.tan_phi * F_n + p.extra_strength);
  const auto broken = r.broke_tension | r.broke_shear;
  if (any(broken)) {
    r.released = select(broken, strain_energy(p, F_n, F_s, M), R(0));
    r.F_n = select(broken, R(0), F_n);
    r.F_s = select(broken, R(0), F_s);
    r.M = select(broken, R(0), M);
    s.capacity = select(broken, R(0), s.capacity);
  }
  s.F_s = r.F_s;
  return r;
}

/// Geometry of the bond between discs of radii r1, r2 with radius multiplier lambda, t = 1 m.
struct Geometry {
  double R_bar;  ///< [m]
  double A;      ///< [m^2 per m]
  double I;      ///< [m^4 per m]
  double L;      ///< R1 + R2 [m]; kb_n = E_b / L
};
inline Geometry geometry(double lambda, double r1, double r2) {
  const double R_bar = lambda * (r1 < r2 ? r1 : r2);
  return {R_bar, 2.0 * R_bar, 2.0 / 3.0 * R_bar * R_bar * R_bar, r1 + r2};
}

inline constexpr ParameterInfo schema[] = {
    {"k_n", "N/m", 1e3, 1e15, 32e9, "pb_kn * A", "normal stiffness times area"},
    {"k_s", "N/m", 1e3, 1e15, 9.6e9, "pb_ks * A", "shear stiffness times area"},
    {"k_m", "N", 0.0, 1e12, 1e3, "pb_kn * I", "bending stiffness"},
    {"arm", "1/m", 0.0, 1e9, 9000.0, "pb_mcf * A * R/I", "periphery stress per moment, times the area"},
    {"S_0", "N/m", 1e-3, 1e12, 40e3, "pb_coh * A", "shear capacity at zero normal force"},
    {"tan_phi", "1", 0.0, 5.0, 0.0, "tan(pb_fa)", "slope of the shear strength"},
    {"capacity", "N/m", 1e-3, 1e12, 40e3, "pb_ten * A", "tensile capacity"},
};

/// The law as the list sees it: one bond with its parameters in the order of the schema.
template <class R>
struct Contact {
  static constexpr const char* name = "parallel_bond";
  static constexpr const char* sentence = "cement that carries tension, shear and bending until it breaks";
  static constexpr std::span<const ParameterInfo> parameters = schema;
  Parameters<R> p;
  State<R> s;
  explicit Contact(std::span<const double> v)
      : p{R(v[0]), R(v[1]), R(v[2]), R(v[3]), R(v[4]), R(v[5]), R(0)}, s{R(0), R(v[6])} {}
  Reaction<R> step(const Motion<R>& m) { return respond(p, s, m); }
  R energy(const Motion<R>&, const Reaction<R>& r) const { return strain_energy(p, r.F_n, r.F_s, r.M); }
  R capacity() const { return s.capacity; }
};

}  // namespace phy::laws::parallel_bond
