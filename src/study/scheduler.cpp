#include "study/scheduler.hpp"

#include <ctime>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

#include "base/check.hpp"
#include "lab/lab_test.hpp"

namespace phy {

double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

namespace {

/// A test in a lane.
struct Seat {
  Job job;
  std::unique_ptr<LabTest> test;  // refers to the job's recipe
  double seconds = 0.0;
};

void take_seat(Job job, LaneGroup& group, Seat& seat, int lane) {
  seat.test.reset();
  seat.job = std::move(job);
  seat.seconds = 0.0;
  seat.test = make_test(seat.job.specimen, *seat.job.recipe, group, lane);
}

void fill_seat(const LaneHooks& hooks, LaneGroup& group, Seat& seat, int lane) {
  if (std::optional<Job> job = hooks.next()) return take_seat(std::move(*job), group, seat, lane);
  seat.test.reset();
  group.clear(lane);
}

void close_seat(const LaneHooks& hooks, Seat& seat) {
  TestResult result = seat.test->take_result();
  result.seconds = seat.seconds;
  hooks.done(seat.job.index, std::move(result));
}

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
  LaneHooks for_lanes() {
    return {
        [this] { return next(); }, [this](std::size_t i, TestResult result) { done(i, std::move(result)); },
        [this](double steps, double) { block(steps); }, [this] { return stopped(); },
        hooks.on_reading ? [this](std::size_t i, double strain, double stress) { reading(i, strain, stress); }
                         : std::function<void(std::size_t, double, double)>()};
  }
};

}  // namespace

void run_lanes(const GroupOptions& options, const LaneHooks& hooks) {
  std::optional<Job> first = hooks.next();
  if (!first) return;
  const std::unique_ptr<LaneGroup> group = make_group(first->specimen->packing, options);
  std::vector<Seat> seats(static_cast<std::size_t>(options.lanes));
  const auto each = [&](auto&& action) {
    for (int lane = 0; lane < options.lanes; ++lane) action(seats[static_cast<std::size_t>(lane)], lane);
  };
  take_seat(std::move(*first), *group, seats.front(), 0);
  each([&](Seat& seat, int lane) {
    if (lane > 0) fill_seat(hooks, *group, seat, lane);
  });
  for (;;) {
    int busy = 0;
    for (const Seat& seat : seats) busy += seat.test ? 1 : 0;
    if (busy == 0) return;
    const double before = thread_seconds();
    group->advance();
    const double seconds = thread_seconds() - before;
    hooks.block(static_cast<double>(busy) * options.interval, seconds);
    each([&](Seat& seat, int lane) {
      if (!seat.test) return;
      seat.seconds += seconds / busy;
      bool over = seat.test->after_block();
      if (const LabTest::Reading r = seat.test->latest(); hooks.reading)
        hooks.reading(seat.job.index, r.strain, r.stress);
      if (!over && hooks.stopped()) seat.test->interrupt(), over = true;
      if (!over) return;
      close_seat(hooks, seat);
      fill_seat(hooks, *group, seat, lane);
    });
  }
}

int lanes_for(std::size_t n_specimens, Precision precision, const MachineOptions& machine) {
  const bool single = precision == Precision::single_precision;
  if (machine.lanes > 0) return machine.lanes;
  const int widest = single ? native_lanes<float>(machine.isa) : native_lanes<double>(machine.isa);
  const auto per_thread = static_cast<int>((n_specimens + static_cast<std::size_t>(machine.threads) - 1) /
                                           static_cast<std::size_t>(machine.threads));
  int lanes = single ? 4 : 1;
  while (lanes < per_thread && lanes < widest) lanes *= 2;
  return lanes;
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
  GroupOptions options;
  options.isa = machine.isa;
  options.precision = recipe.engine.precision;
  options.lanes = lanes_for(specimens.size(), recipe.engine.precision, machine);
  options.skew = machine.skew;
  options.interval = static_cast<int>(recipe.test.history_interval);
  const std::size_t n_groups = (specimens.size() + static_cast<std::size_t>(options.lanes) - 1) /
                               static_cast<std::size_t>(options.lanes);
  {
    std::vector<std::jthread> workers;
    for (std::size_t i = 0; i < std::min(n_groups, static_cast<std::size_t>(machine.threads)); ++i)
      workers.emplace_back([&desk, &options] {
        try {
          run_lanes(options, desk.for_lanes());
        } catch (...) {
          const std::lock_guard lock(desk.mutex);
          if (!desk.error) desk.error = std::current_exception();
        }
      });
  }
  if (desk.error) std::rethrow_exception(desk.error);
  return std::move(desk.results);
}

}  // namespace phy
