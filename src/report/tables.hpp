// Tables for the terminal. Reads records only.
#pragma once
#include <string>
#include <vector>

#include "records/result.hpp"

namespace phy {

/// One row per specimen. Narrower than the full table: two stacked tables; below 60 columns: a list.
std::string press_table(const std::vector<TestResult>& results, int width);

/// What did not succeed, why, and what to do; empty when all went well.
std::string outcome_lines(const std::vector<TestResult>& results);

}  // namespace phy
