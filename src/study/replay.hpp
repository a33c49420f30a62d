// A stored result is run again from its recipe and held against what was stored. A recipe says everything
// that a result depends on, so every number, the history and the cracks must come out to the last bit.
#pragma once
#include <string>
#include <vector>

#include "records/recipe.hpp"
#include "records/result.hpp"

namespace phy::study {

/// What of a stored result a second run does not confirm, one line each: outcome, numbers with both values,
/// the first row of the history and the first crack that differ. Empty: all of it is equal. Numbers that were
/// not measured when it was stored do not count.
std::vector<std::string> differences(const TestResult& stored, const TestResult& now);

/// Places of `n` results that differ as much as they can: of every kind of test, with and without layers and
/// of every inclination one, then another of each. All if there are no more; the same ones every time.
std::vector<std::size_t> spread(const std::vector<Recipe>& singles, std::size_t n);

}  // namespace phy::study
