#include "calibrate/simulator.hpp"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "analysis/analyse.hpp"
#include "analysis/failure_plane.hpp"
#include "base/check.hpp"
#include "base/clock.hpp"
#include "base/parallel.hpp"
#include "genesis/cache.hpp"
#include "genesis/settle.hpp"
#include "records/test_description.hpp"
#include "statics/uniaxial.hpp"
#include "study/effects.hpp"
#include "study/expected.hpp"
#include "study/experiment.hpp"
#include "study/store_queue.hpp"
#include "system/files.hpp"

namespace phy::calibrate {
namespace {

constexpr double statics_tolerance = 1e-4;  // of E, of nu: a hundredth of what packings differ by

std::string packing_name(const Recipe& r) {
  return r.packing.file + genesis::packing_key(r.specimen, r.packing, r.matrix);
}

/// The file of a store that nobody asked to keep.
class TemporaryFile {
 public:
  TemporaryFile() {
    const std::string name = (std::filesystem::temp_directory_path() / "phyllite").string();
    const auto made = system::passing_folder(name);
    if (!made) throw IoError("no temporary folder " + name);
    folder_ = *made;
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  std::string path() const { return (folder_ / "runs.sqlite").string(); }

 private:
  std::filesystem::path folder_;
};

class OwnSimulator : public Simulator {
 public:
  explicit OwnSimulator(SimulatorOptions options) : options_(std::move(options)) {
    if (!options_.store.empty()) store_ = std::make_unique<study::Store>(options_.store);
  }

  int threads() const override { return options_.threads; }

 private:
  std::vector<ElasticResult> solve(const std::vector<Recipe>& recipes, Statics what) override {
    load_packings(recipes);
    std::vector<Specimen> specimens(recipes.size());
    for_all(recipes.size(), options_.threads, [&] {
      return [&](std::size_t i) {
        specimens[i] = *study::specimen_of(packings_.at(packing_name(recipes[i])), recipes[i]);
      };
    });
    statics::ElasticOptions how;
    how.bilateral = what != Statics::one_sided;
    how.sensitivities = what == Statics::with_rates;
    how.tolerance = statics_tolerance;
    how.stop = options_.stop;
    return statics::solve_all(specimens, how, options_.threads);
  }

  std::vector<TestResult> run(const std::vector<Recipe>& recipes) override {
    const study::Plan plan = study::plan_of(recipes);
    if (options_.sink != nullptr)
      for (const study::PlannedTest& t : plan.tests)
        // The store would answer with numbers, and the pictures would never be made.
        if (keeps_pictures(t.recipe) && !options_.sink->holds(t.recipe)) store().remove(t.key);
    run_plan(plan);
    std::vector<std::string> keys;
    for (const study::Run& r : plan.runs) keys.push_back(plan.tests[r.test].key);
    study::StudyRows rows = store().rows(keys);
    if (options_.with_untrusted) rows = study::with_untrusted(std::move(rows));
    std::vector<TestResult> results(recipes.size());
    for (std::size_t i = 0; i < rows.size(); ++i)  // none where the user stopped
      if (rows[i]) {
        results[i] = rows[i]->result;
        results[i].kind = recipes[i].test.kind;  // the store does not say it
        add_failure(results[i], recipes[i], keys[i]);
      }
    return results;
  }

  /// How it failed, of a test that a version stored which did not read it yet: from its cracks.
  void add_failure(TestResult& result, const Recipe& recipe, const std::string& key) {
    if (analysis::find(result.numbers, "failure_angle") != nullptr) return;
    analysis::add(result.numbers, analysis::failure_numbers(store().find(key)->result.cracks,
                                                            grain_size(recipe), !recipe.bedding.empty()));
  }

  bool stopped() const override { return options_.stop != nullptr && options_.stop->load(); }

  SimulatorOptions options_;
  std::unique_ptr<TemporaryFile> temporary_;
  std::unique_ptr<study::Store> store_;
  std::map<std::string, std::shared_ptr<const Packing>> packings_;

  study::Store& store() {
    if (!store_) {
      temporary_ = std::make_unique<TemporaryFile>();
      store_ = std::make_unique<study::Store>(temporary_->path());
    }
    return *store_;
  }

  void load_packings(const std::vector<Recipe>& recipes) {
    std::map<std::string, const Recipe*> missing;
    for (const Recipe& r : recipes)
      if (const std::string name = packing_name(r); !packings_.contains(name)) missing[name] = &r;
    const std::vector<std::pair<std::string, const Recipe*>> list(missing.begin(), missing.end());
    std::vector<std::shared_ptr<const Packing>> made(list.size());
    try {
      for_all(list.size(), options_.threads, [&] {
        return [&](std::size_t i) {
          made[i] = study::packing_of(*list[i].second, [this] { return stopped(); });
        };
      });
    } catch (const genesis::Interrupted&) {
      throw Stopped{};
    }
    // The map is written by one thread, after all are made.
    for (std::size_t i = 0; i < list.size(); ++i) packings_[list[i].first] = made[i];
  }

  void run_plan(const study::Plan& plan) {
    study::Hooks hooks;
    hooks.stop = options_.stop;
    const auto start = std::chrono::steady_clock::now();
    if (options_.on_progress)
      hooks.on_progress = [&](const study::Progress& p) {
        options_.on_progress({p.n_done, p.n_total, p.n_new, p.seconds_left(seconds_since(start))});
      };
    if (options_.on_reading)
      hooks.on_reading = [&](std::size_t, const RunningTest& now) { options_.on_reading(now); };
    if (options_.sink != nullptr)
      hooks.on_result = [&](std::size_t test, const TestResult& result) {
        const Recipe& recipe = plan.tests[test].recipe;
        if (!keeps_pictures(recipe) || result.n_grains == 0) return;  // 0: no specimen could be made
        const auto known = packings_.find(packing_name(recipe));
        const auto packing = known != packings_.end() ? known->second : study::packing_of(recipe);
        options_.sink->add(*study::specimen_of(packing, recipe), recipe, result);
      };
    study::StoreQueue queue(plan, store(), hooks, study::n_workers(options_.ranks, options_.threads));
    study::MachineOptions machine;
    machine.threads = options_.threads, machine.isa = engine::native_isa();
    const study::WorkReport report = study::work_as_host(options_.ranks, queue, plan, machine);
    if (options_.on_work) options_.on_work(report);
  }
};

/// Does a test answer a strength in compression? Its curve may show another stress than that strength.
bool is_compression(const TestDescription& test) {
  const auto all = measured_properties();
  return std::any_of(all.begin(), all.end(), [&](const MeasuredProperty& p) {
    return p.test != nullptr && std::string_view(p.test) == test.name && is_compressive(p.property);
  });
}

}  // namespace

std::vector<ElasticResult> Simulator::elastic(const std::vector<Recipe>& recipes, Statics what) {
  std::vector<ElasticResult> results = solve(recipes, what);
  if (stopped()) throw Stopped{};
  count_.solutions += std::ssize(recipes);
  return results;
}

std::vector<TestResult> Simulator::test(const std::vector<Recipe>& recipes, Grains grains) {
  std::vector<TestResult> results = run(recipes);
  // Of a batch that was stopped some answers are empty; none may be learnt from.
  if (stopped()) throw Stopped{};
  std::set<std::string> counted;
  for (const Recipe& r : recipes) {
    if (!counted.insert(study::specimen_key(r)).second) continue;
    // Also what a store has answered: a calibration that goes on after a stop must decide as if it had run
    // them.
    ++count_.tests;
    count_.tension += is_compression(*r.test.kind) ? 0 : 1;
    count_.coarse += grains == Grains::coarse ? 1 : 0;
  }
  return results;
}

bool keeps_pictures(const Recipe& recipe) { return recipe.test.n_snapshots > 0 || recipe.test.n_frames > 0; }

std::unique_ptr<Simulator> make_simulator(SimulatorOptions options) {
  return std::make_unique<OwnSimulator>(std::move(options));
}

}  // namespace phy::calibrate
