#include "study/plan.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "engine/kernels.hpp"
#include "genesis/cache.hpp"
#include "genesis/cut.hpp"
#include "lab/tests.hpp"
#include "study/direct.hpp"
#include "study/expected.hpp"
#include "study/experiment.hpp"

namespace phy::study {
namespace {

/// Numbers sets of angles in the order of their appearance.
class Groups {
 public:
  template <class RecipeOrSpecimen>
  std::size_t of(const RecipeOrSpecimen& rock) {
    std::vector<double> angles;
    if (rock.matrix.directional()) angles.push_back(rock.matrix.foliation);
    for (const BeddingRecipe& set : rock.bedding) angles.push_back(set.theta);
    return numbers_.try_emplace(angles, numbers_.size()).first->second;
  }

 private:
  std::map<std::vector<double>, std::size_t> numbers_;
};

// Whatever the lanes of one group have to share (engine/lane_group.hpp): packing, boundary, contact models
// and geometry, precision, masses of the grains and block.
using BatchName =
    std::tuple<std::string, std::string, std::string, std::string, const engine::ContactPhysics*,
               StiffnessConvention, std::int64_t, Precision, GrainInertia, std::int64_t>;

BatchName batch_name(const Recipe& r) {
  return {r.packing.file,
          genesis::packing_key(r.specimen, r.packing, r.matrix),
          genesis::opening_name(r),
          lab::boundary_name(r),
          &engine::physics_of(r.matrix, r.bedding),
          r.matrix.stiffness_convention,
          r.matrix.elements,
          r.engine.precision,
          r.engine.grain_inertia,
          r.test.history_interval};
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
    // A long test that begins last would keep one core busy while all others wait.
    std::stable_sort(batch.tests.begin(), batch.tests.end(),
                     [&](std::size_t a, std::size_t b) { return plan.tests[a].cost > plan.tests[b].cost; });
    // Deals after sorting: every shard gets long and short tests alike.
    std::erase_if(batch.tests, [&](std::size_t) {
      return dealt++ % static_cast<std::size_t>(shard.n) != static_cast<std::size_t>(shard.i - 1);
    });
  }
}

/// Tests of different specimens; a run of each specimen.
class PlanMaker {
 public:
  explicit PlanMaker(Plan& plan) : plan_(plan) {}
  void add(Recipe single, Run run) {
    const bool direct = plan_.study.solver == Solver::direct;
    // Test, engine and bond seed do not matter to a direct solution: at their defaults, more runs share a
    // result.
    if (direct) single = elastic_recipe(std::move(single));
    // The two solvers must not find each other's results in a store.
    const std::string key = (direct ? "direct-" : "") + specimen_key(single);
    const auto [it, is_new] = known_.emplace(key, plan_.tests.size());
    run.test = it->second;
    plan_.runs.push_back(run);
    if (!is_new) return;
    const double cost = direct ? expected_direct_cost(single) : expected_cost(single);
    const std::size_t group = groups_.of(single);
    plan_.tests.push_back({key, std::move(single), cost, 0, group});
  }

 private:
  Plan& plan_;
  std::map<std::string, std::size_t> known_;
  Groups groups_;
};

}  // namespace

Plan plan_of(const std::vector<Recipe>& singles, Solver solver) {
  Plan plan;
  plan.study.solver = solver;
  PlanMaker maker(plan);
  for (std::size_t i = 0; i < singles.size(); ++i)
    // No study around them: point 0, the seeds of the recipe.
    maker.add(singles[i], {0, singles[i].packing.seed, singles[i].matrix.bond_seed, i});
  make_batches(plan, {});
  return plan;
}

Plan plan_of(const std::vector<std::shared_ptr<const Specimen>>& specimens,
             const std::vector<Recipe>& recipes) {
  Plan plan;
  Groups groups;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    const Specimen& s = *specimens[i];
    // What this one is expected to cost: the recipe of a run may be of several angles.
    Recipe single = recipes[i];
    single.matrix = s.matrix, single.bedding = s.bedding;
    plan.tests.push_back({"", recipes[i], expected_cost(single), 0, groups.of(s), specimens[i]});
  }
  make_batches(plan, {});
  return plan;
}

Plan make_plan(const Study& study, const Shard& shard) {
  Plan plan;
  plan.study = study;
  plan.points = points_of(study);
  PlanMaker maker(plan);
  for (std::size_t p = 0; p < plan.points.size(); ++p)
    for (const std::int64_t packing : study.packings)
      for (const std::int64_t bond_seed : study.bond_seeds) {
        std::size_t place = 0;
        for (Recipe& single : specimens_of(study, recipe_at(study, plan.points[p], packing, bond_seed))) {
          single.test.n_snapshots = single.test.n_frames = 0;  // the store keeps no pictures
          maker.add(std::move(single), {p, packing, bond_seed, place++});
        }
      }
  make_batches(plan, shard);
  return plan;
}

}  // namespace phy::study
