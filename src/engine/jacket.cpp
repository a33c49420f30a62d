#include "engine/jacket.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace phy::engine {
namespace {

/// What the rays of one side have met so far.
struct Rays {
  // Not above the wanted spacing, and such that rays fill the height exactly.
  double h;                         // of one ray
  std::vector<double> nearest;      // way along the ray, from x = 0
  std::vector<std::int64_t> grain;  // -1: none

  Rays(double height, double spacing)
      : h(height / std::ceil(height / spacing)),
        nearest(static_cast<std::size_t>(std::ceil(height / spacing)),
                std::numeric_limits<double>::infinity()),
        grain(nearest.size(), -1) {}

  /// A disc whose centre lies `way` along the rays.
  void meet(std::size_t g, double way, double y, double r) {
    const auto n = static_cast<double>(nearest.size());
    // Rays run at heights (k + 1/2) h: first and last that pass within r of the centre.
    const auto first = static_cast<std::size_t>(std::clamp(std::ceil((y - r) / h - 0.5), 0.0, n));
    const auto end = static_cast<std::size_t>(std::clamp(std::ceil((y + r) / h - 0.5), 0.0, n));
    for (std::size_t k = first; k < end; ++k) {
      // Even its foremost point lies behind what this ray has met.
      if (way - r >= nearest[k]) continue;
      const double across = (static_cast<double>(k) + 0.5) * h - y;
      const double met = way - std::sqrt(std::max(0.0, r * r - across * across));
      if (met < nearest[k]) nearest[k] = met, grain[k] = static_cast<std::int64_t>(g);
    }
  }
};

}  // namespace

std::vector<double> jacket_heights(std::span<const Vec2> x, std::span<const double> r, double height,
                                   double spacing) {
  Rays left(height, spacing), right(height, spacing);
  // Grains of a row are sorted by x: on either side those nearest to it come first, and the test above skips
  // most of the others.
  for (std::size_t g = 0; g < x.size(); ++g) left.meet(g, x[g].x, x[g].y, r[g]);
  for (std::size_t g = x.size(); g-- > 0;) right.meet(g, -x[g].x, x[g].y, r[g]);
  std::vector<double> heights(x.size(), 0.0);
  for (const std::int64_t g : left.grain)
    if (g >= 0) heights[static_cast<std::size_t>(g)] += left.h;
  for (const std::int64_t g : right.grain)
    if (g >= 0) heights[static_cast<std::size_t>(g)] -= right.h;
  return heights;
}

}  // namespace phy::engine
