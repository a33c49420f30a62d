#include "study/scheduler.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "base/check.hpp"

namespace phy {
namespace {

/// What the workers of run_tests share.
struct Desk {
  const std::vector<std::shared_ptr<const Specimen>>& specimens;
  std::shared_ptr<const Recipe> recipe;
  const ScheduleHooks& hooks;
  std::vector<TestResult> results;
  std::mutex mutex;
  std::size_t n_taken = 0;
  Progress progress;
  std::exception_ptr error;

  bool stopped() const { return hooks.stop != nullptr && hooks.stop->load(); }
  std::optional<Job> next() {
    const std::lock_guard lock(mutex);
    if (stopped() || error || n_taken == specimens.size()) return std::nullopt;
    const std::size_t i = n_taken++;
    return Job{specimens[i], recipe, i};
  }
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
  void work(const CrewOptions& options, CrewExchange& exchange) {
    const LaneHooks lanes = for_lanes();
    auto crew = std::make_unique<Crew>(specimens.front()->packing, options);
    for (crew->fill(lanes); crew; crew = exchange.wait()) run_crew(std::move(crew), lanes, exchange);
  }
  LaneHooks for_lanes() {
    return {
        [this] { return next(); }, [this](std::size_t i, TestResult result) { done(i, std::move(result)); },
        [this](double steps, std::size_t) { block(steps); }, [this] { return stopped(); },
        hooks.on_reading ? [this](std::size_t i, double strain, double stress) { reading(i, strain, stress); }
                         : std::function<void(std::size_t, double, double)>()};
  }
};

}  // namespace

int lanes_for(std::size_t n_specimens, Precision precision, const MachineOptions& machine) {
  const bool single = precision == Precision::single_precision;
  if (machine.lanes > 0) return machine.lanes;
  const int widest = single ? native_lanes<float>(machine.isa) : native_lanes<double>(machine.isa);
  const auto threads = static_cast<std::size_t>(machine.threads);
  return fitting_lanes((n_specimens + threads - 1) / threads, precision, widest);
}

CrewOptions crew_options(std::size_t n_specimens, const Recipe& recipe, const MachineOptions& machine) {
  GroupOptions group;
  group.isa = machine.isa;
  group.precision = recipe.engine.precision;
  group.lanes = lanes_for(n_specimens, recipe.engine.precision, machine);
  group.skew = machine.skew;
  group.interval = static_cast<int>(recipe.test.history_interval);
  return {group, machine.lanes > 0};
}

std::vector<TestResult> run_tests(const std::vector<std::shared_ptr<const Specimen>>& specimens,
                                  const Recipe& recipe, const MachineOptions& machine,
                                  const ScheduleHooks& hooks) {
  PHY_CHECK(machine.threads > 0, "at least one worker");
  const std::shared_ptr<const Recipe> borrowed(std::shared_ptr<const Recipe>(), &recipe);
  Desk desk{specimens, borrowed, hooks, std::vector<TestResult>(specimens.size()), {}, 0, {}, nullptr};
  if (specimens.empty()) return {};
  for (std::size_t i = 0; i < specimens.size(); ++i) {
    desk.results[i].name = specimens[i]->name;
    desk.results[i].outcome = {Status::interrupted, "not started", "run the same recipe again"};
  }
  desk.progress.n_total = specimens.size();
  const CrewOptions options = crew_options(specimens.size(), recipe, machine);
  const int n_workers = std::min(machine.threads, static_cast<int>(specimens.size()));
  CrewExchange exchange(n_workers);
  {
    std::vector<std::jthread> workers;
    for (int i = 0; i < n_workers; ++i)
      workers.emplace_back([&desk, &options, &exchange] {
        try {
          desk.work(options, exchange);
        } catch (...) {
          const std::lock_guard lock(desk.mutex);
          if (!desk.error) desk.error = std::current_exception();
        }
        exchange.leave();
      });
  }
  if (desk.error) std::rethrow_exception(desk.error);
  return std::move(desk.results);
}

}  // namespace phy
