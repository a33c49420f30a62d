#include "jobs/another_recipe.hpp"

#include <fmt/format.h>

namespace phy::jobs {

std::vector<Problem> problems_of(const std::string& where,
                                 const std::vector<study::RecipeDifference>& differences,
                                 const std::string& as_in, const std::string& remedy) {
  // Quite another recipe differs in dozens of keys: after a few the user knows.
  constexpr std::size_t most = 6;  // lines
  // The line that counts the rest takes the place of one, so that there are never more than `most`.
  const std::size_t n = differences.size(), reported = n > most ? most - 1 : n;
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < reported; ++i) {
    const study::RecipeDifference& d = differences[i];
    problems.push_back({where, d.key, d.one, d.other + ", " + as_in, remedy});
  }
  if (reported < n)
    problems.push_back({where, fmt::format("{} other keys", n - reported), "", as_in, remedy});
  return problems;
}

}  // namespace phy::jobs
