#include "cli/other_results.hpp"

#include <filesystem>

#include "io/load.hpp"

namespace phy {

std::vector<std::pair<std::string, RecipeDifference>> results_of_others(const std::string& folder,
                                                                        const Recipe& recipe) {
  std::vector<std::pair<std::string, RecipeDifference>> others;
  std::error_code none;
  if (!std::filesystem::is_directory(folder, none)) return others;
  for (const std::string& result : result_folders(folder)) {
    try {
      if (const auto d = first_difference(read_result_recipe(result), recipe))
        others.emplace_back(result, *d);
    } catch (const InputError&) {  // unreadable: `show` and `report` tell it, and a run mends it
    }
  }
  return others;
}

std::vector<Problem> problems_of_others(const std::string& folder, const Recipe& recipe,
                                        const std::string& path, const std::string& remedy) {
  std::vector<Problem> problems;
  for (const auto& [result, d] : results_of_others(folder, recipe))
    problems.push_back({result, d.key, d.one, d.other + ", as in " + path,
                        "the folder holds results of another recipe: " + remedy});
  return problems;
}

}  // namespace phy
