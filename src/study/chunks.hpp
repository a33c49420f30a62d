// How many tests a worker starts with, and in how many lanes.
#pragma once
#include <vector>

#include "study/lane_batch.hpp"

namespace phy::study {

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
