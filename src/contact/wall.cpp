#include "contact/wall.hpp"

#include "contact/model.hpp"

namespace phy::contact::wall {

double normal_stiffness(const MatrixRecipe& m) { return laws::linear::wall_stiffness_factor * m.E_c; }

void parameters(const MatrixRecipe& m, double friction, double* out) {
  const double k = normal_stiffness(m);
  // A rigid wall is a grain without compliance of its own: twice as stiff, of the same ratio.
  out[k_n] = k, out[k_s] = m.ks_over_kn * k, out[inv_k_s] = 1.0 / (m.ks_over_kn * k), out[mu] = friction;
}

laws::Tangent<double> elastic(const MatrixRecipe& m, bool smooth) {
  const double k = normal_stiffness(m);
  return {k, smooth ? 0.0 : m.ks_over_kn * k, 0.0};
}

laws::Tangent<double> elastic_rate(const MatrixRecipe& m, bool smooth, const ElasticParameter& p) {
  constexpr double factor = laws::linear::wall_stiffness_factor;
  // Smooth platens have no shear stiffness that a parameter could change.
  const double rub = smooth ? 0.0 : factor;
  if (p.matrix == &MatrixRecipe::E_c) return {factor, m.ks_over_kn * rub, 0.0};
  if (p.matrix == &MatrixRecipe::ks_over_kn) return {0.0, m.E_c * rub, 0.0};
  return {0.0, 0.0, 0.0};
}

}  // namespace phy::contact::wall
