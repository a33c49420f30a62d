#include "study/runner.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"
#include "base/clock.hpp"
#include "base/parallel.hpp"
#include "genesis/cut.hpp"
#include "genesis/settle.hpp"
#include "io/toml_in.hpp"
#include "lab/load_path.hpp"
#include "study/chunks.hpp"
#include "study/direct.hpp"
#include "study/experiment.hpp"

namespace phy::study {
namespace {

constexpr auto patience = std::chrono::milliseconds(300);  // between looks at what runs elsewhere
constexpr auto renewal = std::chrono::seconds(20);         // well within lease_seconds

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
        run_lane_batch(std::move(lane_batch), hooks({}), exchange_);
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
    const Recipe& any = plan_.tests[plan_.batches[a.batch].tests.front()].recipe;
    last_.reset();
    try {
      packing_ = packing_of(any, [this] { return stopped(); });
    } catch (const genesis::Interrupted&) {
      return;
    } catch (const InputError& e) {
      // Without a packing none of the tests of this batch can run. Each is claimed and answered one by one:
      // some of them may run in other processes, which will find out for themselves.
      while (const auto test = queue_.take(a.batch, last_)) {
        last_ = test;
        queue_.deliver(*test, not_made(plan_.tests[*test], e.what()));
      }
      return;
    }
    if (plan_.study.solver == Solver::direct) return solve_batch(a.batch);
    // The lanes of this worker alone, so the number of threads does not matter.
    MachineOptions alone = machine_;
    alone.threads = 1;
    const std::vector<std::size_t>& tests = plan_.batches[a.batch].tests;
    const bool alike = std::all_of(tests.begin(), tests.end(), [&](std::size_t t) {
      return plan_.tests[t].kind == plan_.tests[tests.front()].kind;
    });
    // All tests of a batch have the grains in common that are cut from the packing (genesis/cut.hpp).
    auto lane_batch = std::make_unique<LaneBatch>(genesis::shaped(packing_, any),
                                                  lane_batch_options(a.n_tests, alike, any, alone));
    const LaneHooks lanes = hooks([&] { return next(a.batch); });
    lane_batch->fill(lanes);
    run_lane_batch(std::move(lane_batch), lanes, exchange_);
  }
  void solve_batch(std::size_t batch) {
    while (const std::optional<Job> job = next(batch)) {
      queue_.deliver(job->index, solve_directly(*job->specimen, statics_));
      queue_.count(plan_.tests[job->index].cost);
    }
  }
  LaneHooks hooks(std::function<std::optional<Job>()> next_job) {
    if (!next_job) next_job = [] { return std::optional<Job>(); };
    return {std::move(next_job),
            [this](std::size_t test, const TestResult& result) { queue_.deliver(test, result); },
            [this](const LaneUse& use, std::size_t n_grains) {
              use_.add(use);
              queue_.count(use.test_steps * static_cast<double>(n_grains));
            },
            [this] { return stopped(); },
            [this](std::size_t test, double strain, double stress) { queue_.read(test, strain, stress); }};
  }
  std::optional<Job> next(std::size_t batch) {
    while (!stopped()) {
      const auto test = queue_.take(batch, last_);
      if (!test) return {};
      last_ = test;
      const Recipe& recipe = plan_.tests[*test].recipe;
      // The specimen is made where it will run, just before it does: making all of them first would fill the
      // memory and idle the lanes. A recipe lives in the plan, so it is not owned here.
      try {
        Job job{specimen_of(packing_, recipe), {std::shared_ptr<const Recipe>(), &recipe}, *test};
        lab::check_load_path(*job.specimen, recipe);
        return job;
      } catch (const InputError& e) {
        queue_.deliver(*test, not_made(plan_.tests[*test], e.what()));
      }
    }
    return {};
  }
};

}  // namespace

StoreQueue::StoreQueue(const Plan& plan, Store& store, StudyHooks hooks, int n_workers)
    : plan_(plan),
      store_(store),
      hooks_(std::move(hooks)),
      n_workers_(n_workers),
      waiting_(plan.batches.size()),
      n_inside_(plan.batches.size()) {
  for (std::size_t b = 0; b < plan.batches.size(); ++b) {
    std::vector<std::string> keys;
    for (const std::size_t t : plan.batches[b].tests) keys.push_back(plan.tests[t].key);
    // One query per batch instead of one per test.
    const auto rows = store.rows(keys);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const std::size_t test = plan.batches[b].tests[i];
      ++progress_.n_total;
      progress_.cost_left += plan.tests[test].cost;
      // A failed test counts as finished too: the same recipe would fail again.
      if (rows[i])
        finish(test, !has_answer(rows[i]->result.outcome.status));
      else
        enqueue(test);
    }
  }
  keeper_ = std::jthread([this](const std::stop_token& stop) { keep_claims(stop); });
}

StoreQueue::~StoreQueue() { keeper_.request_stop(); }

/// Renews the claims while their tests run: a test may take longer than a lease.
void StoreQueue::keep_claims(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, stop, renewal, [] { return false; }) && !stop.stop_requested()) {
    // The store has a lock of its own. Holding ours while the disk is slow would stop all workers.
    lock.unlock();
    try {
      store_.renew();
    } catch (const IoError&) {  // the next put() reports it; the lease is still valid
    }
    lock.lock();
  }
}

void StoreQueue::finish(std::size_t test, bool failed) {
  ++progress_.n_done;
  progress_.n_failed += failed ? 1 : 0;
  progress_.cost_left -= plan_.tests[test].cost;
}

void StoreQueue::enqueue(std::size_t test) {
  Kind& kind = kind_of(test);
  kind.tests.push_back(test);
  kind.work += plan_.tests[test].cost;
}

std::size_t StoreQueue::n_waiting(std::size_t batch) const {
  std::size_t n = 0;
  for (const auto& [number, kind] : waiting_[batch]) n += kind.tests.size();
  return n;
}

/// Tests that other processes had claimed may be finished meanwhile, or free again because the process is
/// dead.
void StoreQueue::look_again() {
  std::vector<std::size_t> still;
  for (const std::size_t test : elsewhere_) {
    const PlannedTest& t = plan_.tests[test];
    const Claim claim = store_.claim(t.key);
    if (claim == Claim::elsewhere) still.push_back(test);
    // Only whether it is free was asked; take() claims it for the worker that will run it.
    if (claim == Claim::mine) store_.release(t.key), enqueue(test);
    if (claim == Claim::done) finish(test, !has_answer(store_.rows({t.key}).front()->result.outcome.status));
  }
  elsewhere_ = std::move(still);
}

Assignment StoreQueue::enter() {
  const std::lock_guard lock(mutex_);
  if (stopped()) return {};
  // The batch with most tests waiting per worker already there (the new one counted): workers spread over the
  // packings.
  const auto pick = [&] {
    std::size_t best = waiting_.size();
    double most = 0.0;
    for (std::size_t b = 0; b < waiting_.size(); ++b) {
      const double share = static_cast<double>(n_waiting(b)) / static_cast<double>(n_inside_[b] + 1);
      if (share > most) most = share, best = b;
    }
    return best;
  };
  std::size_t batch = pick();
  if (batch == waiting_.size()) look_again(), batch = pick();
  if (batch == waiting_.size())
    return {elsewhere_.empty() ? Assignment::Kind::finished : Assignment::Kind::wait, 0, 0};
  // A fair share of all tests that wait, rounded up: it decides how many lanes the worker opens.
  std::size_t n = 0;
  for (std::size_t b = 0; b < waiting_.size(); ++b) n += n_waiting(b);
  const auto workers = static_cast<std::size_t>(n_workers_);
  ++n_inside_[batch];
  return {Assignment::Kind::work, batch, std::min(n_waiting(batch), (n + workers - 1) / workers)};
}

void StoreQueue::leave(std::size_t batch, std::optional<std::size_t> last) {
  const std::lock_guard lock(mutex_);
  --n_inside_[batch];
  if (last) --kind_of(*last).n_at;
}

/// The kind of the last test. When none of it is left, a new kind begins: the one with the most work per
/// worker times its longest test. Work alone would begin long tests late and leave workers idle at the end;
/// length alone would bring all kinds together in one group.
StoreQueue::Kind& StoreQueue::choose(std::size_t batch, std::optional<std::size_t> last) {
  if (last && !kind_of(*last).tests.empty()) return kind_of(*last);
  const auto urgency = [&](const Kind& k) {
    return k.work / (1.0 + k.n_at) * plan_.tests[k.tests.front()].cost;
  };
  Kind* best = nullptr;
  for (auto& [number, kind] : waiting_[batch])
    if (!kind.tests.empty() && (best == nullptr || urgency(kind) > urgency(*best))) best = &kind;
  PHY_CHECK(best != nullptr, "a test waits in the batch");
  return *best;
}

std::optional<std::size_t> StoreQueue::take(std::size_t batch, std::optional<std::size_t> last) {
  const std::lock_guard lock(mutex_);
  // Claiming can fail where another process was faster: then the next test is tried.
  while (n_waiting(batch) > 0 && !stopped()) {
    Kind& kind = choose(batch, last);
    const std::size_t test = kind.tests.front();
    kind.tests.pop_front();
    kind.work -= plan_.tests[test].cost;
    if (store_.claim(plan_.tests[test].key) == Claim::mine) {
      if (last) --kind_of(*last).n_at;
      ++kind.n_at;
      return test;
    }
    elsewhere_.push_back(test);  // or done meanwhile: look_again finds out
  }
  return {};
}

void StoreQueue::deliver_from(const std::string& host, std::size_t test, const TestResult& result) {
  const PlannedTest& t = plan_.tests[test];
  // An interrupted test has no result: another process, or the next run, may take it.
  if (result.outcome.status == Status::interrupted) return store_.release(t.key);
  // Stored first, counted afterwards: what is reported as finished is on the disk.
  store_.put(t.key, io::write_recipe(t.recipe), result, host);
  const std::lock_guard lock(mutex_);
  finish(test, !has_answer(result.outcome.status));
  ++progress_.n_new;
  progress_.n_guest += host.empty() ? 0 : 1;
  progress_.cost_new += t.cost;
  progress_.work_new += static_cast<double>(result.n_steps * result.n_grains);
  if (hooks_.on_result) hooks_.on_result(t, result);
  if (hooks_.on_progress) hooks_.on_progress(progress_);
}

void StoreQueue::count(double work) {
  const std::lock_guard lock(mutex_);
  progress_.work += work;
  if (hooks_.on_progress) hooks_.on_progress(progress_);
}

void StoreQueue::read(std::size_t test, double strain, double stress) {
  if (!hooks_.on_reading) return;
  const std::lock_guard lock(mutex_);
  hooks_.on_reading(plan_.tests[test], strain, stress);
}

StudyProgress StoreQueue::progress() {
  const std::lock_guard lock(mutex_);
  return progress_;
}

WorkReport work_at(TaskQueue& queue, const Plan& plan, const MachineOptions& machine) {
  PHY_CHECK(machine.threads > 0, "at least one worker");
  const auto start = std::chrono::steady_clock::now();
  std::mutex mutex;
  std::atomic<bool> broken{false};
  LaneBatchExchange exchange(machine.threads);
  WorkReport report;
  on_threads(
      static_cast<std::size_t>(machine.threads), broken,
      [&](std::size_t) {
        // Each thread adds its own time, since the clock of a thread is gone with it.
        Worker worker(queue, plan, machine, exchange, broken);
        worker.run();
        const std::lock_guard lock(mutex);
        report.cpu_seconds += thread_seconds();
        report.lanes.add(worker.use());
      },
      [&] { exchange.leave(); });
  report.wall_seconds = seconds_since(start);
  report.idle = exchange.waited() / (report.wall_seconds * machine.threads);
  return report;
}

}  // namespace phy::study
