// A lane batch: tests side by side in the lanes of one group. And the exchange where workers share lane
// batches.
//
// Few tests are done one after the other, each alone in its group, which then fills the register with
// contacts (engine/wide_loop.hpp): side by side they would take longer, most of it for empty lanes and for
// the law of their neighbours' joints. From how many on lanes are worth it is measured (slowness()). Near the
// end of a run a lane batch becomes narrower accordingly, and in the end one batch per test; a worker without
// work gets a batch of them, or half of the tests of one that still has several. Tests move between blocks,
// in the middle of their course; no bit of their results changes (LaneGroup::move_lane). Lane batches with a
// fixed number of lanes stay as they are.
#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/lane_group.hpp"
#include "lab/procedure.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"
#include "study/work.hpp"

namespace phy::study {

/// One test for a lane.
struct Job {
  std::shared_ptr<const Specimen> specimen;
  std::shared_ptr<const Recipe> recipe;  ///< of the precision and block length of the group
  std::size_t index = 0;                 ///< given back with the result
};

/// Where a lane batch gets its work and leaves its results. Called from the thread that runs the lane batch.
struct LaneHooks {
  std::function<std::optional<Job>()> next;  ///< nothing: no more work of this packing
  std::function<void(std::size_t index, TestResult)> done;
  std::function<void(const LaneUse& use, std::size_t n_grains)> block;
  std::function<bool()> stopped;
  std::function<void(std::size_t index, const RunningTest&)> reading = nullptr;
};

/// Numerics of a lane batch's group.
struct LaneBatchOptions {
  engine::GroupOptions group;
  bool fixed = false;  ///< the number of lanes stays, and no test is given away
};

/// Time of a cycle of a group over that of a test that is alone in its group, as bench_engine has it.
/// `alike`: all tests have their layers at the same inclination, so that no contact is computed by two laws.
double slowness(int lanes, bool alike, Precision precision, engine::Isa isa);
/// The fewest lanes that hold `n` tests, at most those of `widest`; 1 where one after the other is sooner, or
/// as good as.
int fitting_lanes(std::size_t n, bool alike, const engine::GroupOptions& widest);
/// Inclination of the layers; intact rock has one that no layers have.
double layers_of(const Specimen& specimen);

class LaneBatch {
 public:
  LaneBatch(std::shared_ptr<const Packing> packing, const LaneBatchOptions& options);
  /// A test for every empty lane, while there are any.
  void fill(const LaneHooks& hooks);
  /// One block; finished tests are handed over and their lanes filled. Stopped ones are interrupted.
  void work(const LaneHooks& hooks);
  std::size_t n_tests() const;
  /// All its tests have their layers at the same inclination.
  bool alike() const;
  /// Its tests would be done sooner in a narrower group, or one after the other.
  bool too_wide() const;
  /// Moves `n` tests, neighbours in bedding angle, into a lane batch of their own.
  std::unique_ptr<LaneBatch> part(std::size_t n);
  /// Moves its tests into lane batches that are not too wide.
  std::vector<std::unique_ptr<LaneBatch>> narrowed();
  bool fixed() const { return options_.fixed; }

 private:
  /// A test in a lane.
  struct LaneSlot {
    Job job;
    std::unique_ptr<lab::Procedure> test;  // refers to the job's recipe; null: empty
    double seconds = 0.0;
  };
  void hand_over(const LaneHooks& hooks, LaneSlot& slot);
  std::vector<std::size_t> busy_lanes() const;

  std::shared_ptr<const Packing> packing_;
  LaneBatchOptions options_;
  std::unique_ptr<engine::LaneGroup> group_;
  std::vector<LaneSlot> slots_;
};

/// Between the workers of one run, all counted as working from the constructor until leave(). A lane batch is
/// made for a worker that waits. It takes the batch even if its waiting time is over by then: no other worker
/// would run these tests.
class LaneBatchExchange {
 public:
  explicit LaneBatchExchange(int n_workers) : n_working_(n_workers) {}
  /// A worker without work waits for a lane batch. Nothing: no worker has work any more.
  std::unique_ptr<LaneBatch> wait();
  /// The same for a worker that may find work elsewhere. Nothing: none came in time.
  std::unique_ptr<LaneBatch> wait_for(std::chrono::milliseconds patience);
  void leave();
  /// Makes a lane batch, or gives one away, if more workers wait than batches are on their way. False:
  /// nothing was made.
  bool share(const std::function<std::unique_ptr<LaneBatch>()>& make);
  /// Time that workers have spent waiting [s].
  double waited();

 private:
  std::unique_ptr<LaneBatch> take_offered();

  std::mutex mutex_;
  std::condition_variable change_;
  std::vector<std::unique_ptr<LaneBatch>> offered_;  // never more than workers that wait
  int n_working_;
  std::size_t n_waiting_ = 0;
  double waited_ = 0.0;
};

/// Works until no test of the lane batch is left; shares with those who wait at the exchange.
void run_lane_batch(std::unique_ptr<LaneBatch> lane_batch, const LaneHooks& hooks,
                    LaneBatchExchange& exchange);

}  // namespace phy::study
