#include "engine/layout.hpp"

#include <algorithm>
#include <numeric>

namespace phy::engine {

Layout make_layout(const Packing& packing, double skin) {
  double r_max = 0.0;
  for (const Disc& d : packing.discs) r_max = std::max(r_max, d.r);
  const double height = 2.0 * r_max * 1.05 + skin;
  const auto n = static_cast<std::int32_t>(packing.discs.size());
  const auto row = [&](std::int32_t i) {
    return std::max(0, static_cast<int>(packing.discs[static_cast<std::size_t>(i)].y / height));
  };
  Layout layout;
  layout.order.resize(packing.discs.size());
  std::iota(layout.order.begin(), layout.order.end(), 0);
  std::sort(layout.order.begin(), layout.order.end(), [&](std::int32_t a, std::int32_t b) {
    if (row(a) != row(b)) return row(a) < row(b);
    const double xa = packing.discs[static_cast<std::size_t>(a)].x,
                 xb = packing.discs[static_cast<std::size_t>(b)].x;
    return xa != xb ? xa < xb : a < b;
  });
  layout.rank.resize(layout.order.size());
  layout.row_of.resize(layout.order.size());
  for (std::int32_t s = 0; s < n; ++s) {
    const std::int32_t i = layout.order[static_cast<std::size_t>(s)];
    layout.rank[static_cast<std::size_t>(i)] = s;
    layout.row_of[static_cast<std::size_t>(s)] = row(i);
    while (layout.row_grain.size() <= static_cast<std::size_t>(row(i))) layout.row_grain.push_back(s);
  }
  layout.row_grain.push_back(n);
  return layout;
}

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

GaugeWeights gauge_weights(const Packing& packing) {
  const std::size_t n = packing.discs.size();
  std::vector<char> inside(n);
  double count = 0.0;
  Vec2 mean;
  for (std::size_t i = 0; i < n; ++i) {
    const Disc& d = packing.discs[i];
    inside[i] = d.y > 0.2 * packing.height && d.y < 0.8 * packing.height;
    if (!inside[i]) continue;
    count += 1.0;
    mean = {mean.x + d.x, mean.y + d.y};
  }
  GaugeWeights w{std::vector<double>(n), std::vector<double>(n)};
  if (count < 3.0) return w;
  mean = (1.0 / count) * mean;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (!inside[i]) continue;
    const Vec2 p = Vec2{packing.discs[i].x, packing.discs[i].y} - mean;
    xx += p.x * p.x, xy += p.x * p.y, yy += p.y * p.y;
  }
  const double det = xx * yy - xy * xy;
  if (!(det > 0.0)) return w;
  for (std::size_t i = 0; i < n; ++i) {
    if (!inside[i]) continue;
    const Vec2 p = Vec2{packing.discs[i].x, packing.discs[i].y} - mean;
    w.x[i] = (yy * p.x - xy * p.y) / det;
    w.y[i] = (xx * p.y - xy * p.x) / det;
  }
  return w;
}

}  // namespace phy::engine
