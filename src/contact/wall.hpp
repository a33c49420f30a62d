// A grain against a rigid body: the linear contact of the grain's own modulus, whatever holds the grains to
// each other. The body is grain 1; n points into the specimen. Friction is the body's.
#pragma once
#include "laws/linear/linear.hpp"
#include "records/recipe.hpp"

namespace phy::contact {
struct ElasticParameter;
}

namespace phy::contact::wall {

enum Parameter { k_n, k_s, inv_k_s, mu, n_parameters };

/// Normal stiffness [N/m per m]; the shear stiffness is ks_over_kn of it.
double normal_stiffness(const MatrixRecipe& m);
void parameters(const MatrixRecipe& m, double friction, double* out);
/// For the direct solution. `smooth`: slides without resistance.
laws::Tangent<double> elastic(const MatrixRecipe& m, bool smooth);
/// Its derivative with respect to a parameter of the matrix.
laws::Tangent<double> elastic_rate(const MatrixRecipe& m, bool smooth, const ElasticParameter& p);

/// p[i]: parameters as above. `rough`: 1 where the body has friction, else 0.
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

}  // namespace phy::contact::wall
