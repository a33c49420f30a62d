// The tests of a plan, given out to workers (study/worker.hpp) who bring the results back.
//
// PlanQueue decides which test comes next and keeps nothing: results go to the hooks. That is enough for the
// tests of a recipe, and to run stored results again. StoreQueue (study/store_queue.hpp) adds the store: a
// test is claimed before it is given out and stored as soon as it is there. With MPI the workers of other
// ranks ask the queue of rank 0 (study/mpi.hpp). Nothing in a worker knows which of them it asks.
#pragma once
#include <atomic>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "records/result.hpp"
#include "study/plan.hpp"
#include "study/work.hpp"

namespace phy::study {

/// A worker's next packing.
struct Assignment {
  enum class Kind { work, wait, finished };
  Kind kind = Kind::finished;
  std::size_t batch = 0;
  std::size_t n_tests = 0;  ///< a fair share of the batch, for the number of lanes
};

class TaskQueue {
 public:
  virtual ~TaskQueue() = default;
  /// A packing to work on. `wait`: all that is left runs elsewhere; ask again a little later.
  virtual Assignment enter() = 0;
  /// The worker goes, with its last test of the batch.
  virtual void leave(std::size_t batch, std::optional<std::size_t> last) = 0;
  /// The next test of the batch; of the angles of the worker's last one, if there is one left.
  virtual std::optional<std::size_t> take(std::size_t batch, std::optional<std::size_t> last) = 0;
  /// A result, or an interrupted test.
  virtual void deliver(std::size_t test, TestResult result) = 0;
  /// Progress: cycles times grains.
  virtual void count(double work) = 0;
  /// A running test after a block.
  virtual void read(std::size_t /*test*/, const RunningTest& /*now*/) {}
  virtual bool stopped() = 0;
};

class PlanQueue : public TaskQueue {
 public:
  PlanQueue(const Plan& plan, Hooks hooks, int n_workers);
  Assignment enter() override;
  void leave(std::size_t batch, std::optional<std::size_t> last) override;
  std::optional<std::size_t> take(std::size_t batch, std::optional<std::size_t> last) override;
  void deliver(std::size_t test, TestResult result) override;
  void count(double work) override;
  void read(std::size_t test, const RunningTest& now) override;
  bool stopped() override { return closed_ || (hooks_.stop != nullptr && hooks_.stop->load()); }
  /// As if the user had stopped: something is broken.
  void close() { closed_ = true; }
  Progress progress();

 protected:
  /// For a queue that knows what is finished already: it calls enqueue() or finish() for every test.
  explicit PlanQueue(const Plan& plan, int n_workers);
  /// May this test be given out? Called once per test that take() has chosen, under the lock.
  virtual bool claim(std::size_t /*test*/) { return true; }
  /// Brings back tests that could not be claimed; called under the lock when none waits. True: some of them
  /// still run elsewhere.
  virtual bool refresh_claims() { return false; }

  void enqueue(std::size_t test);
  void finish(std::size_t test, Status status);
  /// Counts a result of this run, `on_guest`: of another rank, and tells the hooks.
  void report(std::size_t test, TestResult& result, bool on_guest);

  const Plan& plan_;
  Hooks hooks_;
  std::mutex mutex_;

 private:
  /// Tests of equal angles that wait in a batch.
  struct Group {
    std::deque<std::size_t> tests;  // longest first
    double work = 0.0;              // expected cost of all
    int n_at = 0;                   // workers whose last test was of this group
  };
  std::size_t n_waiting(std::size_t batch) const;
  std::size_t best_batch() const;
  Group& group_of(std::size_t test) { return waiting_[plan_.tests[test].batch][plan_.tests[test].group]; }
  Group& choose(std::size_t batch, std::optional<std::size_t> last);

  const std::size_t n_workers_;
  std::atomic<bool> closed_{false};
  Progress progress_;
  std::vector<std::map<std::size_t, Group>> waiting_;  // per batch
  std::vector<std::size_t> n_inside_;                  // workers per batch
};

}  // namespace phy::study
