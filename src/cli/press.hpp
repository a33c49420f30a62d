// The tests of a recipe in front of the user: curves and progress on the terminal, results on disk.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"
#include "study/work.hpp"

namespace phy::cli {

/// Runs the tests; each result is in its own folder inside `folder` as soon as it is there, those that were
/// interrupted in none.
std::vector<TestResult> press(const Recipe& recipe,
                              const std::vector<std::shared_ptr<const Specimen>>& specimens,
                              const std::string& folder, const study::MachineOptions& machine);

}  // namespace phy::cli
