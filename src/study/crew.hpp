// A crew: tests side by side in the lanes of one group. And the exchange where workers share crews.
//
// Near the end of a run there are fewer tests than lanes. A crew whose lanes stand empty becomes narrower,
// since a narrow group takes less time per cycle (0.63 to 0.91 of one twice as wide: slowness() in
// scheduler.cpp); a worker that has run dry gets half of the tests of a crew that still has several. Tests
// move between blocks, in the middle of their course; no bit of their results changes
// (LaneGroup::move_lane). Crews with a fixed number of lanes stay as they are.
#pragma once
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "engine/lane_group.hpp"
#include "lab/lab_test.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy::study {

/// One test for a lane.
struct Job {
  std::shared_ptr<const Specimen> specimen;
  std::shared_ptr<const Recipe> recipe;  ///< of the precision and block length of the group
  std::size_t index = 0;                 ///< given back with the result
};

/// Where a crew gets its work and leaves its results. Called from the thread that runs the crew.
struct LaneHooks {
  std::function<std::optional<Job>()> next;  ///< nothing: no more work of this packing
  std::function<void(std::size_t index, TestResult)> done;
  std::function<void(double steps, std::size_t n_grains)> block;  ///< steps: cycles times specimens
  std::function<bool()> stopped;
  std::function<void(std::size_t index, double strain, double stress)> reading = nullptr;
};

/// Numerics of a crew's group.
struct CrewOptions {
  engine::GroupOptions group;
  bool fixed = false;  ///< the number of lanes stays, and no test is given away
};

/// Lanes of the narrowest group that holds `n` tests, `widest` at most.
int fitting_lanes(std::size_t n, Precision precision, int widest);

class Crew {
 public:
  Crew(std::shared_ptr<const Packing> packing, const CrewOptions& options);
  /// A test for every empty lane, while there are any.
  void fill(const LaneHooks& hooks);
  /// One block; finished tests are handed over and their lanes filled. Stopped ones are interrupted.
  void work(const LaneHooks& hooks);
  std::size_t n_tests() const;
  bool too_wide() const;
  /// Moves `n` tests, neighbours in bedding angle, into a crew of their own.
  std::unique_ptr<Crew> part(std::size_t n);
  bool fixed() const { return options_.fixed; }

 private:
  /// A test in a lane.
  struct Seat {
    Job job;
    std::unique_ptr<lab::LabTest> test;  // refers to the job's recipe; null: empty
    double seconds = 0.0;
  };
  void hand_over(const LaneHooks& hooks, Seat& seat);

  std::shared_ptr<const Packing> packing_;
  CrewOptions options_;
  std::unique_ptr<engine::LaneGroup> group_;
  std::vector<Seat> seats_;
};

/// Between the workers of one run. A worker comes with the constructor and goes with leave(). A crew goes
/// from hand to hand: it is made for one who waits, and he does not go without it, whatever his patience.
class CrewExchange {
 public:
  explicit CrewExchange(int n_workers) : n_working_(n_workers) {}
  /// A worker without work waits for a crew. Nothing: nobody has work any more.
  std::unique_ptr<Crew> wait();
  /// The same for a worker that may find work elsewhere. Nothing: none came in time.
  std::unique_ptr<Crew> wait_for(std::chrono::milliseconds patience);
  void leave();
  /// If somebody waits and no crew is on its way to him, makes one for him. False: nobody, nothing is made.
  bool share(const std::function<std::unique_ptr<Crew>()>& make);
  /// Time that workers have spent waiting [s].
  double waited();

 private:
  std::unique_ptr<Crew> take_offered();

  std::mutex mutex_;
  std::condition_variable change_;
  std::vector<std::unique_ptr<Crew>> offered_;  // never more than there are who wait
  int n_working_;
  std::size_t n_waiting_ = 0;
  double waited_ = 0.0;
};

/// Works until no test of the crew is left; shares with those who wait at the exchange.
void run_crew(std::unique_ptr<Crew> crew, const LaneHooks& hooks, CrewExchange& exchange);

}  // namespace phy::study
