#include "engine/jacket.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "base/exact_math.hpp"

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

std::vector<Vec2> side_areas(std::span<const Vec2> x, std::span<const double> r, double height,
                             double spacing) {
  Rays left(height, spacing), right(height, spacing);
  // Grains of a row are sorted by x: on either side those nearest to it come first, and the test above skips
  // most of the others.
  for (std::size_t g = 0; g < x.size(); ++g) left.meet(g, x[g].x, x[g].y, r[g]);
  for (std::size_t g = x.size(); g-- > 0;) right.meet(g, -x[g].x, x[g].y, r[g]);
  std::vector<Vec2> areas(x.size());
  for (const std::int64_t g : left.grain)
    if (g >= 0) areas[static_cast<std::size_t>(g)].x += left.h;
  for (const std::int64_t g : right.grain)
    if (g >= 0) areas[static_cast<std::size_t>(g)].x -= right.h;
  return areas;
}

namespace {

/// What rays from the middle of a hole have met so far. They begin half-way to its wall: what has fallen
/// nearer holds nothing.
struct Spokes {
  Vec2 centre;
  double begin;
  std::vector<Vec2> direction;
  std::vector<double> way;          // to what each has met first
  std::vector<std::int64_t> grain;  // -1: none

  Spokes(const Hole& hole, double spacing) : centre(hole.centre), begin(0.5 * hole.radius) {
    const double n = std::ceil(2.0 * pi * hole.radius / spacing);
    for (double k = 0.0; k < n; k += 1.0) {
      const SinCos at = sin_cos_degrees(360.0 * k / n);
      direction.push_back({at.cos, at.sin});
    }
    way.assign(direction.size(), std::numeric_limits<double>::infinity());
    grain.assign(direction.size(), -1);
  }

  void meet(std::size_t g, Vec2 x, double r) {
    const Vec2 off = x - centre;
    const double far = norm(off);
    const auto n = static_cast<double>(direction.size());
    // Rays that may pass within r, and one more to either side.
    const double half = far > r ? std::asin(r / far) / (2.0 * pi) * n + 1.0 : 0.5 * n;
    const double middle = std::atan2(off.y, off.x) / (2.0 * pi) * n + n;
    for (double k = std::ceil(middle - half); k <= middle + half; k += 1.0)
      meet(g, static_cast<std::size_t>(k) % direction.size(), off, r);
  }

  void meet(std::size_t g, std::size_t ray, Vec2 off, double r) {
    const double across = cross(direction[ray], off), along = dot(direction[ray], off);
    if (std::fabs(across) >= r) return;
    const double chord = std::sqrt(r * r - across * across);
    // Behind the begin of the ray, or not before what it has met.
    if (along + chord <= begin || along - chord >= way[ray]) return;
    way[ray] = std::max(begin, along - chord);
    grain[ray] = static_cast<std::int64_t>(g);
  }

  /// The surface from one ray to the next, pointing into the rock; half of it belongs to either grain.
  void share(std::size_t ray, std::vector<Vec2>& areas) const {
    const std::size_t next = (ray + 1) % direction.size();
    if (grain[ray] < 0 || grain[next] < 0) return;
    const Vec2 piece = way[next] * direction[next] - way[ray] * direction[ray];
    for (const std::size_t end : {ray, next}) {
      Vec2& area = areas[static_cast<std::size_t>(grain[end])];
      area = area + 0.5 * Vec2{piece.y, -piece.x};
    }
  }
};

}  // namespace

std::vector<Vec2> hole_areas(std::span<const Vec2> x, std::span<const double> r, const Hole& hole,
                             double spacing) {
  Spokes spokes(hole, spacing);
  for (std::size_t g = 0; g < x.size(); ++g) spokes.meet(g, x[g], r[g]);
  std::vector<Vec2> areas(x.size());
  for (std::size_t ray = 0; ray < spokes.direction.size(); ++ray) spokes.share(ray, areas);
  return areas;
}

}  // namespace phy::engine
