// The work of a study or of a recipe's tests: how it is to be done, how it stands, what it took.
#pragma once
#include <atomic>
#include <cstddef>
#include <functional>

#include "engine/isa.hpp"
#include "records/result.hpp"
#include "records/running_test.hpp"

namespace phy::study {

/// How to use the machine. Changes no bit of any result.
struct MachineOptions {
  int threads = 1;
  int lanes = 0;  ///< 0: those that are soonest done, fewer for few specimens or near the end; else fixed
  int skew = 8;
  engine::Isa isa = engine::Isa::sse2;
};

/// How far the tests of a plan are.
struct Progress {
  std::size_t n_done = 0;    ///< finished, by any process
  std::size_t n_failed = 0;  ///< of these: without an answer
  std::size_t n_new = 0;     ///< of these: finished by this run
  std::size_t n_guest = 0;   ///< of these: on other ranks
  std::size_t n_total = 0;
  double cost_new = 0.0, cost_left = 0.0;  ///< expected cost of what this run has finished, and of the rest
  double work = 0.0;                       ///< cycles times grains of this run, the unit of cost
  double work_new = 0.0;                   ///< of these: of finished tests

  /// Seconds to go after `seconds` of work: the expected cost, scaled by what finished tests really took. 0:
  /// nothing is left, or none has finished yet.
  double seconds_left(double seconds) const;
};

/// Called from the workers, one at a time. A test is its place in Plan::tests.
struct Hooks {
  /// Finished, or interrupted where no store keeps it free for another run; may be moved from.
  std::function<void(std::size_t test, TestResult&)> on_result;
  std::function<void(const Progress&)> on_progress;
  /// A running test after each block. Not of tests on other ranks.
  std::function<void(std::size_t test, const RunningTest&)> on_reading = nullptr;
  const std::atomic<bool>* stop = nullptr;  ///< true: end soon, keep what is finished
};

/// What lanes did: how many of them held a test, and how fast they went.
struct LaneUse {
  double test_steps = 0.0;     ///< cycles times tests
  double lane_steps = 0.0;     ///< cycles times lanes, empty ones too
  double alone_steps = 0.0;    ///< cycles of tests that had a group to themselves
  double contact_steps = 0.0;  ///< cycles times contacts of the tests
  double seconds = 0.0;        ///< of the processor, in cycles
  void add(const LaneUse& other);
  /// Share of the lanes that held a test, where tests were side by side; NaN where none were.
  double occupancy() const { return (test_steps - alone_steps) / (lane_steps - alone_steps); }
  /// Share of the cycles of tests that had a group to themselves; NaN before the first cycle, as the next.
  double alone() const { return alone_steps / test_steps; }
  /// Time per contact, cycle and test [s].
  double seconds_per_step() const { return seconds / contact_steps; }
};

/// What the workers did.
struct WorkReport {
  double cpu_seconds = 0.0;   ///< of all workers
  double wall_seconds = 0.0;  ///< from the first start to the last end
  double idle = 0.0;          ///< share of workers' time without work
  LaneUse lanes;              ///< of tests, not of direct solutions
  std::size_t n_guest = 0;    ///< tests of other ranks (study/mpi.hpp)
};

}  // namespace phy::study
