// Tables for the terminal, plain ASCII. Reads records only.
#pragma once
#include <string>
#include <vector>

#include "records/result.hpp"

namespace phy::report {

/// One row per specimen, units in the head, cracks of the whole test; readings of the curve and of cracks and
/// run are the groups of text_table.
/// "-": could not be determined, or the test was interrupted; "<": an upper bound.
/// "*": a strength with a reservation (missing_numbers tells it).
std::string press_table(const std::vector<TestResult>& results, int terminal_width);

/// Why a "-" stands under a stress of damage, or a "*" behind a strength, of a test that succeeded,
/// once per reason.
std::string missing_numbers(const std::vector<TestResult>& results);

/// The missing numbers, then the measures of quality beyond their limits, then one line per specimen that did
/// not succeed: why, and what to do; empty when all went well.
std::string outcome_lines(const std::vector<TestResult>& results);

}  // namespace phy::report
