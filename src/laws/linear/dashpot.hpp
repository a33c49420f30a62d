// Linear contact with viscous dashpots beside its springs: rebounding grains lose a known part of their
// speed.
//
//   F_n = k_n closure + c_n d(closure)/dt          while closure > 0; modes 1 and 3: never below 0
//   F_s = F_s(spring) - c_s d(slide)/dt            modes 2 and 3: no dashpot while the spring slips
//   c = 2 xi sqrt(m_c k),  m_c = m1 m2/(m1 + m2) (a wall: m1);  xi = 1 is critical
// Restitution of a central impact, s = sqrt(1 - xi^2):
//   mode 0 and 2:  e = exp(-pi xi/s)                                     ends where closure is 0 again
//   mode 1 and 3:  e = exp(-(xi/s) (pi - atan2(2 xi s, 1 - 2 xi^2)))     ends where the force is 0
//
// Source: Cundall & Strack 1979 (contact damping); modes and names as in Itasca PFC's `linear` (dp_mode). The
// closed forms follow from m_c x'' + c x' + k x = 0, x(0) = 0 (derived again in tests and in V9). The spring
// is that of linear.hpp. A law knows no clock: increments and `inv_dt`, the steps per second, make the speed.
// Left out: dashpots in the press, where local damping takes their place: a quasi-static test needs no
// restitution, and the loop over contacts pays nothing for a law that it does not call.
#pragma once
#include <cmath>

#include "laws/linear/linear.hpp"

namespace phy::laws::dashpot {

template <class R>
struct Parameters {
  linear::Parameters<R> spring;
  R c_n;     ///< normal dashpot [N s/m per m], >= 0
  R c_s;     ///< shear dashpot [N s/m per m], >= 0
  R inv_dt;  ///< steps per second [1/s], > 0
  int mode;  ///< 0 full, 1 no tension, 2 shear cut while slipping, 3 both; the same in all lanes
};

template <class R>
using State = linear::State<R>;

template <class R>
PHY_HOT inline Reaction<R> respond(const Parameters<R>& p, State<R>& s, const Motion<R>& m) {
  const R before = s.F_s;
  Reaction<R> r = linear::respond(p.spring, s, m);
  const auto touching = m.closure > R(0);
  R push = select(touching, p.c_n * m.d_closure * p.inv_dt, R(0));
  R drag = select(touching, -(p.c_s * m.d_slide * p.inv_dt), R(0));
  if ((p.mode & 1) != 0) push = select(r.F_n + push < R(0), -r.F_n, push);
  if ((p.mode & 2) != 0) {
    const R spring = before - p.spring.k_s * m.d_slide;
    drag = select(abs(spring) > p.spring.mu * r.F_n, R(0), drag);
  }
  r.F_n += push;
  r.F_s += drag;
  r.dissipated += push * m.d_closure - drag * m.d_slide;
  return r;
}

/// c = 2 xi sqrt(m_c k) [N s/m per m] of the fraction xi of critical damping, m_c in kg per m.
inline double coefficient(double xi, double m_c, double k) { return 2.0 * xi * std::sqrt(m_c * k); }

inline constexpr ParameterInfo schema[] = {
    linear::schema[0],  // k_n, k_s and mu of the springs
    linear::schema[1],
    linear::schema[2],
    {"c_n", "N s/m", 0.0, 1e12, 1e3, "dp_nratio * 2 sqrt(m kn)", "normal dashpot"},
    {"c_s", "N s/m", 0.0, 1e12, 500.0, "dp_sratio * 2 sqrt(m ks)", "shear dashpot"},
    {"inv_dt", "1/s", 1e-6, 1e12, 1e6, "1/timestep", "steps per second"},
    {"mode", "1", 0.0, 3.0, 0.0, "dp_mode", "0 full, 1 no tension, 2 shear cut while slipping, 3 both", true},
};

/// The law as the list sees it: one contact with its parameters in the order of the schema.
template <class R>
struct Contact {
  static constexpr const char* name = "dashpot";
  static constexpr const char* sentence = "springs that push and slip, with viscous damping";
  static constexpr std::span<const ParameterInfo> parameters = schema;
  Parameters<R> p;
  State<R> s{R(0)};
  explicit Contact(std::span<const double> v)
      : p{linear::Contact<R>(v).p, R(v[3]), R(v[4]), R(v[5]), static_cast<int>(v[6])} {}
  Reaction<R> step(const Motion<R>& m) { return respond(p, s, m); }
  /// Of the springs: the dashpots, which the reaction counts in, hold none.
  R energy(const Motion<R>& m, const Reaction<R>&) const {
    return linear::strain_energy(p.spring, p.spring.k_n * max0(m.closure), s.F_s);
  }
  R capacity() const { return R(0); }
};

}  // namespace phy::laws::dashpot
