#include "base/near_pairs.hpp"

#include <algorithm>

namespace phy {
namespace {

/// Grains in square cells, each a chain through its grains: `first` of the cell, `next` of the grain, -1:
/// none.
struct Cells {
  Vec2 lo;
  double size;
  std::int64_t nx, ny;
  std::vector<std::int32_t> first, next;

  Cells(std::span<const Vec2> x, double smallest);
  std::int32_t begin(std::int64_t cx, std::int64_t cy) const {
    return first[static_cast<std::size_t>(cy * nx + cx)];
  }
};

Cells::Cells(std::span<const Vec2> x, double smallest) : lo(x[0]), size(smallest), next(x.size(), -1) {
  Vec2 hi = lo;
  for (const Vec2& p : x) {
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
  // Fragments may fly far: the grid is bounded to a few cells per grain, larger cells then.
  const double limit = 4.0 * static_cast<double>(x.size()) + 64.0;
  while (((hi.x - lo.x) / size + 1.0) * ((hi.y - lo.y) / size + 1.0) > limit) size *= 2.0;
  nx = static_cast<std::int64_t>((hi.x - lo.x) / size) + 1;
  ny = static_cast<std::int64_t>((hi.y - lo.y) / size) + 1;
  first.assign(static_cast<std::size_t>(nx * ny), -1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto c = static_cast<std::size_t>(static_cast<std::int64_t>((x[i].y - lo.y) / size) * nx +
                                            static_cast<std::int64_t>((x[i].x - lo.x) / size));
    next[i] = first[c];
    first[c] = static_cast<std::int32_t>(i);
  }
}

}  // namespace

void near_pairs(std::span<const Vec2> x, std::span<const double> r, double reach,
                std::vector<PairKey>& pairs) {
  if (x.empty()) return;
  const Cells cells(x, 2.0 * *std::max_element(r.begin(), r.end()) + reach);
  const auto match = [&](std::size_t i, std::int32_t j) {
    for (; j >= 0; j = cells.next[static_cast<std::size_t>(j)]) {
      const auto k = static_cast<std::size_t>(j);
      const Vec2 d = x[k] - x[i];
      const double touch = r[i] + r[k] + reach;
      if (k != i && dot(d, d) < touch * touch)
        pairs.push_back(pair_key(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k)));
    }
  };
  // Half of the neighbouring cells, so that each pair is met once: the rest of the own cell, right, and
  // above.
  for (std::int64_t cy = 0; cy < cells.ny; ++cy)
    for (std::int64_t cx = 0; cx < cells.nx; ++cx)
      for (std::int32_t i = cells.begin(cx, cy); i >= 0; i = cells.next[static_cast<std::size_t>(i)]) {
        const auto a = static_cast<std::size_t>(i);
        match(a, cells.next[a]);
        if (cx + 1 < cells.nx) match(a, cells.begin(cx + 1, cy));
        if (cy + 1 == cells.ny) continue;
        for (std::int64_t ox = std::max<std::int64_t>(cx - 1, 0); ox <= std::min(cx + 1, cells.nx - 1); ++ox)
          match(a, cells.begin(ox, cy + 1));
      }
}

}  // namespace phy
