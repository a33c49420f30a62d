// Runs the tests of a queue: worker threads, each with one group of lanes at a time, finished lanes filled
// again, tests shared out anew near the end (lane_batch.hpp).
//
// Parallel over groups, never inside a specimen: a group has no barrier, and its sums keep their order. A
// result depends on its specimen and recipe alone, never on the worker, the lane, the neighbours in the lanes
// or their number; only the order in which results arrive does.
#pragma once
#include <memory>
#include <vector>

#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"
#include "study/plan.hpp"
#include "study/task_queue.hpp"
#include "study/work.hpp"

namespace phy::study {

/// Runs tests of the queue until none is left or it is stopped. Rethrows the first exception of a worker.
WorkReport work_at(TaskQueue& queue, const Plan& plan, const MachineOptions& machine);

/// Runs all tests of a plan; nothing is stored.
WorkReport run_plan(const Plan& plan, const MachineOptions& machine, const Hooks& hooks);

/// Tests specimens of one packing, each by its recipe. Results in their order; unfinished ones carry
/// Status::interrupted, also where a test has not begun. A test is its place in `specimens`.
using Specimens = std::vector<std::shared_ptr<const Specimen>>;
std::vector<TestResult> run_tests(const Specimens& specimens, const std::vector<Recipe>& recipes,
                                  const MachineOptions& machine, const Hooks& hooks = {});
/// All by one recipe.
std::vector<TestResult> run_tests(const Specimens& specimens, const Recipe& recipe,
                                  const MachineOptions& machine, const Hooks& hooks = {});

}  // namespace phy::study
