// Runs many specimens: groups of one packing in SIMD lanes, groups on worker threads, finished lanes filled
// again.
//
// Parallel over groups, never inside a specimen: a group has no barrier, and its sums keep their order.
// Workers take specimens from one queue. A result depends on its specimen and recipe alone, never on the
// worker, the lane, the neighbours in the lanes or their number; only the order in which results arrive does.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/kernels.hpp"
#include "engine/lane_group.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy {

/// How to use the machine. Changes no bit of any result.
struct MachineOptions {
  int threads = 1;
  int lanes = 0;  ///< 0: as many as fill a register, fewer when there are more threads than specimens
  int skew = 4;
  Isa isa = Isa::sse2;
};

/// Progress of all running specimens.
struct Progress {
  std::size_t n_done = 0, n_total = 0;
  double steps_done = 0.0;  ///< cycles times specimens so far
};

struct ScheduleHooks {
  std::function<void(std::size_t index, const TestResult&)> on_result;  ///< from a worker, one at a time
  std::function<void(const Progress&)> on_progress;                     ///< from a worker, one at a time
  /// Strain and stress [Pa] of a running test after each block; from a worker, one at a time.
  std::function<void(std::size_t index, double strain, double stress)> on_reading;
  const std::atomic<bool>* stop = nullptr;  ///< true: end soon, keep what is finished
};

/// One test for a lane.
struct Job {
  std::shared_ptr<const Specimen> specimen;
  std::shared_ptr<const Recipe> recipe;  ///< of the precision and block length of the group
  std::size_t index = 0;                 ///< given back with the result
};

/// Where a group gets its work and leaves its results. Called from the thread that runs the group.
struct LaneHooks {
  std::function<std::optional<Job>()> next;  ///< nothing: no more work of this packing
  std::function<void(std::size_t index, TestResult)> done;
  std::function<void(double steps, double seconds)> block;  ///< cycles times specimens, thread CPU time
  std::function<bool()> stopped;
  std::function<void(std::size_t index, double strain, double stress)> reading = nullptr;
};

/// Fills the lanes of one group until `next` has no more and all lanes are over. All jobs are of one packing
/// and one rig (rig_name). What is stopped is handed over as interrupted.
void run_lanes(const GroupOptions& options, const LaneHooks& hooks);

/// CPU time of the calling thread [s].
double thread_seconds();

/// Results in the order of `specimens`; unfinished ones carry Status::interrupted.
std::vector<TestResult> run_tests(const std::vector<std::shared_ptr<const Specimen>>& specimens,
                                  const Recipe& recipe, const MachineOptions& machine,
                                  const ScheduleHooks& hooks = {});

/// Lanes that run_tests would use.
int lanes_for(std::size_t n_specimens, Precision precision, const MachineOptions& machine);

}  // namespace phy
