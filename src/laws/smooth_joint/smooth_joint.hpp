// Smooth joint: a bedding plane seen by one contact. Grains slide along the plane, whatever the direction of
// the line that joins their centres. Bonded at first (cohesion and tensile strength), then Coulomb friction
// with dilation.
//
// n is the plane's normal, directed from the surface of grain 1 to that of grain 2 (decided once, at
// assignment), and the motion is that along n and the plane's t.
//
//   closure <- closure + d_closure;      gap closed g = closure + dilation
//   bonded:  F_n = k_n A g,  F_s <- F_s - k_s A d_slide
//            breaks in tension where  -F_n >= sigma_n A              then F_n = F_s = 0
//            breaks in shear where    |F_s| >= c A + F_n tan(phi)    then as broken, with the same forces
//   broken:  F_n = k_n A max(g, 0);  open (g <= 0): F_n = F_s = 0
//            F_s* = F_s - k_s A d_slide (the part of the step in which the joint is closed)
//            slips where |F_s*| > mu F_n:
//              e = (|F_s*| - mu F_n)/(1 + mu (k_n/k_s) tan psi)
//              F_n += e (k_n/k_s) tan psi;  F_s = mu F_n sign(F_s*);  dilation += e tan psi/(k_s A)
// The opening at breakage is remembered. The slip is implicit: exact for any step. No couple: M = 0.
// A = 2 lambda min(R1, R2) t.
//
// Source: Mas Ivars et al. 2011 (IJRMMS 48:219-244); Itasca PFC `smoothjoint`, small-strain mode. There the
// slip update is explicit; iterated, it alternates between slip and stick when mu (k_n/k_s) tan psi > 1,
// hence the implicit form. Requires tan psi <= mu: otherwise slip would create energy. Left out: rotation of
// n with the grains (n is fixed in space, as in PFC); wear of the dilation angle.
#pragma once
#include "laws/law.hpp"

namespace phy::laws::smooth_joint {

template <class R>
struct Parameters {
  R k_n;             ///< k_n,sj A [N/m per m], > 0
  R k_s;             ///< k_s,sj A [N/m per m], > 0
  R mu;              ///< friction coefficient of the broken joint [-], >= 0
  R S_0;             ///< cohesion times area [N/m], > 0
  R tan_phi;         ///< bonded friction [-], >= 0
  R tan_psi;         ///< dilation [-], 0 <= tan psi <= mu
  R extra_strength;  ///< added to both capacities [N/m]: 0, or huge while breakage is switched off
};

template <class R>
struct State {
  R F_s;       ///< shear force [N/m]
  R closure;   ///< closure since assignment, without dilation [m]
  R capacity;  ///< tensile capacity sigma_n A [N/m]; 0 = broken
  R dilation;  ///< opening pushed by dilation so far [m]
};

/// Tangent stiffness along the plane's n and t of a bonded joint, or of a broken one that is closed and
/// sticks.
template <class R>
Tangent<R> tangent(const Parameters<R>& p) {
  return {p.k_n, p.k_s, R(0)};
}

template <class R>
R strain_energy(const Parameters<R>& p, R F_n, R F_s) {
  return R(0.5) * (F_n * F_n / p.k_n + F_s * F_s / p.k_s);
}

namespace detail {
/// Coulomb slip with implicit dilation from the trial state (r.F_n, trial): into the forces of r and the
/// dilation.
template <class R>
PHY_HOT inline void slip(const Parameters<R>& p, R trial, MaskOf<R> unbonded, Reaction<R>& r, R& dilation) {
  const R excess = abs(trial) - p.mu * r.F_n;
  const auto slips = unbonded & (r.F_n > R(0)) & (excess > R(0));
  if (any(slips & (p.tan_psi > R(0)))) {  // lanes without dilation would only add zeros
    const R slope = p.k_n / p.k_s * p.tan_psi;
    const R e = select(slips, excess / (R(1) + p.mu * slope), R(0));
    r.F_n += e * slope;
    dilation += e * p.tan_psi / p.k_s;
  }
  const R rubbing = select(slips, sign(trial) * p.mu * r.F_n, select(r.F_n > R(0), trial, R(0)));
  r.F_s = select(unbonded, rubbing, r.F_s);
}
}  // namespace detail

template <class R>
PHY_HOT inline Reaction<R> respond(const Parameters<R>& p, State<R>& s, const Motion<R>& m) {
  const auto bonded = s.capacity > R(0);
  const R closure = s.closure + m.d_closure;
  const R g = closure + s.dilation;
  const R F_n_bonded = p.k_n * g;
  const R F_s_bonded = s.F_s - p.k_s * m.d_slide;
  Reaction<R> r{F_n_bonded, F_s_bonded, R(0), R(0), R(0), {}, {}};
  r.broke_tension = bonded & (-F_n_bonded >= s.capacity + p.extra_strength);
  r.broke_shear =
      bonded & (!r.broke_tension) & (abs(F_s_bonded) >= p.S_0 + p.tan_phi * F_n_bonded + p.extra_strength);
  const auto broken = r.broke_tension | r.broke_shear;
  const auto unbonded = (!bonded) | broken;
  if (any(unbonded)) {
    const R entered = min(R(1), max0(g) / select(m.d_closure > R(0), m.d_closure, R(1)));
    const R fraction = select((!bonded) & (m.d_closure > R(0)), entered, R(1));
    const R trial = s.F_s - p.k_s * m.d_slide * fraction;
    const R F_n_closed = p.k_n * max0(g);
    const R before = s.dilation;
    r.F_n = select(unbonded, F_n_closed, F_n_bonded);
    detail::slip(p, trial, unbonded, r, s.dilation);
    const R shear_loss = R(0.5) * (s.F_s + r.F_s) * (s.F_s - p.k_s * m.d_slide - r.F_s) / p.k_s;
    const R lifted = R(0.5) * (F_n_closed + r.F_n) * (s.dilation - before);
    r.dissipated = select(unbonded & (!broken), shear_loss - lifted, R(0));
    if (any(broken)) {
      const R lost = strain_energy(p, F_n_bonded, F_s_bonded) - strain_energy(p, r.F_n, r.F_s);
      r.released = select(broken, lost, R(0));
      s.capacity = select(broken, R(0), s.capacity);
    }
  }
  s.closure = closure;
  s.F_s = r.F_s;
  return r;
}

/// Contact length of a joint between discs of radii r1, r2, t = 1 m [m^2 per m].
inline double area(double lambda, double r1, double r2) { return 2.0 * lambda * (r1 < r2 ? r1 : r2); }

inline constexpr ParameterInfo schema[] = {
    {"k_n", "N/m", 1e3, 1e15, 2e9, "sj_kn * A", "normal stiffness times area"},
    {"k_s", "N/m", 1e3, 1e15, 0.6e9, "sj_ks * A", "shear stiffness times area"},
    {"mu", "1", 0.0, 10.0, 0.4, "sj_fric", "friction coefficient after breakage"},
    {"S_0", "N/m", 1e-3, 1e12, 18e3, "sj_coh * A", "cohesion times area"},
    {"tan_phi", "1", 0.0, 5.0, 0.0, "tan(sj_fa)", "bonded friction"},
    {"tan_psi", "1", 0.0, 1.0, 0.0, "tan(sj_da)", "dilation"},
    {"capacity", "N/m", 1e-3, 1e12, 6e3, "sj_ten * A", "tensile capacity"},
};

/// The law as the list sees it: one joint with its parameters in the order of the schema.
template <class R>
struct Contact {
  static constexpr const char* name = "smooth_joint";
  static constexpr const char* sentence = "a bedding plane: bonded, then sliding with friction and dilation";
  static constexpr std::span<const ParameterInfo> parameters = schema;
  Parameters<R> p;
  State<R> s;
  explicit Contact(std::span<const double> v)
      : p{R(v[0]), R(v[1]), R(v[2]), R(v[3]), R(v[4]), R(v[5]), R(0)}, s{R(0), R(0), R(v[6]), R(0)} {}
  Reaction<R> step(const Motion<R>& m) { return respond(p, s, m); }
  R energy(const Motion<R>&, const Reaction<R>& r) const { return strain_energy(p, r.F_n, r.F_s); }
  R capacity() const { return s.capacity; }
};

}  // namespace phy::laws::smooth_joint
