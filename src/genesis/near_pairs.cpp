#include "genesis/near_pairs.hpp"

#include <algorithm>
#include <cmath>

#include "base/near_pairs.hpp"

namespace phy::genesis {
namespace {

constexpr double rounding = 1e-9;  // of the largest radius: what the search finds too much is looked at again

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
  phy::near_pairs(x, r, reach + rounding * r_max, found);
  std::vector<Pair> pairs;
  pairs.reserve(found.size());
  for (const PairKey key : found) {
    const Pair p{static_cast<std::uint32_t>(key_a(key)), static_cast<std::uint32_t>(key_b(key))};
    if (gap(discs[p.a], discs[p.b]) <= reach) pairs.push_back(p);
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const Pair& p, const Pair& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
  return pairs;
}

}  // namespace phy::genesis
