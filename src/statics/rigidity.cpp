#include "statics/rigidity.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/clusters.hpp"

namespace phy::statics {
namespace {

using Row = std::array<double, 3>;  // over a rigid motion (v_x, v_y, spin times length) about the origin of
                                    // the network

/// One resisted relative motion of two bodies.
struct Hold {
  std::uint32_t a, b;
  Row row;
};

/// Rank 3? Gram-Schmidt with the largest remaining row first. The smallest row of a sound pair is about the
/// ratio of a grain to the specimen, 1e-3; rounding leaves 1e-14.
bool leaves_no_motion(std::vector<Row> rows) {
  constexpr double tiny = 1e-8;
  // Three rigid motions in the plane need three independent rows.
  for (int rank = 0; rank < 3; ++rank) {
    const auto size = [](const Row& r) { return r[0] * r[0] + r[1] * r[1] + r[2] * r[2]; };
    const auto big = std::max_element(rows.begin(), rows.end(),
                                      [&](const Row& x, const Row& y) { return size(x) < size(y); });
    if (big == rows.end() || !(size(*big) > tiny * tiny)) return false;
    // The longest first: small rows that are left of it are rounding.
    const Row unit = *big;
    const double inverse = 1.0 / size(unit);
    for (Row& r : rows) {
      const double share = (r[0] * unit[0] + r[1] * unit[1] + r[2] * unit[2]) * inverse;
      for (std::size_t i = 0; i < 3; ++i) r[i] -= share * unit[i];
    }
  }
  return true;
}

/// A stiffness that couples resists what its own rows resist: closure is against n, hence the sign. Rotations
/// are compared with displacements by the network's length.
void add_coupled(const Network& net, const Link& l, const laws::Tangent<double>& k,
                 const std::array<Row, 3>& motion, std::vector<Hold>& holds) {
  const double h = net.length, size = std::max({k.k_n, k.k_s, k.k_m / (h * h)});
  const double K[3][3] = {{k.k_n, -k.k_ns, -k.k_nm / h},
                          {-k.k_ns, k.k_s, k.k_sm / h},
                          {-k.k_nm / h, k.k_sm / h, k.k_m / (h * h)}};
  for (const auto& of : K) {
    Row row{};
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t i = 0; i < 3; ++i) row[i] += of[j] / size * motion[j][i];
    holds.push_back({l.a, l.b, row});
  }
}

/// Rows of a link against the rigid motion of b's cluster relative to a's.
void add_holds(const Network& net, const Link& l, const laws::Tangent<double>& k, std::vector<Hold>& holds) {
  const double scale = 1.0 / net.length;
  const Vec2 at = net.x[l.b] - l.arm_b * l.branch;  // a platen has no place, its grain has
  const auto along = [&](Vec2 axis) { return Row{axis.x, axis.y, cross(at, axis) * scale}; };
  if (k.coupled())
    return add_coupled(net, l, k, {along(l.n), along(tangent(l.n)), Row{0.0, 0.0, 1.0}}, holds);
  if (k.k_n > 0.0) holds.push_back({l.a, l.b, along(l.n)});
  if (k.k_s > 0.0) holds.push_back({l.a, l.b, along(tangent(l.n))});
  if (k.k_m > 0.0) holds.push_back({l.a, l.b, {0.0, 0.0, 1.0}});
}

/// One round: joins all pairs of clusters without relative motion. False when nothing was joined.
bool merge_pairs(std::vector<Hold>& holds, Clusters& clusters) {
  std::vector<Hold> open;
  for (Hold h : holds) {
    h.a = clusters.find(h.a), h.b = clusters.find(h.b);
    if (h.a == h.b) continue;
    if (h.b < h.a) std::swap(h.a, h.b);  // the sign of a row does not matter
    open.push_back(h);
  }
  std::stable_sort(open.begin(), open.end(),
                   [](const Hold& x, const Hold& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
  bool merged = false;
  for (std::size_t i = 0, j = 0; i < open.size(); i = j) {
    while (j < open.size() && open[j].a == open[i].a && open[j].b == open[i].b) ++j;
    std::vector<Row> rows;
    for (std::size_t h = i; h < j; ++h) rows.push_back(open[h].row);
    if (!leaves_no_motion(std::move(rows))) continue;
    clusters.join(open[i].a, open[i].b);
    merged = true;
  }
  holds = std::move(open);
  return merged;
}

}  // namespace

std::vector<char> loose_bodies(const Network& net, const std::vector<laws::Tangent<double>>& k,
                               const std::vector<Freedom>& prescribed) {
  const auto n = static_cast<std::uint32_t>(net.x.size());
  Clusters clusters(n + 1);  // the last one is the ground
  std::vector<Hold> holds;
  for (std::size_t i = 0; i < net.links.size(); ++i) {
    const Link& l = net.links[i];
    if (l.shift.x != 0.0 || l.shift.y != 0.0)
      holds.push_back({l.a, n, {0.0, 0.0, k[i].k_n > 0.0 ? 1.0 : 0.0}});
    else if (k[i].k_n > 0.0 && k[i].k_s > 0.0 && k[i].k_m > 0.0 && !k[i].coupled())
      clusters.join(l.a, l.b);
    else
      add_holds(net, l, k[i], holds);
  }
  for (const Freedom& f : prescribed) {
    const Vec2 axis{f.component == 0 ? 1.0 : 0.0, f.component == 1 ? 1.0 : 0.0};
    const double spin = f.component == 2 ? 1.0 : cross(net.x[f.body], axis) / net.length;
    holds.push_back({f.body, n, {axis.x, axis.y, spin}});
  }
  while (merge_pairs(holds, clusters)) {
  }
  std::vector<char> loose(n);
  for (std::uint32_t i = 0; i < n; ++i) loose[i] = clusters.find(i) != clusters.find(n);
  return loose;
}

std::vector<std::uint32_t> connected_parts(const Network& net, const std::vector<laws::Tangent<double>>& k) {
  Clusters clusters(net.x.size());
  for (std::size_t i = 0; i < net.links.size(); ++i)
    if (k[i].k_n > 0.0 || k[i].k_s > 0.0) clusters.join(net.links[i].a, net.links[i].b);
  std::vector<std::uint32_t> part(net.x.size());
  for (std::uint32_t i = 0; i < part.size(); ++i) part[i] = clusters.find(i);
  return part;
}

}  // namespace phy::statics
