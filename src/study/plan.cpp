#include "study/plan.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/exact_math.hpp"
#include "genesis/cache.hpp"
#include "lab/rigs.hpp"
#include "study/experiment.hpp"
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
constexpr double step_factor = 0.53;      // dt over sqrt(m/k) of the smallest grain

std::size_t kind_of(std::map<std::vector<double>, std::size_t>& kinds, const Recipe& single) {
  std::vector<double> angles;
  for (const BeddingRecipe& set : single.bedding) angles.push_back(set.theta);
  return kinds.try_emplace(angles, kinds.size()).first->second;
}

using BatchName = std::tuple<std::string, std::string, Precision, std::int64_t>;

BatchName batch_name(const Recipe& r) {
  return {r.packing.file.empty() ? packing_key(r.specimen, r.packing, r.matrix) : r.packing.file, rig_name(r),
          r.engine.precision, r.test.history_interval};
}

/// Batches, longest tests first; equal ones in the order of the design.
void make_batches(Plan& plan, const Shard& shard) {
  std::map<BatchName, std::size_t> numbers;
  for (std::size_t t = 0; t < plan.tests.size(); ++t) {
    const auto [it, is_new] = numbers.emplace(batch_name(plan.tests[t].recipe), plan.batches.size());
    if (is_new) plan.batches.emplace_back();
    plan.tests[t].batch = it->second;
    plan.batches[it->second].tests.push_back(t);
  }
  std::size_t dealt = 0;
  for (Batch& batch : plan.batches) {
    std::stable_sort(batch.tests.begin(), batch.tests.end(),
                     [&](std::size_t a, std::size_t b) { return plan.tests[a].cost > plan.tests[b].cost; });
    std::erase_if(batch.tests, [&](std::size_t) {
      return dealt++ % static_cast<std::size_t>(shard.n) != static_cast<std::size_t>(shard.i - 1);
    });
  }
}

}  // namespace

double expected_cost(const Recipe& r) {
  const MatrixRecipe& m = r.matrix;
  const double mass = m.density * pi * r.packing.radius_min * r.packing.radius_min;
  const double dt = step_factor * r.engine.step_safety / 0.92 * std::sqrt(mass / (m.E_c + m.E_b));
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

Plan plan_of(const std::vector<Recipe>& singles) {
  Plan plan;
  std::map<std::string, std::size_t> known;
  std::map<std::vector<double>, std::size_t> kinds;
  for (std::size_t i = 0; i < singles.size(); ++i) {
    const std::string key = specimen_key(singles[i]);
    const auto [it, is_new] = known.emplace(key, plan.tests.size());
    if (is_new)
      plan.tests.push_back({key, singles[i], expected_cost(singles[i]), 0, kind_of(kinds, singles[i])});
    plan.runs.push_back({0, singles[i].packing.seed, singles[i].matrix.bond_seed, i, it->second});
  }
  make_batches(plan, {});
  return plan;
}

Plan make_plan(const Study& study, const Shard& shard) {
  Plan plan;
  plan.study = study;
  plan.points = points_of(study);
  std::map<std::string, std::size_t> known;
  std::map<std::vector<double>, std::size_t> kinds;
  for (std::size_t p = 0; p < plan.points.size(); ++p)
    for (const std::int64_t packing : study.packings)
      for (const std::int64_t bond_seed : study.bond_seeds) {
        Recipe recipe = recipe_at(study, plan.points[p], packing, bond_seed);
        recipe.test.n_snapshots = recipe.test.n_frames = 0;  // the store keeps no pictures
        const std::vector<Recipe> singles = single_recipes(recipe);
        for (std::size_t place = 0; place < singles.size(); ++place) {
          const std::string key = specimen_key(singles[place]);
          const auto [it, is_new] = known.emplace(key, plan.tests.size());
          if (is_new)
            plan.tests.push_back(
                {key, singles[place], expected_cost(singles[place]), 0, kind_of(kinds, singles[place])});
          plan.runs.push_back({p, packing, bond_seed, place, it->second});
        }
      }
  make_batches(plan, shard);
  return plan;
}

}  // namespace phy
