#include "calibrate/parameters.hpp"

namespace phy {
namespace {

void set_sigma_c(Recipe& r, double value) {
  MatrixRecipe& m = r.matrix;
  const double scale = value / m.sigma_c;
  for (double* strength : {&m.sigma_c, &m.sigma_c_sd, &m.tau_c, &m.tau_c_sd}) *strength *= scale;
  for (BeddingRecipe& b : r.bedding) b.cohesion *= scale, b.sigma_n *= scale;
  m.sigma_c = value;
}

void set_tau_ratio(Recipe& r, double value) {
  MatrixRecipe& m = r.matrix;
  const double scale = value * m.sigma_c / m.tau_c;
  m.tau_c *= scale, m.tau_c_sd *= scale;
  for (BeddingRecipe& b : r.bedding) b.cohesion *= scale, b.sigma_n *= scale;
}

void set_cohesion_ratio(Recipe& r, double value) {
  for (BeddingRecipe& b : r.bedding) {
    const double before = b.cohesion;
    b.cohesion = value * r.matrix.tau_c;
    b.sigma_n *= b.cohesion / before;
  }
}

const BeddingRecipe& joint(const Recipe& r) { return r.bedding.front(); }

}  // namespace

const std::vector<Parameter>& elastic_parameters() {
  static const std::vector<Parameter> list = {
      {"matrix.E_c", "E_c", "Pa", false, 0.05, 3.0, 0.5, [](const Recipe& r) { return r.matrix.E_c; },
       [](Recipe& r, double v) { r.matrix.E_c = r.matrix.E_b = v; }},
      {"matrix.ks_over_kn", "k_s/k_n", "1", false, 0.05, 1.0, 0.3,
       [](const Recipe& r) { return r.matrix.ks_over_kn; },
       [](Recipe& r, double v) { r.matrix.ks_over_kn = r.matrix.bond_ks_over_kn = v; }},
      {"bedding[0].k_n", "k_n,sj", "Pa/m", true, 0.02, 50.0, 0.5,
       [](const Recipe& r) { return joint(r).k_n; }, [](Recipe& r, double v) { r.bedding.front().k_n = v; }},
      {"bedding[0].k_s", "k_s,sj", "Pa/m", true, 0.005, 50.0, 0.2,
       [](const Recipe& r) { return joint(r).k_s; }, [](Recipe& r, double v) { r.bedding.front().k_s = v; }}};
  return list;
}

const std::vector<Parameter>& strength_parameters() {
  static const std::vector<Parameter> list = {
      {"matrix.sigma_c", "sigma_c", "Pa", false, 0.1, 1.5, 0.4,
       [](const Recipe& r) { return r.matrix.sigma_c; }, set_sigma_c},
      {"tau_c/sigma_c", "tau_c/sigma_c", "1", false, 0.8, 5.0, 1.6,
       [](const Recipe& r) { return r.matrix.tau_c / r.matrix.sigma_c; }, set_tau_ratio},
      {"matrix.mu", "mu", "1", false, 0.2, 1.2, 0.6, [](const Recipe& r) { return r.matrix.mu; },
       [](Recipe& r, double v) { r.matrix.mu = v; }},
      {"C_sj/tau_c", "C_sj/tau_c", "1", true, 0.07, 0.9, 0.25,
       [](const Recipe& r) { return joint(r).cohesion / r.matrix.tau_c; }, set_cohesion_ratio},
      {"sigma_n,sj/C_sj", "sigma_n,sj/C_sj", "1", true, 0.07, 1.5, 0.33,
       [](const Recipe& r) { return joint(r).sigma_n / joint(r).cohesion; },
       [](Recipe& r, double v) {
         for (BeddingRecipe& b : r.bedding) b.sigma_n = v * b.cohesion;
       }},
      {"bedding[0].mu", "mu_sj", "1", true, 0.15, 1.0, 0.4, [](const Recipe& r) { return joint(r).mu; },
       [](Recipe& r, double v) { r.bedding.front().mu = v; }}};
  return list;
}

}  // namespace phy
