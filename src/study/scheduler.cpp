#include "study/scheduler.hpp"

#include <algorithm>
#include <deque>
#include <mutex>
#include <numeric>
#include <optional>

#include "base/check.hpp"
#include "base/parallel.hpp"
#include "lab/tests.hpp"
#include "study/chunks.hpp"
#include "study/expected.hpp"
#include "study/lane_batch.hpp"

namespace phy::study {
namespace {

/// What the workers of run_tests share.
struct SharedTests {
  const std::vector<std::shared_ptr<const Specimen>>& specimens;
  std::shared_ptr<const Recipe> recipe;
  const ScheduleHooks& hooks;
  std::vector<TestResult> results;
  std::deque<std::size_t> waiting;  // in no worker's first chunk
  std::mutex mutex;
  Progress progress;
  std::atomic<bool> broken{false};  // a worker has failed

  // A failure in one worker ends the others at their next block.
  bool stopped() const { return broken || (hooks.stop != nullptr && hooks.stop->load()); }
  /// The next test of the worker's own chunk, then of all tests that are still waiting.
  std::optional<Job> next(std::deque<std::size_t>& chunk) {
    const std::lock_guard lock(mutex);
    std::deque<std::size_t>& from = chunk.empty() ? waiting : chunk;
    // Looked at under the lock also when the run is ending: a test is given to one worker only.
    if (stopped() || from.empty()) return std::nullopt;
    const std::size_t i = from.front();
    from.pop_front();
    return Job{specimens[i], recipe, i};
  }
  /// Results arrive in any order; each has its place, so that the order of the output is that of the input.
  void done(std::size_t index, TestResult result) {
    const std::lock_guard lock(mutex);
    results[index] = std::move(result);
    ++progress.n_done;
    if (hooks.on_result) hooks.on_result(index, results[index]);
  }
  void block(double steps) {
    const std::lock_guard lock(mutex);
    progress.steps_done += steps;
    if (hooks.on_progress) hooks.on_progress(progress);
  }
  void reading(std::size_t index, double strain, double stress) {
    const std::lock_guard lock(mutex);
    hooks.on_reading(index, strain, stress);
  }
  void work(std::deque<std::size_t>& chunk, const LaneBatchOptions& options, LaneBatchExchange& exchange) {
    // A worker runs its own lane batch to the end and then takes over parts of others', until none is left.
    const LaneHooks hooks_of_lanes = for_lanes(chunk);
    auto lane_batch = std::make_unique<LaneBatch>(specimens.front()->packing, options);
    for (lane_batch->fill(hooks_of_lanes); lane_batch; lane_batch = exchange.wait())
      run_lane_batch(std::move(lane_batch), hooks_of_lanes, exchange);
  }
  /// The hooks of a lane batch, with these tests behind them. Without a listener no reading is passed on,
  /// which saves the lock in every block.
  LaneHooks for_lanes(std::deque<std::size_t>& chunk) {
    return {[this, &chunk] { return next(chunk); },
            [this](std::size_t i, TestResult result) { done(i, std::move(result)); },
            [this](const LaneUse& use, std::size_t) { block(use.test_steps); }, [this] { return stopped(); },
            hooks.on_reading
                ? [this](std::size_t i, double strain, double stress) { reading(i, strain, stress); }
                : std::function<void(std::size_t, double, double)>()};
  }
};

/// What a specimen is expected to cost: a recipe of several angles has to be reduced to this one.
double cost_of(const Specimen& specimen, const Recipe& recipe) {
  Recipe single = recipe;
  single.matrix = specimen.matrix;
  single.bedding = specimen.bedding;
  return expected_cost(single);
}

/// Places in `cost`.
std::vector<std::size_t> longest_first(const std::vector<double>& cost) {
  std::vector<std::size_t> order(cost.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Stable: tests of equal cost stay in the order of the input, and so does the log.
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cost[a] > cost[b]; });
  return order;
}

}  // namespace

std::vector<TestResult> run_tests(const std::vector<std::shared_ptr<const Specimen>>& specimens,
                                  const Recipe& recipe, const MachineOptions& machine,
                                  const ScheduleHooks& hooks) {
  PHY_CHECK(machine.threads > 0, "at least one worker");
  // The recipe outlives the run: shared without ownership, not copied per test.
  const std::shared_ptr<const Recipe> borrowed(std::shared_ptr<const Recipe>(), &recipe);
  SharedTests shared{specimens, borrowed, hooks, std::vector<TestResult>(specimens.size()), {}, {}, {}, {}};
  if (specimens.empty()) return {};
  std::vector<double> cost;
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    shared.results[i] = lab::blank_result(*specimens[i], recipe.test.kind);
    // So that a run that is stopped before a test has begun reports that, not an empty result.
    shared.results[i].outcome = {Status::interrupted, "not started", "run the same recipe again"};
    cost.push_back(cost_of(*specimens[i], recipe));
  }
  shared.progress.n_total = specimens.size();
  for (const std::size_t i : longest_first(cost)) shared.waiting.push_back(i);
  std::sort(cost.begin(), cost.end(), std::greater<>());
  // Each worker starts with a chunk of its own; what is in no chunk is taken one by one as lanes fall free.
  const double layers = layers_of(*specimens.front());
  const bool alike =
      std::all_of(specimens.begin(), specimens.end(), [&](const auto& s) { return layers_of(*s) == layers; });
  const LaneBatchOptions widest = lane_batch_options(specimens.size(), alike, recipe, machine);
  std::vector<std::deque<std::size_t>> chunks;
  for (const std::size_t n : first_chunks(cost, alike, static_cast<std::size_t>(machine.threads), widest)) {
    const auto end = shared.waiting.begin() + static_cast<std::ptrdiff_t>(n);
    chunks.emplace_back(shared.waiting.begin(), end);
    shared.waiting.erase(shared.waiting.begin(), end);
  }
  LaneBatchExchange exchange(static_cast<int>(chunks.size()));
  on_threads(
      chunks.size(), shared.broken,
      [&](std::size_t i) {
        shared.work(chunks[i], lane_batch_options(chunks[i].size(), alike, recipe, machine), exchange);
      },
      [&] { exchange.leave(); });
  return std::move(shared.results);
}

}  // namespace phy::study
