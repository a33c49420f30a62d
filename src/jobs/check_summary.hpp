// What a rock's table says in ten lines: how it was read, what to look at, what it leaves open and which test
// would settle most of that, what a calibration will probably come to, and what it takes.
#pragma once
#include <string>
#include <vector>

#include "jobs/rock_check.hpp"

namespace phy::jobs {

constexpr std::size_t most_doubts = 2;  ///< that are named

/// `threads`: of the calibration that is foreseen.
std::vector<Finding> summary_of(const RockCheck& check, int threads);

/// The same as text; `all`: and every detail. `path`: the file of the rock, as named to its
/// user. `threads`: of the calibration that is foreseen.
std::string rock_check(const Rock& read, const std::string& path, int width, int threads, bool all);

}  // namespace phy::jobs
