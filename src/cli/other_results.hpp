// Results of another recipe that already lie in a folder: a verb must not put its own beside them.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "study/experiment.hpp"

namespace phy::cli {

/// Their folders, each with the first key that tells. What cannot be read is passed over.
std::vector<std::pair<std::string, study::RecipeDifference>> results_of_others(const std::string& folder,
                                                                               const Recipe& recipe);

/// A problem for all of them that differ alike. `path`: file of the recipe.
std::vector<Problem> problems_of_others(const std::string& folder, const Recipe& recipe,
                                        const std::string& path, const std::string& remedy);

}  // namespace phy::cli
