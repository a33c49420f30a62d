// Runs many specimens: groups of one packing in SIMD lanes, groups on worker threads, finished lanes filled
// again, tests shared out anew near the end (lane_batch.hpp).
//
// Parallel over groups, never inside a specimen: a group has no barrier, and its sums keep their order.
// Workers take specimens from one queue. A result depends on its specimen and recipe alone, never on the
// worker, the lane, the neighbours in the lanes or their number; only the order in which results arrive does.
#pragma once
#include <atomic>
#include <functional>
#include <memory>
#include <vector>

#include "engine/kernels.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"
#include "study/lane_batch.hpp"

namespace phy::study {

/// How to use the machine. Changes no bit of any result.
struct MachineOptions {
  int threads = 1;
  int lanes = 0;  ///< 0: those that are soonest done, fewer for few specimens or near the end; else fixed
  int skew = 8;
  engine::Isa isa = engine::Isa::sse2;
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

/// Results in the order of `specimens`; unfinished ones carry Status::interrupted, also where a
/// test has not begun.
std::vector<TestResult> run_tests(const std::vector<std::shared_ptr<const Specimen>>& specimens,
                                  const Recipe& recipe, const MachineOptions& machine,
                                  const ScheduleHooks& hooks = {});

/// A lane batch for so many specimens of the recipe; `alike`: their layers have the same inclination.
LaneBatchOptions lane_batch_options(std::size_t n_specimens, bool alike, const Recipe& recipe,
                                    const MachineOptions& machine);

/// Sizes of the first chunks of few tests for several workers, longest test first: such that the slowest
/// worker is done as soon as possible, which leaves long tests alone in the fastest groups. Tests that find
/// no place come later, as lanes fall free. `cost`: cycles of each test, falling; `widest`: the lane batch
/// for as many tests as there may be side by side; where its lanes are fixed they are filled one chunk after
/// the other.
std::vector<std::size_t> first_chunks(const std::vector<double>& cost, bool alike, std::size_t n_workers,
                                      const LaneBatchOptions& widest);

}  // namespace phy::study
