#include "study/expected.hpp"

#include <algorithm>
#include <cmath>

#include "base/exact_math.hpp"
#include "engine/isa.hpp"
#include "records/test_description.hpp"
#include "theory/goodman.hpp"
#include "theory/jaeger.hpp"

namespace phy::study {
namespace {

// Rules of thumb from the paper's specimen (docs/paper.md) and examples/lab: macro over micro.
constexpr double modulus_factor = 0.9;  // E over that of contact and bond
constexpr double bedded_factor = 2.1;   // the same of what lies between the planes
constexpr double bridge_factor = 0.2;   // macro cohesion over tau_c: bonds that the joints leave between them
constexpr double cohesion_factor = 0.5;    // macro cohesion over that of the joints, beside the bridges
constexpr double stiffness_factor = 1.8;   // K over k, for n and s, of a plane one layer of contacts thick
constexpr double layer_thickness = 0.9;    // of a zone that holds one layer, over the mean diameter
constexpr double direct_cycles = 7000.0;   // that a press runs in both direct solutions
constexpr double beyond_peak = 1.15;       // strain at the end of a test over that of the peak
constexpr double step_factor = 0.53;       // dt over sqrt(m/k) of the smallest grain, step_safety as usual
constexpr double equal_mass_factor = 1.3;  // the same over that of discs

}  // namespace

double expected_grains(const Recipe& r) {
  const PackingRecipe& p = r.packing;
  const double box = r.specimen.width * r.specimen.height;
  const double n = p.n_grains > 0 ? static_cast<double>(p.n_grains)
                                  : (1.0 - p.porosity) * box / (pi * p.mean_square_radius());
  const SpecimenCut cut = r.test.kind->cut != nullptr ? r.test.kind->cut(r) : SpecimenCut{};
  const double diameter = std::max(cut.hole, r.specimen.hole_diameter),
               hole = 0.25 * pi * diameter * diameter;
  // Discs and half discs are cut from the box: their share of its area. A flaw takes out next to nothing.
  const double shape =
      cut.diameter == 0.0 ? box : (cut.half ? 0.125 : 0.25) * pi * cut.diameter * cut.diameter;
  return n * (shape - hole) / box;
}

double expected_memory(const Recipe& r, std::size_t n_specimens) {
  // Per grain: the packing with its near pairs; a specimen in its lane, as its last block began and as it is
  // written, in double precision; what each frame and each snapshot holds, both up to twice as many as asked
  // for.
  constexpr double packing = 2000.0, specimen = 2700.0, frame = 2 * 8.0, snapshot = 2 * 168.0;
  const double each = specimen + frame * static_cast<double>(std::max<std::int64_t>(1, r.test.n_frames)) +
                      snapshot * static_cast<double>(std::max<std::int64_t>(1, r.test.n_snapshots));
  return expected_grains(r) * (packing + static_cast<double>(n_specimens) * each);
}

double expected_cost(const Recipe& r) { return expected_cost(r, expected_peak_strain(r)); }

double expected_cost(const Recipe& r, double peak_strain) {
  const MatrixRecipe& m = r.matrix;
  // The smallest grain decides the step; mass is per metre of thickness, so sqrt(mass/E) is a time.
  const double mass = m.density * pi * r.packing.radius_min * r.packing.radius_min;
  const double equal = r.engine.grain_inertia == GrainInertia::equal ? equal_mass_factor : 1.0;
  const double dt =
      equal * step_factor * r.engine.step_safety / EngineRecipe{}.step_safety * std::sqrt(mass / m.modulus());
  // At least a tenth of the way to the peak, for tests whose pre-strain leaves almost nothing.
  const double strain =
      std::max(0.1 * peak_strain, std::min(beyond_peak * peak_strain, r.test.max_strain) - r.test.pre_strain);
  const double fast = std::min(strain, std::max(0.0, r.test.approach_strain - r.test.pre_strain));
  const double way =
      (strain - fast) / r.test.platen_speed + (fast > 0.0 ? fast / r.test.approach_speed : 0.0);
  // Both platens move, so strain grows by 2 v/length per second.
  return way * r.test.kind->expected.length(r) / (2.0 * dt) * expected_grains(r);
}

double expected_direct_cost(const Recipe& r) { return direct_cycles * expected_grains(r); }

double expected_peak_strain(const Recipe& r) {
  // Runs to its end: the peak does not matter.
  if (r.test.kind->runs_to_end) return r.test.max_strain;
  const ExpectedPeak& expected = r.test.kind->expected;
  const MatrixRecipe& m = r.matrix;
  const double E = modulus_factor * m.modulus(), bond = std::min(m.sigma_c, m.tau_c);
  if (r.bedding.empty()) return expected.strain_factor * expected.intact * bond / E;
  const BeddingRecipe& b = r.bedding.front();
  const double layer = layer_thickness * (r.packing.radius_min + r.packing.radius_max);
  // Joints in series: a zone of several contact layers is softer by their number.
  const double layers = b.rule == BeddingRule::zone ? b.zone_thickness / layer : 1.0;  // one behind the other
  // Dispersed: of the layers of contacts one in 90 deg/orientation_range is a joint.
  const double spacing = b.has_planes() ? b.spacing : layer * 90.0 / b.orientation_range;
  const double factor = stiffness_factor * spacing / layers;
  const double cohesion = bridge_factor * m.tau_c + cohesion_factor * b.cohesion;
  // Weak planes in elastic rock: macro stiffness per area and spacing by Goodman, strength by Jaeger.
  const theory::JointedRock rock{E, factor * b.k_n, factor * b.k_s, 0.0};
  const double stress =
      expected.bedded > 0.0
          ? expected.strain_factor * expected.bedded * bond
          : expected.strain_factor *
                theory::jaeger_sigma_1({cohesion, b.phi}, bedded_factor * bond, b.theta, 0.0);
  return stress / theory::goodman_E(rock, b.theta);
}

double usual_seconds_per_cost(Precision precision) {
  // The lanes of a register share the time of a contact and cycle: studies of seven angles take 4 ns of
  // sixteen lanes, 7 to 8 of eight.
  constexpr double contacts_per_grain = 2.6, time_of_register = 60e-9;
  return contacts_per_grain * time_of_register / engine::native_lanes(precision, engine::native_isa());
}

}  // namespace phy::study
