// Runs the tests of a plan: worker threads, each with one group of lanes at a time, fed from one queue.
//
// The task queue gives out tests and takes results. StoreQueue owns the store: it claims a test before giving
// it out, so that other processes on the same store leave it alone, and stores the result as soon as it is
// there. With MPI the workers of other ranks ask the task queue of rank 0 (study/mpi.hpp); nothing else in a
// worker changes.
#pragma once
#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "records/result.hpp"
#include "study/plan.hpp"
#include "study/store.hpp"
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
  /// The next test of the batch; of the kind of the worker's last one, if there is one left.
  virtual std::optional<std::size_t> take(std::size_t batch, std::optional<std::size_t> last) = 0;
  /// A result, or an interrupted test.
  virtual void deliver(std::size_t test, const TestResult& result) = 0;
  /// Progress: cycles times grains.
  virtual void count(double work) = 0;
  /// Of a running test: strain and stress [Pa].
  virtual void read(std::size_t /*test*/, double /*strain*/, double /*stress*/) {}
  virtual bool stopped() = 0;
};

class StoreQueue : public TaskQueue {
 public:
  StoreQueue(const Plan& plan, Store& store, StudyHooks hooks, int n_workers);
  ~StoreQueue() override;
  Assignment enter() override;
  void leave(std::size_t batch, std::optional<std::size_t> last) override;
  std::optional<std::size_t> take(std::size_t batch, std::optional<std::size_t> last) override;
  void deliver(std::size_t test, const TestResult& result) override { deliver_from("", test, result); }
  /// A result of another host; "": of this one.
  void deliver_from(const std::string& host, std::size_t test, const TestResult& result);
  void count(double work) override;
  void read(std::size_t test, double strain, double stress) override;
  bool stopped() override { return closed_ || (hooks_.stop != nullptr && hooks_.stop->load()); }
  /// As if the user had stopped: something is broken.
  void close() { closed_ = true; }
  StudyProgress progress();

 private:
  /// Tests of one kind that wait in a batch.
  struct Kind {
    std::deque<std::size_t> tests;  // longest first
    double work = 0.0;              // expected cost of all
    int n_at = 0;                   // workers whose last test was of this kind
  };
  void finish(std::size_t test, bool failed);
  void enqueue(std::size_t test);
  std::size_t n_waiting(std::size_t batch) const;
  Kind& kind_of(std::size_t test) { return waiting_[plan_.tests[test].batch][plan_.tests[test].kind]; }
  Kind& choose(std::size_t batch, std::optional<std::size_t> last);
  void look_again();
  void keep_claims(const std::stop_token& stop);

  const Plan& plan_;
  Store& store_;
  StudyHooks hooks_;
  const int n_workers_;
  std::atomic<bool> closed_{false};
  std::mutex mutex_;
  StudyProgress progress_;
  std::vector<std::map<std::size_t, Kind>> waiting_;  // per batch
  std::vector<std::size_t> n_inside_;                 // workers per batch
  std::vector<std::size_t> elsewhere_;                // claimed by other processes
  std::condition_variable_any wake_;
  std::jthread keeper_;
};

/// Runs tests of the queue until none is left or it is stopped. Rethrows the first exception of a worker.
WorkReport work_at(TaskQueue& queue, const Plan& plan, const MachineOptions& machine);

}  // namespace phy::study
