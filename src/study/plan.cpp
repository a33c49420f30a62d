#include "study/plan.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "genesis/cache.hpp"
#include "lab/rigs.hpp"
#include "study/expected.hpp"
#include "study/experiment.hpp"

namespace phy {
namespace {

std::size_t kind_of(std::map<std::vector<double>, std::size_t>& kinds, const Recipe& single) {
  std::vector<double> angles;
  for (const BeddingRecipe& set : single.bedding) angles.push_back(set.theta);
  return kinds.try_emplace(angles, kinds.size()).first->second;
}

using BatchName =
    std::tuple<std::string, std::string, std::string, StiffnessConvention, Precision, std::int64_t>;

BatchName batch_name(const Recipe& r) {
  return {r.packing.file,     packing_key(r.specimen, r.packing, r.matrix),
          rig_name(r),        r.matrix.stiffness_convention,
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
