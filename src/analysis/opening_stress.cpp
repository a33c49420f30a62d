#include "analysis/opening_stress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/check.hpp"
#include "base/clusters.hpp"
#include "base/exact_math.hpp"

namespace phy::analysis {
namespace {

/// Pieces of a branch, each of which belongs to one sector or none.
constexpr int n_pieces = 32;
constexpr double degrees = 180.0 / pi;

Vec2 start_of(const Packing& packing, std::size_t grain) {
  return {packing.discs[grain].x, packing.discs[grain].y};
}
Vec2 displacement(const Snapshot& shot, std::size_t grain) {
  return {shot.grains[grain].ux, shot.grains[grain].uy};
}

/// The sector, or ray, whose middle is nearest to a direction.
std::size_t sector_of(Vec2 direction, std::size_t n) {
  const double turns = std::atan2(direction.y, direction.x) / (2.0 * pi) + 1.0;
  // A turn more, so that nothing is negative before it is taken modulo.
  return static_cast<std::size_t>(std::floor(turns * static_cast<double>(n) + 0.5)) % n;
}

/// Sum of F_i dl_j / r over the branch from a to b, its places from the centre.
void add_branch(Vec2 a, Vec2 b, Vec2 force, const Ring& ring, std::vector<SectorStress>& sums) {
  const Vec2 piece = (1.0 / n_pieces) * (b - a);
  for (int k = 0; k < n_pieces; ++k) {
    const Vec2 at = a + (k + 0.5) * piece;
    const double r = norm(at);
    // A branch may leave the ring on either side, and by its middle only.
    if (r < ring.inner || r > ring.outer) continue;
    const Vec2 radial = (1.0 / r) * at, hoop = tangent(radial);
    SectorStress& s = sums[sector_of(at, sums.size())];
    s.radial += dot(force, radial) * dot(piece, radial) / r;
    s.hoop += dot(force, hoop) * dot(piece, hoop) / r;
    s.shear += 0.5 * (dot(force, radial) * dot(piece, hoop) + dot(force, hoop) * dot(piece, radial)) / r;
  }
}

/// The largest cluster of the grains that `join` has joined.
std::vector<bool> largest(Clusters& clusters, std::size_t n_grains) {
  std::vector<std::size_t> size(n_grains, 0);
  for (std::uint32_t g = 0; g < n_grains; ++g) ++size[clusters.find(g)];
  const auto most = std::max_element(size.begin(), size.end()) - size.begin();
  std::vector<bool> body(n_grains);
  for (std::uint32_t g = 0; g < n_grains; ++g) body[g] = clusters.find(g) == most;
  return body;
}

/// The body before the test: contacts that a specimen leaves unbonded never held anything.
std::vector<bool> body_at_start(const Specimen& specimen) {
  const std::size_t n = specimen.packing->discs.size();
  Clusters clusters(n);
  for (const Contact& c : specimen.contacts)
    if (c.kind == ContactKind::joint || (c.kind == ContactKind::bonded && c.sigma_c > 0.0))
      clusters.join(c.a, c.b);
  return largest(clusters, n);
}

/// What rays from the centre meet first; infinite: nothing.
class Rays {
 public:
  explicit Rays(int n) : way_(static_cast<std::size_t>(n), std::numeric_limits<double>::infinity()) {
    for (int k = 0; k < n; ++k) {
      const SinCos a = sin_cos_degrees(360.0 * k / n);
      ray_.push_back({a.cos, a.sin});
    }
  }

  /// `x`: from the centre.
  void meet(Vec2 x, double r) {
    for (std::size_t k = 0; k < way_.size(); ++k) {
      const double across = cross(ray_[k], x), along = dot(ray_[k], x);
      if (std::fabs(across) >= r) continue;
      // Where it enters and leaves the grain; one behind the centre is another ray's.
      const double chord = std::sqrt(r * r - across * across);
      if (along + chord > 0.0) way_[k] = std::min(way_[k], std::max(0.0, along - chord));
    }
  }
  const std::vector<double>& way() const { return way_; }

 private:
  std::vector<double> way_;
  std::vector<Vec2> ray_;
};

}  // namespace

std::vector<SectorStress> stress_around(const Packing& packing, const Snapshot& snapshot, const Ring& ring,
                                        int n_sectors) {
  PHY_CHECK(n_sectors >= 1 && ring.inner > 0.0 && ring.outer > ring.inner, "sectors of a ring");
  std::vector<SectorStress> sectors(static_cast<std::size_t>(n_sectors));
  for (const ContactState& c : snapshot.contacts) {
    const auto place = [&](std::uint32_t g) {
      return start_of(packing, g) + displacement(snapshot, g) - ring.centre;
    };
    const Vec2 a = place(c.a), b = place(c.b);
    // Most contacts are far away; only the others are worth their pieces.
    if (std::min(norm(a), norm(b)) - norm(b - a) > ring.outer || std::max(norm(a), norm(b)) < ring.inner)
      continue;
    add_branch(a, b, c.F_n * c.normal + c.F_s * tangent(c.normal), ring, sectors);
  }
  const double w = 2.0 * pi / n_sectors;
  for (std::size_t k = 0; k < sectors.size(); ++k) {
    SectorStress& s = sectors[k];
    s.angle = 360.0 * static_cast<double>(k) / n_sectors;
    for (double* sum : {&s.radial, &s.hoop, &s.shear}) *sum /= w * (ring.outer - ring.inner);
  }
  return sectors;
}

std::vector<bool> standing_body(const Specimen& specimen, const Snapshot& snapshot) {
  const std::size_t n = specimen.packing->discs.size();
  PHY_CHECK(snapshot.grains.size() == n, "a snapshot holds every grain of its packing");
  Clusters clusters(n);
  for (const ContactState& c : snapshot.contacts)
    if (c.kind != ContactKind::touching && !c.broken) clusters.join(c.a, c.b);
  return largest(clusters, n);
}

WallMotion wall_motion(const Specimen& specimen, const Snapshot& snapshot, const OpeningPlace& opening,
                       int n_sectors, const Snapshot* since) {
  PHY_CHECK(n_sectors >= 1 && opening.radius > 0.0, "sectors of a wall");
  const std::vector<bool> body = standing_body(specimen, snapshot);
  const auto n = static_cast<std::size_t>(n_sectors);
  std::vector<double> sum(n, 0.0), count(n, 0.0);
  for (std::size_t g = 0; g < body.size(); ++g) {
    const Vec2 x = start_of(*specimen.packing, g) - opening.centre;
    // The circle goes through the grain.
    if (!body[g] || std::fabs(norm(x) - opening.radius) > specimen.packing->discs[g].r) continue;
    Vec2 u = displacement(snapshot, g);
    if (since != nullptr) u = u - displacement(*since, g);
    const std::size_t k = sector_of(x, n);
    sum[k] -= dot(u, x) / norm(x), count[k] += 1.0;
  }
  WallMotion wall;
  double all = 0.0, n_known = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    wall.inwards.push_back(count[k] > 0.0 ? sum[k] / count[k] : nan);
    if (count[k] > 0.0) all += wall.inwards[k], n_known += 1.0;
  }
  // Sectors and not grains have equal weights: where the wall is coarse it is as long.
  if (n_known > 0.0) wall.closure = all / n_known / opening.radius;
  return wall;
}

std::vector<double> breakout_depths(const Specimen& specimen, const Snapshot& snapshot, Vec2 centre,
                                    int n_rays) {
  PHY_CHECK(n_rays >= 1, "rays");
  const std::vector<bool> was = body_at_start(specimen), is = standing_body(specimen, snapshot);
  Rays before(n_rays), now(n_rays);
  for (std::size_t g = 0; g < is.size(); ++g) {
    const Vec2 x = start_of(*specimen.packing, g) - centre;
    const double r = specimen.packing->discs[g].r;
    if (was[g]) before.meet(x, r);
    if (is[g]) now.meet(x + displacement(snapshot, g), r);
  }
  std::vector<double> depths;
  for (std::size_t k = 0; k < before.way().size(); ++k)
    depths.push_back(std::isfinite(before.way()[k]) ? now.way()[k] - before.way()[k] : nan);
  return depths;
}

Breakout breakout_of(std::span<const double> depths, double least) {
  Breakout b;
  double deepest = least;  // that is a number: what goes through to the outside weighs as much
  for (const double d : depths)
    if (d > least)
      b.depth = std::max(b.depth, d), deepest = std::isfinite(d) ? std::max(deepest, d) : deepest;
  if (b.depth == 0.0) return b;
  const double step = 360.0 / static_cast<double>(depths.size());
  const auto angle = [&](std::size_t k) { return step * static_cast<double>(k); };
  Vec2 sum;
  double weights = 0.0;
  for (std::size_t k = 0; k < depths.size(); ++k) {
    if (!(depths[k] > least)) continue;
    const SinCos twice = sin_cos_degrees(2.0 * angle(k));
    const double weight = std::min(depths[k], deepest);
    sum = sum + weight * Vec2{twice.cos, twice.sin}, weights += weight;
  }
  b.direction = 0.5 * degrees * std::atan2(sum.y, sum.x);
  // An axis has no sense: the upper end names it.
  if (b.direction < 0.0) b.direction += 180.0;
  b.clarity = norm(sum) / weights;
  for (std::size_t k = 0; k < depths.size(); ++k)
    if (depths[k] > least) b.width[sin_cos_degrees(angle(k) - b.direction).cos >= 0.0 ? 0 : 1] += step;
  return b;
}

}  // namespace phy::analysis
