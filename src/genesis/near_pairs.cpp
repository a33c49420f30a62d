#include "genesis/near_pairs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/near_pairs.hpp"

namespace phy::genesis {
namespace {

constexpr double search_rounding =
    1e-9;  // of the largest radius: what the search finds too much is looked at again

std::size_t first(PairKey key) { return static_cast<std::size_t>(key_a(key)); }
std::size_t second(PairKey key) { return static_cast<std::size_t>(key_b(key)); }

/// By a, then by b: counted into place by a, where the few of each are sorted.
std::vector<Pair> in_order(const std::vector<PairKey>& found, std::size_t n_discs) {
  std::vector<std::size_t> end(n_discs + 1, 0);  // of the pairs of a; before they are put there, their begin
  for (const PairKey key : found) ++end[first(key) + 1];
  std::partial_sum(end.begin(), end.end(), end.begin());
  std::vector<Pair> pairs(found.size());
  for (const PairKey key : found)
    pairs[end[first(key)]++] = {static_cast<std::uint32_t>(first(key)),
                                static_cast<std::uint32_t>(second(key))};
  auto begin = pairs.begin();
  for (std::size_t a = 0; a < n_discs; ++a) {
    const auto stop = pairs.begin() + static_cast<std::ptrdiff_t>(end[a]);
    std::sort(begin, stop, [](const Pair& p, const Pair& q) { return p.b < q.b; });
    begin = stop;
  }
  return pairs;
}

}  // namespace

double gap(const Disc& a, const Disc& b) {
  const double dx = b.x - a.x, dy = b.y - a.y;
  return std::sqrt(dx * dx + dy * dy) - (a.r + b.r);
}

std::vector<Pair> near_pairs(const std::vector<Disc>& discs, double reach) {
  std::vector<Vec2> x;
  std::vector<double> r;
  double r_max = 0.0;
  for (const Disc& d : discs) x.push_back({d.x, d.y}), r.push_back(d.r), r_max = std::max(r_max, d.r);
  std::vector<PairKey> found;
  phy::near_pairs(x, r, reach + search_rounding * r_max, found);
  std::erase_if(found, [&](PairKey key) { return gap(discs[first(key)], discs[second(key)]) > reach; });
  return in_order(found, discs.size());
}

}  // namespace phy::genesis
