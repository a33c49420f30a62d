#include "study/scheduler.hpp"

#include <algorithm>
#include <deque>
#include <mutex>
#include <numeric>
#include <optional>

#include "base/check.hpp"
#include "base/parallel.hpp"
#include "study/expected.hpp"

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

/// Until all tests are done, each alone, by workers who take the longest that waits.
double time_one_by_one(const std::vector<double>& cost, std::size_t n_workers) {
  std::vector<double> busy(n_workers, 0.0);
  for (const double c : cost) *std::min_element(busy.begin(), busy.end()) += c;
  return *std::max_element(busy.begin(), busy.end());
}

}  // namespace

LaneBatchOptions lane_batch_options(std::size_t n_specimens, bool alike, const Recipe& recipe,
                                    const MachineOptions& machine) {
  const Precision precision = recipe.engine.precision;
  engine::GroupOptions group;
  group.isa = machine.isa;
  group.precision = precision;
  // A register full of specimens is the best speed per specimen.
  group.lanes = precision == Precision::single_precision ? engine::native_lanes<float>(machine.isa)
                                                         : engine::native_lanes<double>(machine.isa);
  group.lanes = machine.lanes > 0 ? machine.lanes : fitting_lanes(n_specimens, alike, group);
  group.skew = machine.skew;
  group.interval = static_cast<int>(recipe.test.history_interval);
  group.inertia = recipe.engine.grain_inertia;
  group.contacts = &engine::physics_of(recipe.matrix, recipe.bedding);
  return {group, machine.lanes > 0};
}

std::vector<std::size_t> first_chunks(const std::vector<double>& cost, bool alike, std::size_t n_workers,
                                      const LaneBatchOptions& widest) {
  const auto most = static_cast<std::size_t>(widest.group.lanes);
  if (widest.fixed) {
    std::vector<std::size_t> chunks;
    for (std::size_t i = 0; i < cost.size() && chunks.size() < n_workers; i += chunks.back())
      chunks.push_back(std::min(most, cost.size() - i));
    return chunks;
  }
  const auto lanes = [&](std::size_t n) { return fitting_lanes(n, alike, widest.group); };
  const auto slow = [&](std::size_t n) {
    return slowness(lanes(n), alike, widest.group.precision, widest.group.isa);
  };
  // Greedy: fills chunk after chunk, longest tests first, as far as a chunk stays within `time`. Cost falls,
  // so the first test of a chunk is its longest and decides how long the chunk takes. Chunks that would be
  // done one after the other are not made: such tests wait for whoever comes first.
  const auto chunks_within = [&](double time) {
    std::vector<std::size_t> chunks;
    for (std::size_t i = 0; i < cost.size() && chunks.size() < n_workers; i += chunks.back()) {
      std::size_t n = 1;
      for (std::size_t more = 2; more <= most && i + more <= cost.size(); ++more)
        if (lanes(more) > 1 && cost[i] * slow(more) <= time) n = more;
      chunks.push_back(n);
    }
    return chunks;
  };
  std::vector<double> times;  // one of them is the answer
  for (const double c : cost)
    for (std::size_t n = 1; n <= most; n *= 2) times.push_back(c * slow(n));
  std::sort(times.begin(), times.end());
  // The least of these times within which all tests find a place. Where none suffices there are more tests
  // than lanes, and the rest waits.
  const auto fitting = std::find_if(times.begin(), times.end(), [&](double time) {
    const auto chunks = chunks_within(time);
    return std::accumulate(chunks.begin(), chunks.end(), std::size_t{0}) == cost.size();
  });
  if (fitting == times.end()) return chunks_within(times.back());
  if (time_one_by_one(cost, n_workers) <= *fitting)
    return std::vector<std::size_t>(std::min(n_workers, cost.size()), 1);
  return chunks_within(*fitting);
}

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
