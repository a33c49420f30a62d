#include "base/near_pairs.hpp"

#include <algorithm>

namespace phy {

void near_pairs(std::span<const Vec2> x, std::span<const double> r, double reach,
                std::vector<PairKey>& pairs) {
  if (x.empty()) return;
  Vec2 lo = x[0], hi = x[0];
  double r_max = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    lo = {std::min(lo.x, x[i].x), std::min(lo.y, x[i].y)};
    hi = {std::max(hi.x, x[i].x), std::max(hi.y, x[i].y)};
    r_max = std::max(r_max, r[i]);
  }
  // Fragments may fly far: the grid is bounded to a few cells per grain, larger cells then.
  double cell = 2.0 * r_max + reach;
  const double limit = 4.0 * static_cast<double>(x.size()) + 64.0;
  while (((hi.x - lo.x) / cell + 1.0) * ((hi.y - lo.y) / cell + 1.0) > limit) cell *= 2.0;
  const auto nx = static_cast<std::int64_t>((hi.x - lo.x) / cell) + 1;
  const auto ny = static_cast<std::int64_t>((hi.y - lo.y) / cell) + 1;
  std::vector<std::int32_t> first(static_cast<std::size_t>(nx * ny), -1), next(x.size(), -1);
  const auto cell_of = [&](Vec2 p) {
    return static_cast<std::int64_t>((p.y - lo.y) / cell) * nx +
           static_cast<std::int64_t>((p.x - lo.x) / cell);
  };
  for (std::size_t i = 0; i < x.size(); ++i) {
    const auto c = static_cast<std::size_t>(cell_of(x[i]));
    next[i] = first[c];
    first[c] = static_cast<std::int32_t>(i);
  }
  const auto match = [&](std::size_t i, std::int32_t j) {
    for (; j >= 0; j = next[static_cast<std::size_t>(j)]) {
      const auto k = static_cast<std::size_t>(j);
      const Vec2 d = x[k] - x[i];
      const double touch = r[i] + r[k] + reach;
      if (k != i && dot(d, d) < touch * touch)
        pairs.push_back(pair_key(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(k)));
    }
  };
  for (std::int64_t cy = 0; cy < ny; ++cy) {
    for (std::int64_t cx = 0; cx < nx; ++cx) {
      for (std::int32_t i = first[static_cast<std::size_t>(cy * nx + cx)]; i >= 0;
           i = next[static_cast<std::size_t>(i)]) {
        const auto a = static_cast<std::size_t>(i);
        match(a, next[a]);
        if (cx + 1 < nx) match(a, first[static_cast<std::size_t>(cy * nx + cx + 1)]);
        if (cy + 1 < ny)
          for (std::int64_t ox = std::max<std::int64_t>(cx - 1, 0); ox <= std::min(cx + 1, nx - 1); ++ox)
            match(a, first[static_cast<std::size_t>((cy + 1) * nx + ox)]);
      }
    }
  }
}

}  // namespace phy
