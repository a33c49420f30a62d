#include "statics/network.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "laws/laws.hpp"

namespace phy {
namespace {

double wrapped(double distance, double period) {
  return period > 0.0 ? -period * std::floor(distance / period + 0.5) : 0.0;
}

Link link_of(const Specimen& s, const Contact& c, Vec2 period) {
  PHY_CHECK(c.a < s.packing->discs.size() && c.b < s.packing->discs.size(), "a contact joins two discs");
  PHY_CHECK(c.kind != ContactKind::joint || c.set < s.bedding.size(), "a joint belongs to a bedding set");
  const Disc& a = s.packing->discs[c.a];
  const Disc& b = s.packing->discs[c.b];
  Link l;
  l.a = c.a, l.b = c.b;
  l.shift = {wrapped(b.x - a.x, period.x), wrapped(b.y - a.y, period.y)};
  const Vec2 branch = Vec2{b.x - a.x, b.y - a.y} + l.shift;
  const double d = norm(branch), gap = d - a.r - b.r;
  l.branch = (1.0 / d) * branch;
  l.n = l.branch;
  l.arm_a = a.r + 0.5 * gap, l.arm_b = b.r + 0.5 * gap;
  if (c.kind == ContactKind::joint) {
    const BeddingRecipe& set = s.bedding[c.set];
    const SinCos angle = sin_cos_degrees(set.theta);
    l.n = static_cast<double>(c.side) * Vec2{-angle.sin, angle.cos};
    l.joint = smooth_joint::area(set.radius_multiplier, a.r, b.r);
    l.set = c.set;
    return l;
  }
  l.unilateral = true;
  if (gap <= touching_gap * 0.5 * (a.r + b.r))
    l.linear = linear::stiffness_factor(s.matrix.stiffness_convention == StiffnessConvention::pfc5, a.r, b.r);
  if (c.kind == ContactKind::bonded) {
    const parallel_bond::Geometry g = parallel_bond::geometry(s.matrix.radius_multiplier, a.r, b.r);
    l.bond = g.A / g.L, l.bend = g.I / g.L;
  }
  return l;
}

Tangent<double> operator+(Tangent<double> a, Tangent<double> b) {
  return {a.k_n + b.k_n, a.k_s + b.k_s, a.k_m + b.k_m};
}

}  // namespace

Network make_network(const Specimen& specimen, Vec2 period) {
  Network net;
  net.n_grains = specimen.packing->discs.size();
  net.matrix = specimen.matrix;
  net.bedding = specimen.bedding;
  double radii = 0.0;
  for (const Disc& d : specimen.packing->discs) net.x.push_back({d.x, d.y}), radii += d.r;
  if (net.n_grains > 0) net.length = radii / static_cast<double>(net.n_grains);
  net.links.reserve(specimen.contacts.size());
  for (const Contact& c : specimen.contacts) net.links.push_back(link_of(specimen, c, period));
  return net;
}

void add_platens(Network& net, const Specimen& specimen, Platens platens) {
  const Packing& packing = *specimen.packing;
  for (const bool top : {false, true}) {
    const auto body = static_cast<std::uint32_t>(net.x.size());
    net.x.push_back({0.5 * packing.width, top ? packing.height : 0.0});
    for (std::uint32_t i = 0; i < packing.discs.size(); ++i) {
      const Disc& d = packing.discs[i];
      if ((top ? packing.height - d.y : d.y) - d.r > touching_gap * d.r) continue;
      Link l;
      l.a = body, l.b = i;
      l.branch = l.n = {0.0, top ? -1.0 : 1.0};
      l.arm_b = d.r;  // a platen does not turn: its own arm never acts
      l.linear = linear::wall_stiffness_factor;
      l.unilateral = l.smooth = platens == Platens::frictionless;
      net.links.push_back(l);
    }
  }
}

Tangent<double> stiffness(const Network& net, const Link& l, bool active) {
  const MatrixRecipe& m = net.matrix;
  Tangent<double> k{0.0, 0.0, 0.0};
  if (active && l.linear > 0.0) {
    const double k_n = m.E_c * l.linear, k_s = l.smooth ? 0.0 : m.ks_over_kn * k_n;
    k = k + linear::tangent(linear::Parameters<double>{k_n, k_s, 0.0, m.mu});
  }
  if (l.bond > 0.0) {
    const double k_n = m.E_b * l.bond;
    k = k + parallel_bond::tangent(parallel_bond::Parameters<double>{k_n, m.bond_ks_over_kn * k_n,
                                                                     m.E_b * l.bend, 0.0, 0.0, 0.0, 0.0});
  }
  if (l.joint > 0.0) {
    const BeddingRecipe& set = net.bedding[l.set];
    k = k + smooth_joint::tangent(smooth_joint::Parameters<double>{set.k_n * l.joint, set.k_s * l.joint,
                                                                   set.mu, 0.0, 0.0, 0.0, 0.0});
  }
  return k;
}

Tangent<double> stiffness_rate(const Network& net, const Link& l, bool active, Parameter p) {
  const MatrixRecipe& m = net.matrix;
  const double push = active ? l.linear : 0.0, rub = l.smooth ? 0.0 : push;
  const double joint = l.joint > 0.0 && l.set == p.set ? l.joint : 0.0;
  switch (p.what) {
    case Parameter::What::E_c: return {push, m.ks_over_kn * rub, 0.0};
    case Parameter::What::E_b: return {l.bond, m.bond_ks_over_kn * l.bond, l.bend};
    case Parameter::What::ks_over_kn: return {0.0, m.E_c * rub, 0.0};
    case Parameter::What::bond_ks_over_kn: return {0.0, m.E_b * l.bond, 0.0};
    case Parameter::What::k_n: return {joint, 0.0, 0.0};
    case Parameter::What::k_s: return {0.0, joint, 0.0};
  }
  return {0.0, 0.0, 0.0};
}

LinkRows rows(const Link& l) {
  const Vec2 n = l.n, t = tangent(l.n), roll = tangent(l.branch);
  const double rn = dot(roll, n), rt = dot(roll, t);
  return {{{n.x, n.y, l.arm_a * rn, -n.x, -n.y, l.arm_b * rn},
           {-t.x, -t.y, -l.arm_a * rt, t.x, t.y, -l.arm_b * rt},
           {0.0, 0.0, -1.0, 0.0, 0.0, 1.0}}};
}

std::array<double, 3> strains(const Link& l, std::span<const double> u, const Gradient& gradient) {
  const std::size_t a = 3 * std::size_t{l.a}, b = 3 * std::size_t{l.b};
  const Vec2 roll = tangent(l.branch);
  const Vec2 image = gradient(l.shift);
  const double turn = u[a + 2] * l.arm_a + u[b + 2] * l.arm_b;
  const Vec2 d{u[b] - u[a] + image.x - turn * roll.x, u[b + 1] - u[a + 1] + image.y - turn * roll.y};
  return {-dot(l.n, d), dot(tangent(l.n), d), u[b + 2] - u[a + 2]};
}

std::array<double, 3> forces(const Tangent<double>& k, const std::array<double, 3>& strains) {
  return {k.k_n * strains[0], -k.k_s * strains[1], -k.k_m * strains[2]};
}

std::vector<Tangent<double>> stiffnesses(const Network& net, const std::vector<char>& active) {
  std::vector<Tangent<double>> k;
  k.reserve(net.links.size());
  for (std::size_t i = 0; i < net.links.size(); ++i)
    k.push_back(stiffness(net, net.links[i], active[i] != 0));
  return k;
}

}  // namespace phy
