// Flat joint: two grains hold on to each other along a flat interface of finite length, cut into N equal
// elements that break one by one; what is broken still presses and rubs where it is closed.
//
// Along the interface, -R <= x <= R in the direction t, the closure is c(x) = closure + rotation x. Element e
// has half the length h = R/N and its centre at x_e = (2 e + 1 - N) h; there a = c(x_e), b = |rotation| h.
//   bonded   p = k_n c (tension too):  F_e = 2 h k_n a,  m_e = -(2/3) k_n h^3 rotation,  S_e = -k_s 2 h slide
//   unbonded p = k_n max(c, 0), integrated exactly over the length h q that is closed, q = (a + b)/b within
//            0 ... 2:  F_e = 2 h k_n (max(a - b, 0) + b q^2/4),  m_e = -k_n h^3 rotation (q^2/2)(1 - q/3)
//            S_e <- S_e - k_s 2 h d_slide, |S_e| <= mu F_e
//   breaks   in tension where -k_n (a - edge b) >= sigma_c     (tested first; edge = 0: at its centre)
//            in shear where   |S_e|/(2 h) >= c + k_n a tan(phi);   unbonded from that step on
//   F_n = sum F_e,  F_s = sum S_e,  M = sum (m_e - F_e x_e)
// An element that breaks releases what it held at the start of the step and what went into it in the step,
// by the mean of its forces before and after as the leap-frog has it, less what it holds afterwards. (What it
// would hold at the end of the step, had it not broken, is more by half the drop of its forces times the
// motion: an account of first order in the step.)
//
// Closure and rotation count from where the interface is free of force, slide since it was made. Whole, it is
// a parallel bond of length 2R for any N (beta_bar = 0 for N = 1); only breakage knows the elements.
//
// Source: Potyondy 2012 (ARMA 12-501); Itasca PFC `flatjoint` (fj_nr, fj_ten, fj_coh, fj_fa, fj_fric). The
// law works with forces: k_n, k_s, S_0 and capacity are those of the whole interface, stress times 2R. Left
// out: residual cohesion, softening, dilation, re-bonding. Valid for rotations that are small and slides that
// are short against R.
#pragma once
#include <variant>

#include "laws/law.hpp"

namespace phy::laws::flat_joint {

constexpr int most_elements = 4;

template <class R>
struct Parameters {
  R k_n;             ///< k_n 2R [N/m per m], > 0
  R k_s;             ///< k_s 2R [N/m per m], > 0
  R inv_k_s;         ///< 1/k_s
  R half_length;     ///< R [m], > 0
  R mu;              ///< friction coefficient of unbonded elements [-], >= 0
  R S_0;             ///< shear capacity at zero normal force, cohesion 2R [N/m], > 0
  R tan_phi;         ///< slope of the shear strength [-], >= 0
  R edge;            ///< share of an element's own bending in its tensile stress [-], 0 to 1
  R capacity;        ///< tensile capacity sigma_c 2R [N/m], > 0
  R extra_strength;  ///< added to both capacities [N/m]: 0, or huge while breakage is switched off
};

template <class R, int N>
struct State {
  R bonds;  ///< sum of 2^e over the bonded elements
  R shear;  ///< of the interface if all of it were bonded, -k_s slide [N/m]
  R S[N];   ///< of elements that are not bonded [N/m]
};

/// `bonds` of a whole interface of N elements.
template <int N>
constexpr double whole = static_cast<double>((1 << N) - 1);

/// What breaks in a step, by element; to be read only where `some`.
template <class R, int N>
struct Cracks {
  bool some = false;
  MaskOf<R> tension[N], shear[N];
  R released[N];  ///< [J/m]
};

namespace detail {
template <class R>
R number(double v) {
  return R(static_cast<ScalarOf<R>>(v));
}
}  // namespace detail

/// The motion of a step, for the lanes whose interface is not answered for as a whole.
template <class R>
struct PartMotion {
  const Motion<R>& m;
  MaskOf<R> at_rest;  ///< whole, and stays so: not these lanes
};

namespace detail {

/// What the elements of an interface have in common.
template <int N, class R>
struct Division {
  const Parameters<R>& p;
  R h, k_n, k_s, b;
  Division(const Parameters<R>& law, R rotation)
      : p(law),
        h(p.half_length * number<R>(1.0 / N)),
        k_n(p.k_n * number<R>(1.0 / N)),
        k_s(p.k_s * number<R>(1.0 / N)),
        b(abs(rotation) * h) {}
  R centre(int e) const { return h * number<R>(2 * e + 1 - N); }
};

/// Which elements are bonded, from their sum of powers of two.
template <int N, class R>
struct Bonds {
  MaskOf<R> of[N];
  explicit Bonds(R sum) {
    for (int e = N - 1; e >= 0; --e) {
      const R one = number<R>(1 << e);
      of[e] = sum >= one;
      sum = sum - select(of[e], one, R(0));
    }
  }
  MaskOf<R> operator[](int e) const { return of[e]; }
};

/// Sum over the elements from both ends inwards: the mirror image gives the same bits.
template <int N, class R>
R sum(const R (&x)[N]) {
  R total = N % 2 == 1 ? x[N / 2] : R(0);
  for (int e = N / 2 - 1; e >= 0; --e) total = total + (x[e] + x[N - 1 - e]);
  return total;
}

template <class R>
MaskOf<R> fails_in_tension(const Parameters<R>& p, R a, R b) {
  return -(p.k_n * (a - p.edge * b)) >= p.capacity + p.extra_strength;
}
/// `shear`: force of the element times N.
template <class R>
MaskOf<R> fails_in_shear(const Parameters<R>& p, R a, R shear) {
  return abs(shear) >= p.S_0 + p.tan_phi * (p.k_n * a) + p.extra_strength;
}

/// An unbonded element: how it is closed.
template <class R>
struct Closed {
  R all;   ///< closure that all of it has at least [m]
  R part;  ///< q: closed length over h, 0 to 2
  Closed(R a, R b)
      : all(max0(a - b)), part(min(max0((a + b) / max(b, number<R>(1e-30))), R(2))) {}  // b = 0: q is 0 or 2
  /// F_e over the k_n of the element [m].
  R mean(R b) const { return all + R(0.25) * b * part * part; }
  /// -m_e over k_n h^2 rotation of the element; 1/3 where all is closed.
  R bending() const { return R(0.25) * part * part * (R(1) - part * number<R>(1.0 / 3.0)); }
  /// Strain energy over the k_n of the element [m^2].
  R energy(R b) const {
    return R(0.25) * part * (all * all + part * b * (all + part * b * number<R>(1.0 / 3.0)));
  }
};

/// Normal strain energy of a bonded element over its k_n [m^2].
template <class R>
R bonded_energy(R a, R b) {
  return R(0.5) * (a * a + b * b * number<R>(1.0 / 3.0));
}

/// Which of the bonded elements break in this step, in the lanes that are not `at_rest`.
template <int N, class R>
void find_cracks(const Division<N, R>& of, R shear, const PartMotion<R>& now, const Bonds<N, R>& bonded,
                 Cracks<R, N>& cracks) {
  for (int e = 0; e < N; ++e) {
    const R a = now.m.closure + now.m.rotation * of.centre(e);
    const MaskOf<R> may_break = bonded[e] & (!now.at_rest);
    const MaskOf<R> pulled = fails_in_tension(of.p, a, of.b), sheared = fails_in_shear(of.p, a, shear);
    cracks.tension[e] = may_break & pulled;
    cracks.shear[e] = may_break & (!cracks.tension[e]) & sheared;
  }
}

/// What broke, element by element, into what the contact reports: each at most once, tension first.
template <int N, class R>
void report_cracks(Cracks<R, N>& cracks, Reaction<R>& r) {
  for (int e = 0; e < N; ++e) r.broke_tension = r.broke_tension | cracks.tension[e];
  for (int e = 0; e < N; ++e) r.broke_shear = r.broke_shear | (cracks.shear[e] & (!r.broke_tension));
  cracks.some = any(r.broke_tension | r.broke_shear);
  if (cracks.some) r.released = sum(cracks.released);
}

}  // namespace detail

/// A step of a whole interface that does not break in it: a parallel bond. `shear` is after the step.
template <class R>
PHY_HOT inline Reaction<R> respond_whole(const Parameters<R>& p, R shear, const Motion<R>& m) {
  const R k_m = p.k_n * (p.half_length * p.half_length * detail::number<R>(1.0 / 3.0));
  const MaskOf<R> none = R(1) < R(0);
  return {p.k_n * m.closure, shear, -(k_m * m.rotation), R(0), R(0), none, none};
}

/// Whether a whole interface of elements of half length h holds in this step: its most tensile one decides.
template <class R>
PHY_HOT inline MaskOf<R> holds(const Parameters<R>& p, R h, R shear, const Motion<R>& m) {
  const R turn = abs(m.rotation), a = m.closure - turn * (p.half_length - h);
  const MaskOf<R> pulled = detail::fails_in_tension(p, a, turn * h);
  const MaskOf<R> sheared = detail::fails_in_shear(p, a, shear);
  return (!pulled) & (!sheared);
}

/// A step element by element, in the lanes that are not `at_rest`; `s.shear` is after it, `r` has the others.
template <int N, class R>
PHY_RARE void by_elements(const Parameters<R>& p, State<R, N>& s, const PartMotion<R>& now, Reaction<R>& r,
                          Cracks<R, N>& cracks) {
  const auto& [m, at_rest] = now;
  const detail::Division<N, R> of(p, m.rotation);
  const R inv_k_s = p.inv_k_s * detail::number<R>(N), own = of.k_n * of.h * of.h * m.rotation,
          S_bonded = s.shear * detail::number<R>(1.0 / N);
  const detail::Bonds<N, R> bonded(s.bonds);
  detail::find_cracks<N, R>(of, s.shear, now, bonded, cracks);
  R F[N], S[N], M[N], slip[N], left[N];
  for (int e = 0; e < N; ++e) {
    const R x = of.centre(e), a = m.closure + m.rotation * x;
    const MaskOf<R> broken = cracks.tension[e] | cracks.shear[e], keeps = bonded[e] & (!broken);
    const detail::Closed<R> closed(a, of.b);
    const R pressing = of.k_n * closed.mean(of.b);
    const R trial = select(bonded[e], S_bonded, s.S[e] - of.k_s * m.d_slide);
    const R rubbing = clip(trial, p.mu * pressing);
    F[e] = select(keeps, of.k_n * a, pressing);
    S[e] = select(keeps, S_bonded, rubbing);
    M[e] = -(F[e] * x) - own * select(keeps, detail::number<R>(1.0 / 3.0), closed.bending());
    slip[e] = select(bonded[e], R(0), R(0.5) * (s.S[e] + rubbing) * (trial - rubbing) * inv_k_s);
    cracks.released[e] = R(0);
    if (any(broken)) {
      const R held = of.k_n * (detail::bonded_energy(a, of.b) - closed.energy(of.b)) +
                     R(0.5) * (trial * trial - rubbing * rubbing) * inv_k_s;
      // Half of the drop times the motion has not gone into it: the mean of the forces before and after did.
      const R unfelt = (of.k_n * a - pressing) * (m.d_closure + m.d_rotation * x) -
                       (trial - rubbing) * m.d_slide +
                       own * (detail::number<R>(1.0 / 3.0) - closed.bending()) * m.d_rotation;
      cracks.released[e] = select(broken, held - R(0.5) * unfelt, R(0));
    }
    left[e] = select(keeps, detail::number<R>(1 << e), R(0));
    s.S[e] = select(at_rest | keeps, R(0), rubbing);
  }
  s.bonds = select(at_rest, s.bonds, detail::sum(left));
  r.F_n = select(at_rest, r.F_n, detail::sum(F));
  r.F_s = select(at_rest, r.F_s, detail::sum(S));
  r.M = select(at_rest, r.M, detail::sum(M));
  r.dissipated = select(at_rest, r.dissipated, detail::sum(slip));
  detail::report_cracks<N, R>(cracks, r);
}

/// One step. As long as an interface is whole only its most tensile element can break, and it answers as a
/// parallel bond does; the elements are asked one by one where that has ended.
template <int N, class R>
PHY_HOT inline Reaction<R> respond(const Parameters<R>& p, State<R, N>& s, const Motion<R>& m,
                                   Cracks<R, N>& cracks) {
  cracks.some = false;
  s.shear = s.shear - p.k_s * m.d_slide;
  Reaction<R> r = respond_whole(p, s.shear, m);
  const R h = p.half_length * detail::number<R>(1.0 / N);
  const MaskOf<R> all = s.bonds >= detail::number<R>(whole<N>), held = holds(p, h, s.shear, m);
  const MaskOf<R> at_rest = all & held;
  if (any(!at_rest)) by_elements<N, R>(p, s, {m, at_rest}, r, cracks);
  return r;
}

/// Strain energy held after a step [J/m].
template <int N, class R>
PHY_RARE R strain_energy(const Parameters<R>& p, const State<R, N>& s, const Motion<R>& m) {
  const detail::Division<N, R> of(p, m.rotation);
  const R S_bonded = s.shear * detail::number<R>(1.0 / N);
  const detail::Bonds<N, R> bonded(s.bonds);
  R U[N];
  for (int e = 0; e < N; ++e) {
    const R a = m.closure + m.rotation * of.centre(e), S = select(bonded[e], S_bonded, s.S[e]);
    const detail::Closed<R> closed(a, of.b);
    const R normal = select(bonded[e], detail::bonded_energy(a, of.b), closed.energy(of.b));
    U[e] = of.k_n * normal + R(0.5) * detail::number<R>(N) * p.inv_k_s * S * S;
  }
  return detail::sum(U);
}

/// Tangent stiffness where the interface stands: of the length that is bonded or closed, without friction's
/// dependence on the normal force; elements that slip give nothing across.
template <int N, class R>
Tangent<R> tangent(const Parameters<R>& p, const State<R, N>& s, const Motion<R>& m) {
  const detail::Division<N, R> of(p, m.rotation);
  const R per_length = p.k_n / (R(2) * p.half_length);
  const detail::Bonds<N, R> bonded(s.bonds);
  Tangent<R> k{R(0), R(0), R(0)};
  for (int e = 0; e < N; ++e) {
    const R x = of.centre(e), a = m.closure + m.rotation * x;
    const detail::Closed<R> closed(a, of.b);
    const R length = of.h * select(bonded[e], R(2), closed.part);
    const R middle = x + sign(m.rotation) * (of.h - R(0.5) * length);
    const MaskOf<R> holds = bonded[e] | (abs(s.S[e]) < p.mu * of.k_n * closed.mean(of.b));
    k.k_n = k.k_n + per_length * length;
    k.k_nm = k.k_nm + per_length * length * middle;
    k.k_m = k.k_m + per_length * length * (middle * middle + length * length * detail::number<R>(1.0 / 12.0));
    k.k_s = k.k_s + select(holds, of.k_s, R(0));
  }
  return k;
}

inline constexpr ParameterInfo schema[] = {
    {"k_n", "N/m", 1e3, 1e15, 38e9, "fj_kn * 2R", "normal stiffness times length"},
    {"k_s", "N/m", 1e3, 1e15, 11.4e9, "fj_ks * 2R", "shear stiffness times length"},
    {"R", "m", 1e-9, 1e3, 3e-4, "fj_radius", "half the length of the interface"},
    {"mu", "1", 0.0, 10.0, 0.5, "fj_fric", "friction coefficient of broken elements"},
    {"S_0", "N/m", 1e-3, 1e12, 60e3, "fj_coh * 2R", "cohesion times length"},
    {"tan_phi", "1", 0.0, 5.0, 0.0, "tan(fj_fa)", "slope of the shear strength"},
    {"edge", "1", 0.0, 1.0, 0.0, "0", "where tension breaks: 0 centre of an element, 1 its edge"},
    {"elements", "1", 1.0, 4.0, 3.0, "fj_nr", "elements", true},
    {"capacity", "N/m", 1e-3, 1e12, 12e3, "fj_ten * 2R", "tensile capacity"},
};

/// The law as the list sees it: one interface with its parameters in the order of the schema.
template <class R>
struct Contact {
  static constexpr const char* name = "flat_joint";
  static constexpr const char* sentence = "an interface of elements that break one by one and go on pressing";
  static constexpr std::span<const ParameterInfo> parameters = schema;
  Parameters<R> p;
  std::variant<State<R, 1>, State<R, 2>, State<R, 3>, State<R, 4>> s;
  explicit Contact(std::span<const double> v)
      : p{R(v[0]), R(v[1]), R(1.0 / v[1]), R(v[2]), R(v[3]), R(v[4]), R(v[5]), R(v[6]), R(v[8]), R(0)} {
    const auto n = static_cast<int>(v[7]);
    n == 1 ? make<1>() : n == 2 ? make<2>() : n == 3 ? make<3>() : make<4>();
  }
  Reaction<R> step(const Motion<R>& m) {
    const auto one = [&]<int N>(State<R, N>& now) {
      Cracks<R, N> cracks;
      return respond<N, R>(p, now, m, cracks);
    };
    return std::visit(one, s);
  }
  R energy(const Motion<R>& m, const Reaction<R>&) const {
    return std::visit([&]<int N>(const State<R, N>& now) { return strain_energy<N, R>(p, now, m); }, s);
  }
  R capacity() const {
    return std::visit([&](const auto& now) { return select(now.bonds > R(0), p.capacity, R(0)); }, s);
  }

 private:
  template <int N>
  void make() {
    State<R, N> made{detail::number<R>(whole<N>), R(0), {}};
    for (R& S : made.S) S = R(0);
    s = made;
  }
};

}  // namespace phy::laws::flat_joint
