#include "cli/stresses.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/check.hpp"
#include "base/units.hpp"
#include "records/recipe_schema.hpp"

namespace phy::cli {

// Six digits of {:g}: stresses that differ only beyond would share a folder, which read_stresses refuses.
std::string stress_text(double stress) { return fmt::format("{:g} MPa", stress * 1e-6); }

std::vector<double> read_stresses(const std::string& option, const std::vector<std::string>& words) {
  // The range of the recipe's own key, so that the command line and a recipe refuse the same stresses.
  const Field& range = *find_field(recipe_fields(), "test.confining_stress");
  std::vector<double> stresses;
  std::vector<Problem> problems;
  for (const std::string& word : words) {
    const Quantity q = parse_quantity(word, Dimension::pressure);
    if (!q.ok)
      problems.push_back({"command line", option, word, "a stress with its unit", q.problem});
    else if (!within_range(range, q.value))
      problems.push_back({"command line", option, word, range_text(range), ""});
    stresses.push_back(q.value);
  }
  // Columns rise from left to right, whatever the order in which they were typed.
  std::sort(stresses.begin(), stresses.end());
  const bool twice = std::adjacent_find(stresses.begin(), stresses.end(), [](double a, double b) {
                       return stress_text(a) == stress_text(b);
                     }) != stresses.end();
  // Only for stresses that could be read: a word without a unit would else be told twice.
  if (problems.empty() && (twice || stresses.size() < 3))
    problems.push_back({"command line", option, fmt::format("{}", fmt::join(words, ", ")),
                        "at least three stresses, each once",
                        "two unknowns and their errors need three stresses"});
  if (!problems.empty()) throw InputError(problems);
  return stresses;
}

}  // namespace phy::cli
