// Runs many specimens: groups of one packing in SIMD lanes, groups on worker threads, finished lanes filled
// again, tests shared out anew near the end (lane_batch.hpp).
//
// Parallel over groups, never inside a specimen: a group has no barrier, and its sums keep their order.
// Workers take specimens from one queue. A result depends on its specimen and recipe alone, never on the
// worker, the lane, the neighbours in the lanes or their number; only the order in which results arrive does.
#pragma once
#include <memory>
#include <vector>

#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"
#include "study/work.hpp"

namespace phy::study {

/// Results in the order of `specimens`; unfinished ones carry Status::interrupted, also where a
/// test has not begun.
std::vector<TestResult> run_tests(const std::vector<std::shared_ptr<const Specimen>>& specimens,
                                  const Recipe& recipe, const MachineOptions& machine,
                                  const ScheduleHooks& hooks = {});

}  // namespace phy::study
