#include "calibrate/simulator.hpp"

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "genesis/cache.hpp"
#include "io/toml_in.hpp"
#include "statics/uniaxial.hpp"
#include "study/experiment.hpp"
#include "study/scheduler.hpp"
#include "study/store.hpp"

namespace phy {
namespace {

/// Runs task(0) ... task(n - 1) on `threads` workers; passes on the first exception.
void in_parallel(std::size_t n, int threads, const std::function<void(std::size_t)>& task) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr error;
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < threads && static_cast<std::size_t>(i) < n; ++i)
      workers.emplace_back([&] {
        try {
          for (std::size_t k = next++; k < n; k = next++) task(k);
        } catch (...) {
          const std::lock_guard lock(mutex);
          error = std::current_exception(), next = n;
        }
      });
  }
  if (error) std::rethrow_exception(error);
}

std::string packing_name(const Recipe& r) {
  return r.packing.file + packing_key(r.specimen, r.packing, r.matrix);
}

/// Tests that may share a group of lanes: one packing, one way of testing.
std::string group_name(const Recipe& r) {
  Recipe common;
  common.test = r.test, common.engine = r.engine;
  return packing_name(r) + write_recipe(common);
}

/// A few tests side by side in the lanes of one worker.
struct Chunk {
  std::vector<std::size_t> tests;
};

class OwnSimulator : public Simulator {
 public:
  explicit OwnSimulator(SimulatorOptions options) : options_(std::move(options)) {
    if (!options_.store.empty()) store_ = std::make_unique<Store>(options_.store);
  }

  std::vector<ElasticResult> elastic(const std::vector<Recipe>& recipes, bool bilateral) override {
    load_packings(recipes);
    std::vector<Specimen> specimens(recipes.size());
    in_parallel(recipes.size(), options_.threads, [&](std::size_t i) {
      specimens[i] = *specimen_of(packings_.at(packing_name(recipes[i])), recipes[i]);
    });
    ElasticOptions how;
    how.bilateral = bilateral;
    return solve_all(specimens, how, options_.threads);
  }

  std::vector<TestResult> test(const std::vector<Recipe>& recipes) override {
    std::vector<TestResult> results(recipes.size());
    std::vector<std::string> keys(recipes.size());
    in_parallel(recipes.size(), options_.threads, [&](std::size_t i) { keys[i] = specimen_key(recipes[i]); });
    std::vector<std::size_t> open = take_known(keys, results);
    std::vector<Recipe> needed;
    for (const std::size_t i : open) needed.push_back(recipes[i]);
    load_packings(needed);
    run(recipes, keys, open, results);
    return results;
  }

  bool stopped() const override { return options_.stop != nullptr && options_.stop->load(); }

 private:
  SimulatorOptions options_;
  std::unique_ptr<Store> store_;
  std::map<std::string, std::shared_ptr<const Packing>> packings_;

  /// Fills in what the store holds; returns the numbers of the other tests.
  std::vector<std::size_t> take_known(const std::vector<std::string>& keys,
                                      std::vector<TestResult>& results) {
    std::vector<std::size_t> open;
    std::vector<std::optional<StoredResult>> rows(keys.size());
    if (store_) rows = store_->rows(keys);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (rows[i])
        results[i] = std::move(rows[i]->result);
      else
        open.push_back(i);
    }
    return open;
  }

  void load_packings(const std::vector<Recipe>& recipes) {
    std::map<std::string, const Recipe*> missing;
    for (const Recipe& r : recipes)
      if (const std::string name = packing_name(r); !packings_.contains(name)) missing[name] = &r;
    const std::vector<std::pair<std::string, const Recipe*>> list(missing.begin(), missing.end());
    std::vector<std::shared_ptr<const Packing>> made(list.size());
    in_parallel(list.size(), options_.threads, [&](std::size_t i) { made[i] = packing_of(*list[i].second); });
    for (std::size_t i = 0; i < list.size(); ++i) packings_[list[i].first] = made[i];
  }

  /// Groups cut into pieces that fill the lanes of a worker, or smaller ones where workers would be idle.
  std::vector<Chunk> chunks(const std::vector<Recipe>& recipes, const std::vector<std::size_t>& open) const {
    std::map<std::string, std::vector<std::size_t>> groups;
    for (const std::size_t i : open) groups[group_name(recipes[i])].push_back(i);
    const bool single = recipes[open.front()].engine.precision == Precision::single_precision;
    const int widest = single ? native_lanes<float>(native_isa()) : native_lanes<double>(native_isa());
    const std::size_t fair = (open.size() + static_cast<std::size_t>(options_.threads) - 1) /
                             static_cast<std::size_t>(options_.threads);
    const std::size_t most = std::clamp<std::size_t>(fair, single ? 4 : 1, static_cast<std::size_t>(widest));
    std::vector<Chunk> list;
    for (const auto& [name, tests] : groups)
      for (std::size_t at = 0; at < tests.size(); at += most)
        list.push_back({{tests.begin() + static_cast<std::ptrdiff_t>(at),
                         tests.begin() + static_cast<std::ptrdiff_t>(std::min(at + most, tests.size()))}});
    std::stable_sort(list.begin(), list.end(),
                     [](const Chunk& a, const Chunk& b) { return a.tests.size() > b.tests.size(); });
    return list;
  }

  void run(const std::vector<Recipe>& recipes, const std::vector<std::string>& keys,
           const std::vector<std::size_t>& open, std::vector<TestResult>& results) {
    for (const std::size_t i : open) results[i].outcome.status = Status::interrupted;
    if (open.empty()) return;
    const std::vector<Chunk> list = chunks(recipes, open);
    std::mutex mutex;
    std::size_t done = recipes.size() - open.size();
    if (options_.on_progress) options_.on_progress(done, recipes.size());
    in_parallel(list.size(), options_.threads, [&](std::size_t c) {
      const std::vector<std::size_t>& tests = list[c].tests;
      const Recipe& first = recipes[tests.front()];
      std::vector<std::shared_ptr<const Specimen>> specimens;
      for (const std::size_t i : tests)
        specimens.push_back(specimen_of(packings_.at(packing_name(recipes[i])), recipes[i]));
      MachineOptions machine;
      machine.isa = native_isa();
      ScheduleHooks hooks;
      hooks.stop = options_.stop;
      hooks.on_result = [&](std::size_t k, const TestResult& result) {
        if (result.outcome.status == Status::interrupted) return;
        const std::size_t i = tests[k];
        if (store_) store_->put(keys[i], write_recipe(recipes[i]), result);
        const std::lock_guard lock(mutex);
        ++done;
        if (options_.on_progress) options_.on_progress(done, recipes.size());
      };
      std::vector<TestResult> some = run_tests(specimens, first, machine, hooks);
      for (std::size_t k = 0; k < tests.size(); ++k) results[tests[k]] = std::move(some[k]);
    });
  }
};

}  // namespace

std::unique_ptr<Simulator> make_simulator(SimulatorOptions options) {
  return std::make_unique<OwnSimulator>(std::move(options));
}

}  // namespace phy
