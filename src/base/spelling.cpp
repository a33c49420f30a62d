#include "base/spelling.hpp"

#include <algorithm>

namespace phy {
namespace {

/// Letters that are wrong, missing or too many, and neighbours that are exchanged.
std::size_t n_slips(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> n(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      n[i][j] = i == 0 ? j : j == 0 ? i : n[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      if (i == 0 || j == 0) continue;
      n[i][j] = std::min({n[i][j], n[i - 1][j] + 1, n[i][j - 1] + 1});
      // Damerau: two letters in the wrong order are one slip of a hand.
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        n[i][j] = std::min(n[i][j], n[i - 2][j - 2] + 1);
    }
  return n[a.size()][b.size()];
}

}  // namespace

std::string nearest(const std::string& word, const std::vector<std::string>& candidates) {
  std::string best;
  std::size_t least = word.size() / 3 + 1;  // more than one slip in three letters is another word
  for (const std::string& c : candidates)
    if (const std::size_t n = n_slips(word, c); n < least) least = n, best = c;
  return best;
}

}  // namespace phy
