#include "genesis/rattlers.hpp"

#include <cmath>

#include "base/vec.hpp"
#include "genesis/near_pairs.hpp"

namespace phy::genesis {
namespace {

constexpr double growth_per_step = 1.002;  // small against the cage, or the disc would jump out of it
constexpr int slides_per_step = 60;
constexpr double slide = 0.3;  // of the force; up to six unit springs act, so below 2/6

/// What presses on one disc.
struct Touch {
  Vec2 push;
  double overlap = 0.0;
  int n = 0;
  void add(double o, Vec2 n_out) {
    if (o <= 0.0) return;
    push = push + o * n_out;
    overlap += o;
    ++n;
  }
};

Touch touch(const SettleBox& box, const Disc& d, const std::vector<Disc>& neighbours) {
  Touch t;
  t.add(d.r - d.x, {1.0, 0.0});
  t.add(d.r - (box.width - d.x), {-1.0, 0.0});
  t.add(d.r - d.y, {0.0, 1.0});
  t.add(d.r - (box.height - d.y), {0.0, -1.0});
  for (const Disc& o : neighbours) {
    const Vec2 branch{d.x - o.x, d.y - o.y};
    const double l = norm(branch);
    t.add(d.r + o.r - l, l > 0.0 ? (1.0 / l) * branch : Vec2{1.0, 0.0});
  }
  return t;
}

/// The disc grown into its cage, or unchanged.
Disc grown(const SettleBox& box, const Disc& rattler, const std::vector<Disc>& neighbours, double overlap) {
  Disc d = rattler;
  while (d.r * growth_per_step <= growth_limit * rattler.r) {
    d.r *= growth_per_step;
    Touch t = touch(box, d, neighbours);
    for (int k = 0; k < slides_per_step && t.n > 0; ++k) {
      d.x += slide * t.push.x;
      d.y += slide * t.push.y;
      t = touch(box, d, neighbours);
    }
    // Three neighbours hold a disc in the plane; pressed on as much as others are, it carries load.
    if (t.n >= 3 && t.overlap >= overlap * t.n) return d;
  }
  return rattler;
}

std::vector<std::vector<std::uint32_t>> neighbours_within(const std::vector<Disc>& discs, double reach) {
  std::vector<std::vector<std::uint32_t>> list(discs.size());
  for (const Pair& p : near_pairs(discs, reach)) {
    list[p.a].push_back(p.b);
    list[p.b].push_back(p.a);
  }
  return list;
}

}  // namespace

std::vector<std::uint32_t> find_rattlers(const SettleBox& box, const std::vector<Disc>& discs) {
  const auto near = neighbours_within(discs, 0.0);
  std::vector<std::uint32_t> rattlers;
  for (std::uint32_t i = 0; i < discs.size(); ++i) {
    std::vector<Disc> around;
    for (const std::uint32_t j : near[i]) around.push_back(discs[j]);
    // Two contacts hold a disc only if they face each other, which never happens exactly.
    if (touch(box, discs[i], around).n < 3) rattlers.push_back(i);
  }
  return rattlers;
}

long grow_rattlers(const SettleBox& box, std::vector<Disc>& discs, double overlap) {
  double r_max = 0.0;
  for (const Disc& d : discs) r_max = d.r > r_max ? d.r : r_max;
  // A growing disc may also move, by no more than about a radius before three neighbours hold it.
  const auto near = neighbours_within(discs, growth_limit * r_max);
  long n = 0;
  for (const std::uint32_t i : find_rattlers(box, discs)) {
    std::vector<Disc> around;
    for (const std::uint32_t j : near[i]) around.push_back(discs[j]);
    const Disc d = grown(box, discs[i], around, overlap);
    if (d.r > discs[i].r) ++n;
    discs[i] = d;
  }
  return n;
}

}  // namespace phy::genesis
