#include "statics/network.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "contact/wall.hpp"

namespace phy::statics {
namespace {

double wrapped(double distance, double period) {
  // Half a period away both images are equally near; rounding up takes one of them always.
  return period > 0.0 ? -period * std::floor(distance / period + 0.5) : 0.0;
}

double gap_of(const Specimen& s, const Contact& c, Vec2 branch) {
  return norm(branch) - s.packing->discs[c.a].r - s.packing->discs[c.b].r;
}

/// From a to the nearest image of b.
Vec2 branch_of(const Specimen& s, const Contact& c, Vec2 shift) {
  const Disc& a = s.packing->discs[c.a];
  const Disc& b = s.packing->discs[c.b];
  return Vec2{b.x - a.x, b.y - a.y} + shift;
}

Link link_of(const Specimen& s, const Contact& c, Vec2 period, const contact::Models& models) {
  PHY_CHECK(c.a < s.packing->discs.size() && c.b < s.packing->discs.size(), "a contact joins two discs");
  PHY_CHECK(c.kind != ContactKind::joint || c.set < s.n_laid(), "a joint belongs to a bedding set");
  // A lattice continues beyond its box: the second grain may be the image in the next cell.
  const Vec2 straight = branch_of(s, c, {0.0, 0.0});
  Link l;
  l.a = c.a, l.b = c.b;
  l.shift = {wrapped(straight.x, period.x), wrapped(straight.y, period.y)};
  const Vec2 branch = branch_of(s, c, l.shift);
  const double gap = gap_of(s, c, branch);
  l.branch = (1.0 / norm(branch)) * branch;
  // The contact point lies in the middle of gap or overlap, as in the force loop.
  l.arm_a = s.packing->discs[c.a].r + 0.5 * gap, l.arm_b = s.packing->discs[c.b].r + 0.5 * gap;
  const contact::ContactModel& model = models.of(c.kind);
  l.n = model.normal(s, c, l.branch);
  l.k = model.elastic(s, c, gap);
  l.unilateral = l.k.unilateral.k_n > 0.0;
  return l;
}

/// A smooth platen only pushes; glued ones hold.
bool frictionless(const Link& platen) { return platen.unilateral; }

laws::Tangent<double> operator+(laws::Tangent<double> a, laws::Tangent<double> b) {
  return {a.k_n + b.k_n, a.k_s + b.k_s, a.k_m + b.k_m, a.k_ns + b.k_ns, a.k_nm + b.k_nm, a.k_sm + b.k_sm};
}

}  // namespace

Network make_network(const Specimen& specimen, Vec2 period) {
  return make_network(specimen, period, contact::models_of(specimen));
}

Network make_network(const Specimen& specimen, Vec2 period, const contact::Models& models) {
  Network net;
  net.models = models;
  net.n_grains = specimen.packing->discs.size();
  net.n_contacts = specimen.contacts.size();
  double radii = 0.0;
  for (const Disc& d : specimen.packing->discs) net.x.push_back({d.x, d.y}), radii += d.r;
  // The mean radius: what compares rotations with displacements.
  if (net.n_grains > 0) net.length = radii / static_cast<double>(net.n_grains);
  // In the order of the contacts, on which the bits of all sums depend.
  net.links.reserve(specimen.contacts.size());
  for (const Contact& c : specimen.contacts) net.links.push_back(link_of(specimen, c, period, models));
  return net;
}

void add_platens(Network& net, const Specimen& specimen, Platens platens) {
  const Packing& packing = *specimen.packing;
  for (const bool top : {false, true}) {
    const auto body = static_cast<std::uint32_t>(net.x.size());
    net.x.push_back({0.5 * packing.width, top ? packing.height : 0.0});
    for (std::uint32_t i = 0; i < packing.discs.size(); ++i) {
      const Disc& d = packing.discs[i];
      // By the tolerance of bonds: discs are settled against the walls, and touch them to rounding.
      if ((top ? packing.height - d.y : d.y) - d.r > contact::touching_gap * d.r) continue;
      Link l;
      l.a = body, l.b = i;
      l.branch = l.n = {0.0, top ? -1.0 : 1.0};
      l.arm_b = d.r;  // a platen does not turn: its own arm never acts
      l.unilateral = platens == Platens::frictionless;
      l.k.unilateral = contact::wall::elastic(specimen.matrix, l.unilateral);
      net.links.push_back(l);
    }
  }
}

laws::Tangent<double> stiffness(const Link& l, bool active) {
  return active ? l.k.unilateral + l.k.bilateral : l.k.bilateral;
}

std::vector<laws::Tangent<double>> stiffness_rates(const Network& net, const Specimen& s,
                                                   const std::vector<char>& active,
                                                   const contact::ElasticParameter& p, std::uint8_t set) {
  std::vector<laws::Tangent<double>> rates(net.links.size(), laws::Tangent<double>{0.0, 0.0, 0.0});
  for (std::size_t i = 0; i < net.n_contacts; ++i) {
    const Contact& c = s.contacts[i];
    // A parameter of one set moves its own joints alone.
    if (p.bedding != nullptr && (c.kind != ContactKind::joint || s.set_of(c.set) != set)) continue;
    const double gap = gap_of(s, c, branch_of(s, c, net.links[i].shift));
    const contact::ElasticPart rate = net.models.of(c.kind).elastic_rate(s, c, gap, p);
    rates[i] = active[i] ? rate.unilateral + rate.bilateral : rate.bilateral;
  }
  for (std::size_t i = net.n_contacts; i < net.links.size(); ++i)
    if (active[i]) rates[i] = contact::wall::elastic_rate(s.matrix, frictionless(net.links[i]), p);
  return rates;
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

std::array<double, 3> resistance(const laws::Tangent<double>& k, const std::array<double, 3>& strains) {
  std::array<double, 3> q{k.k_n * strains[0], k.k_s * strains[1], k.k_m * strains[2]};
  if (!k.coupled()) return q;
  q[0] += k.k_ns * strains[1] + k.k_nm * strains[2];
  q[1] += k.k_ns * strains[0] + k.k_sm * strains[2];
  q[2] += k.k_nm * strains[0] + k.k_sm * strains[1];
  return q;
}

std::array<double, 3> forces(const laws::Tangent<double>& k, const std::array<double, 3>& strains) {
  const std::array<double, 3> q = resistance(k, strains);
  return {q[0], -q[1], -q[2]};
}

std::vector<laws::Tangent<double>> stiffnesses(const Network& net, const std::vector<char>& active) {
  std::vector<laws::Tangent<double>> k;
  k.reserve(net.links.size());
  for (std::size_t i = 0; i < net.links.size(); ++i) k.push_back(stiffness(net.links[i], active[i] != 0));
  return k;
}

}  // namespace phy::statics
