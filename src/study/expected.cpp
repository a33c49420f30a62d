#include "study/expected.hpp"

#include <algorithm>
#include <cmath>

#include "base/exact_math.hpp"
#include "theory/goodman.hpp"
#include "theory/jaeger.hpp"

namespace phy {
namespace {

// Rules of thumb from the paper's specimen (docs/paper.md): macro over micro.
constexpr double modulus_factor = 0.9;   // E over E_c + E_b
constexpr double strength_factor = 2.7;  // UCS over the weaker bond strength, intact
constexpr double bedded_factor = 2.1;    // the same of what lies between the planes
constexpr double bridge_factor = 0.2;  // macro cohesion over tau_c: bonds that the joints leave between them
constexpr double cohesion_factor = 0.5;   // macro cohesion over that of the joints, beside the bridges
constexpr double stiffness_factor = 1.8;  // K over k, for n and s, of a plane one layer of contacts thick
constexpr double layer_thickness = 0.9;   // of a zone that holds one layer, over the mean diameter
constexpr double beyond_peak = 1.15;      // strain at the end of a test over that of the peak
constexpr double step_factor = 0.53;      // dt over sqrt(m/k) of the smallest grain, step_safety as usual

}  // namespace

double expected_cost(const Recipe& r) {
  const MatrixRecipe& m = r.matrix;
  const double mass = m.density * pi * r.packing.radius_min * r.packing.radius_min;
  const double dt =
      step_factor * r.engine.step_safety / EngineRecipe{}.step_safety * std::sqrt(mass / (m.E_c + m.E_b));
  const double strain =
      std::max(0.1 * expected_peak_strain(r),
               std::min(beyond_peak * expected_peak_strain(r), r.test.max_strain) - r.test.jump_strain);
  const double cycles = strain * r.specimen.height / (2.0 * r.test.platen_speed * dt);
  const double mean = 0.5 * (r.packing.radius_min + r.packing.radius_max);
  const double n_grains = r.packing.n_grains > 0
                              ? static_cast<double>(r.packing.n_grains)
                              : 0.85 * r.specimen.width * r.specimen.height / (pi * mean * mean);
  return cycles * n_grains;
}

double expected_peak_strain(const Recipe& r) {
  const MatrixRecipe& m = r.matrix;
  const double E = modulus_factor * (m.E_c + m.E_b), bond = std::min(m.sigma_c, m.tau_c);
  if (r.bedding.empty()) return strength_factor * bond / E;
  const BeddingRecipe& b = r.bedding.front();
  const double layer = layer_thickness * (r.packing.radius_min + r.packing.radius_max);
  const double layers = b.rule == BeddingRule::zone ? b.zone_thickness / layer : 1.0;  // one behind the other
  const double factor = stiffness_factor * b.spacing / layers;
  const double cohesion = bridge_factor * m.tau_c + cohesion_factor * b.cohesion;
  const JointedRock rock{E, factor * b.k_n, factor * b.k_s, 0.0};
  return jaeger_sigma_1({cohesion, b.phi}, bedded_factor * bond, b.theta, 0.0) / goodman_E(rock, b.theta);
}

double usual_seconds_per_cost(Precision precision) {
  // 2.6 contacts per grain times the time per contact and cycle of studies, whose lanes are not always full.
  return 2.6 * (precision == Precision::single_precision ? 3e-9 : 7e-9);
}

}  // namespace phy
