// Tables for the terminal, plain ASCII. Reads records only.
#pragma once
#include <string>
#include <vector>

#include "records/result.hpp"

namespace phy {

/// One row per specimen, units in the head, cracks of the whole test. Fits `terminal_width` columns: one
/// table, else two stacked tables (readings of the curve; cracks and run), else a list of key and value per
/// specimen. A width of 0 or less is no limit.
/// "-": could not be determined; "<": an upper bound (the number's note begins with "below").
std::string press_table(const std::vector<TestResult>& results, int terminal_width);

/// Why a "-" stands under sigma_ci or sigma_cd of a test that succeeded, once per reason.
std::string missing_numbers(const std::vector<TestResult>& results);

/// The missing numbers, then one line per specimen that did not succeed: why, and what to do; empty when all
/// went well.
std::string outcome_lines(const std::vector<TestResult>& results);

}  // namespace phy
