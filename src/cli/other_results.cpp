#include "cli/other_results.hpp"

#include <filesystem>
#include <map>

#include "io/load.hpp"

namespace phy::cli {

std::vector<std::pair<std::string, study::RecipeDifference>> results_of_others(const std::string& folder,
                                                                               const Recipe& recipe) {
  std::vector<std::pair<std::string, study::RecipeDifference>> others;
  std::error_code none;
  if (!std::filesystem::is_directory(folder, none)) return others;
  for (const std::string& result : io::result_folders(folder)) {
    try {
      if (const auto d = study::first_difference(io::read_result_recipe(result), recipe))
        others.emplace_back(result, *d);
    } catch (const InputError&) {  // unreadable: `show` and `report` tell it, and a run mends it
    } catch (const IoError&) {
    }
  }
  return others;
}

std::vector<Problem> problems_of_others(const std::string& folder, const Recipe& recipe,
                                        const std::string& path, const std::string& remedy) {
  std::vector<Problem> problems;
  std::map<std::string, int> n_alike;  // results that differ alike are one problem
  const auto others = results_of_others(folder, recipe);
  for (const auto& [result, d] : others) ++n_alike[d.key + " " + d.one];
  for (const auto& [result, d] : others) {
    const int n = std::exchange(n_alike[d.key + " " + d.one], 0);
    if (n == 0) continue;
    const std::string where = n == 1 ? result : folder + " (" + std::to_string(n) + " results)";
    problems.push_back({where, d.key, d.one, d.other + ", as in " + path,
                        "the folder holds results of another recipe: " + remedy});
  }
  return problems;
}

}  // namespace phy::cli
