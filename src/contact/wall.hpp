// A grain against a rigid tool: the linear contact of the grain's own modulus, whatever holds the grains to
// each other. The tool is grain 1; n points into the specimen. Friction is the tool's.
#pragma once
#include "contact/model.hpp"
#include "laws/linear/linear.hpp"

namespace phy::contact::wall {

enum Parameter { k_n, k_s, inv_k_s, mu, n_parameters };

/// Normal stiffness [N/m per m]; the shear stiffness is ks_over_kn of it.
inline double normal_stiffness(const MatrixRecipe& m) { return laws::linear::wall_stiffness_factor * m.E_c; }

inline void parameters(const MatrixRecipe& m, double friction, double* out) {
  const double k = normal_stiffness(m);
  out[k_n] = k, out[k_s] = m.ks_over_kn * k, out[inv_k_s] = 1.0 / (m.ks_over_kn * k), out[mu] = friction;
}

/// p[i]: parameters as above. `rough`: 1 where the tool has friction, else 0.
template <class R>
laws::linear::Parameters<R> law(const R* p, R rough) {
  return {p[k_n], p[k_s], p[inv_k_s], p[mu] * rough};
}

/// Normal and shear force [N/m] at a closure and a step of sliding; `shear` is its memory.
template <class R>
PHY_HOT inline laws::Reaction<R> respond(const laws::linear::Parameters<R>& p, R& shear, R closure,
                                         R d_slide) {
  laws::linear::State<R> state{shear};
  const laws::Reaction<R> r = laws::linear::respond(p, state, laws::Motion<R>{closure, R(0), d_slide, R(0)});
  shear = state.F_s;
  return r;
}

template <class R>
R strain_energy(const laws::linear::Parameters<R>& p, const laws::Reaction<R>& r) {
  return laws::linear::strain_energy(p, r.F_n, r.F_s);
}

/// For the direct solution. `smooth`: slides without resistance.
inline laws::Tangent<double> elastic(const MatrixRecipe& m, bool smooth) {
  const double k = m.E_c * laws::linear::wall_stiffness_factor;
  return {k, smooth ? 0.0 : m.ks_over_kn * k, 0.0};
}
/// Its derivative with respect to a parameter of the matrix.
inline laws::Tangent<double> elastic_rate(const MatrixRecipe& m, bool smooth, const ElasticParameter& p) {
  constexpr double factor = laws::linear::wall_stiffness_factor;
  const double rub = smooth ? 0.0 : factor;
  if (p.matrix == &MatrixRecipe::E_c) return {factor, m.ks_over_kn * rub, 0.0};
  if (p.matrix == &MatrixRecipe::ks_over_kn) return {0.0, m.E_c * rub, 0.0};
  return {0.0, 0.0, 0.0};
}

}  // namespace phy::contact::wall
