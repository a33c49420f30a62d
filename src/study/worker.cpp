#include "study/worker.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "base/clock.hpp"
#include "base/parallel.hpp"
#include "engine/kernels.hpp"
#include "genesis/cut.hpp"
#include "genesis/settle.hpp"
#include "lab/load_path.hpp"
#include "lab/tests.hpp"
#include "records/test_description.hpp"
#include "study/direct.hpp"
#include "study/experiment.hpp"
#include "study/lane_batch.hpp"
#include "system/process.hpp"

namespace phy::study {
namespace {

constexpr auto patience = std::chrono::milliseconds(300);  // between looks at what runs elsewhere

/// The result of a specimen that cannot be generated, so that the study stores why and does not try again.
TestResult not_made(const PlannedTest& test, const std::string& reason) {
  TestResult r;
  r.intact = !layered(test.recipe);
  r.theta = r.intact ? 0.0 : inclination(test.recipe);
  r.name = "specimen not made";
  r.outcome = {Status::not_settled, reason, "change the packing or the bedding of this point"};
  r.hash = phy::hash_of(r);
  return r;
}

/// A lane batch for so many specimens of the recipe; `alike`: their layers have the same inclination.
LaneBatchOptions lane_batch_options(std::size_t n_specimens, bool alike, const Recipe& recipe,
                                    const MachineOptions& machine) {
  engine::GroupOptions group;
  group.isa = machine.isa;
  group.precision = recipe.engine.precision;
  // A register full of specimens is the best speed per specimen.
  group.lanes = engine::native_lanes(group.precision, machine.isa);
  group.lanes = machine.lanes > 0 ? machine.lanes : fitting_lanes(n_specimens, alike, group);
  group.skew = machine.skew;
  group.interval = static_cast<int>(recipe.test.history_interval);
  group.inertia = recipe.engine.grain_inertia;
  group.contacts = &engine::physics_of(recipe.matrix, recipe.bedding);
  return {group, machine.lanes > 0};
}

/// One worker thread.
class Worker {
 public:
  Worker(TaskQueue& queue, const Plan& plan, const MachineOptions& machine, LaneBatchExchange& exchange,
         const std::atomic<bool>& broken)
      : queue_(queue), plan_(plan), machine_(machine), exchange_(exchange), broken_(broken) {}

  const LaneUse& use() const { return use_; }

  void run() {
    // The queue may have nothing for now (other processes run the rest): then a lane batch of another
    // worker is waited for, but not for long, as claims elsewhere may lapse.
    while (!stopped()) {
      const Assignment a = queue_.enter();
      if (a.kind == Assignment::Kind::work) {
        run_batch(a);
        queue_.leave(a.batch, last_);
        continue;
      }
      const bool finished = a.kind == Assignment::Kind::finished;
      std::unique_ptr<LaneBatch> lane_batch = finished ? exchange_.wait() : exchange_.wait_for(patience);
      if (lane_batch)
        // Such a batch belongs to another worker, which alone takes new tests for it: no `next`.
        run_lane_batch(std::move(lane_batch), hooks([] { return std::optional<Job>(); }), exchange_);
      else if (finished)
        return;
    }
  }

 private:
  TaskQueue& queue_;
  const Plan& plan_;
  const MachineOptions& machine_;
  LaneBatchExchange& exchange_;
  const std::atomic<bool>& broken_;  // another worker has failed
  std::shared_ptr<const Packing> packing_;
  std::optional<std::size_t> last_;  // of this batch
  statics::UniaxialStatics statics_;
  LaneUse use_;

  bool stopped() { return broken_.load() || queue_.stopped(); }

  void run_batch(const Assignment& a) {
    const std::vector<std::size_t>& tests = plan_.batches[a.batch].tests;
    const PlannedTest& any = plan_.tests[tests.front()];
    last_.reset();
    if (!any.specimen && !make_packing(a.batch, any.recipe)) return;
    if (plan_.study.solver == Solver::direct) return solve_batch(a.batch);
    const bool alike = std::all_of(tests.begin(), tests.end(),
                                   [&](std::size_t t) { return plan_.tests[t].group == any.group; });
    // All tests of a batch have the grains in common that are cut from the packing (genesis/cut.hpp).
    auto lane_batch = std::make_unique<LaneBatch>(
        any.specimen ? any.specimen->packing : genesis::shaped(packing_, any.recipe),
        lane_batch_options(a.n_tests, alike, any.recipe, machine_));
    // No more than its share to begin with: where there are fewer tests than lanes of all workers, full lanes
    // here would leave others without a test.
    std::size_t share = a.n_tests;
    lane_batch->fill(hooks([&] { return share-- > 0 ? next(a.batch) : std::nullopt; }));
    run_lane_batch(std::move(lane_batch), hooks([&] { return next(a.batch); }), exchange_);
  }
  /// False: there is none.
  bool make_packing(std::size_t batch, const Recipe& recipe) {
    try {
      packing_ = packing_of(recipe, [this] { return stopped(); });
      return true;
    } catch (const genesis::Interrupted&) {
      return false;
    } catch (const InputError& e) {
      // Without a packing none of the tests of this batch can run. Each is claimed and answered one by one:
      // some of them may run in other processes, which will find out for themselves.
      while (const auto test = queue_.take(batch, last_)) {
        last_ = test;
        queue_.deliver(*test, not_made(plan_.tests[*test], e.what()));
      }
      return false;
    }
  }
  void solve_batch(std::size_t batch) {
    // One after the other: a solution has no lanes, and threads share nothing but the queue.
    while (const std::optional<Job> job = next(batch)) {
      queue_.deliver(job->index, solve_directly(*job->specimen, statics_));
      queue_.count(plan_.tests[job->index].cost);
    }
  }
  LaneHooks hooks(std::function<std::optional<Job>()> next_job) {
    return {std::move(next_job),
            [this](std::size_t test, TestResult result) { queue_.deliver(test, std::move(result)); },
            [this](const LaneUse& use, std::size_t n_grains) {
              use_.add(use);
              queue_.count(use.test_steps * static_cast<double>(n_grains));
            },
            [this] { return stopped(); },
            [this](std::size_t test, const RunningTest& now) { queue_.read(test, now); }};
  }
  std::optional<Job> next(std::size_t batch) {
    while (!stopped()) {
      const auto test = queue_.take(batch, last_);
      if (!test) return {};
      last_ = test;
      const PlannedTest& planned = plan_.tests[*test];
      // A recipe lives in the plan, so it is not owned here.
      const std::shared_ptr<const Recipe> recipe(std::shared_ptr<const Recipe>(), &planned.recipe);
      if (planned.specimen) return Job{planned.specimen, recipe, *test};
      // The specimen is made where it will run, just before it does: making all of them first would fill the
      // memory and idle the lanes.
      try {
        Job job{specimen_of(packing_, planned.recipe), recipe, *test};
        lab::check_load_path(*job.specimen, planned.recipe);
        return job;
      } catch (const InputError& e) {
        queue_.deliver(*test, not_made(planned, e.what()));
      }
    }
    return {};
  }
};

/// So that a run that is stopped before a test has begun reports that, not an empty result.
TestResult not_started(const Specimen& specimen, TestKind kind) {
  TestResult r = lab::blank_result(specimen, kind);
  r.outcome = {Status::interrupted, "not started", "run the same recipe again"};
  return r;
}

}  // namespace

WorkReport work_at(TaskQueue& queue, const Plan& plan, const MachineOptions& machine) {
  PHY_CHECK(machine.threads > 0, "at least one worker");
  const auto start = std::chrono::steady_clock::now();
  std::mutex mutex;
  std::atomic<bool> broken{false};
  const int n_threads = has_threads() ? machine.threads : 1;  // workers wait for each other
  LaneBatchExchange exchange(n_threads);
  WorkReport report;
  on_threads(
      static_cast<std::size_t>(n_threads), broken,
      [&](std::size_t) {
        // Each thread adds its own time, since the clock of a thread is gone with it.
        const double before = system::thread_seconds();
        Worker worker(queue, plan, machine, exchange, broken);
        worker.run();
        const std::lock_guard lock(mutex);
        report.cpu_seconds += system::thread_seconds() - before;
        report.lanes.add(worker.use());
      },
      [&] { exchange.leave(); });
  report.wall_seconds = seconds_since(start);
  report.idle = exchange.waited() / (report.wall_seconds * n_threads);
  return report;
}

WorkReport run_plan(const Plan& plan, const MachineOptions& machine, const Hooks& hooks) {
  // Nothing is claimed: the tests of a plan in memory are nobody else's.
  PlanQueue queue(plan, hooks, machine.threads);
  return work_at(queue, plan, machine);
}

std::vector<TestResult> run_tests(const Specimens& specimens, const std::vector<Recipe>& recipes,
                                  const MachineOptions& machine, const Hooks& hooks) {
  std::vector<TestResult> results;
  for (std::size_t i = 0; i < specimens.size(); ++i)
    results.push_back(not_started(*specimens[i], recipes[i].test.kind));
  Hooks with_results = hooks;
  with_results.on_result = [&](std::size_t test, TestResult& result) {
    if (hooks.on_result) hooks.on_result(test, result);
    results[test] = std::move(result);
  };
  run_plan(plan_of(specimens, recipes), machine, with_results);
  return results;
}

std::vector<TestResult> run_tests(const Specimens& specimens, const Recipe& recipe,
                                  const MachineOptions& machine, const Hooks& hooks) {
  return run_tests(specimens, std::vector<Recipe>(specimens.size(), recipe), machine, hooks);
}

}  // namespace phy::study
