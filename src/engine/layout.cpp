#include "engine/layout.hpp"

#include <algorithm>
#include <numeric>

namespace phy::engine {

Layout make_layout(const Packing& packing, double skin) {
  double r_max = 0.0;
  for (const Disc& d : packing.discs) r_max = std::max(r_max, d.r);
  // Centres of two grains within the skin lie at most 2 r_max + skin apart, so the pair joins a row with
  // itself or the next; 5 % are margin.
  const double height = 2.0 * r_max * 1.05 + skin;
  const auto n = static_cast<std::int32_t>(packing.discs.size());
  const auto row = [&](std::int32_t i) {
    return std::max(0, static_cast<int>(packing.discs[static_cast<std::size_t>(i)].y / height));
  };
  Layout layout;
  layout.order.resize(packing.discs.size());
  std::iota(layout.order.begin(), layout.order.end(), 0);
  // Ties by number: the order decides the order of sums, and so every bit.
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
    // An empty row starts where the next one does.
    while (layout.row_grain.size() <= static_cast<std::size_t>(row(i))) layout.row_grain.push_back(s);
  }
  layout.row_grain.push_back(n);
  return layout;
}

GaugeWeights gauge_weights(const Packing& packing) {
  const std::size_t n = packing.discs.size();
  std::vector<char> inside(n);
  double count = 0.0;
  Vec2 mean;
  for (std::size_t i = 0; i < n; ++i) {
    const Disc& d = packing.discs[i];
    // Without the ends, whose strain the friction of the platens disturbs.
    inside[i] = d.y > 0.2 * packing.height && d.y < 0.8 * packing.height;
    if (!inside[i]) continue;
    count += 1.0;
    mean = {mean.x + d.x, mean.y + d.y};
  }
  GaugeWeights w{std::vector<double>(n), std::vector<double>(n)};
  // Three unknowns: fewer grains, or grains on a line, have no gradient and the gauge reads zero.
  if (count < 3.0) return w;
  mean = (1.0 / count) * mean;
  // Normal equations about the centroid, which makes the constant drop out.
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
