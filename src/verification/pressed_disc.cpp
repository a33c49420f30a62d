// Discs of layered rock pressed on two arcs, against the closed form of a homogeneous disc of the same
// compliance. The compliance is measured on the disc itself, by uniform gradients, so that what is compared
// is the field of the whole body and not a modulus. All contacts also pull: the closed form knows no crack.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "base/exact_math.hpp"
#include "base/stats.hpp"
#include "genesis/cut.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "records/assembly.hpp"
#include "statics/crack_tip.hpp"
#include "statics/rigidity.hpp"
#include "statics/system.hpp"
#include "theory/anisotropic_disc.hpp"
#include "verification/cases.hpp"

namespace phy::verification {
namespace {

constexpr double half_arc = 7.5;  // half a loaded arc [deg]
constexpr std::array<double, 5> thetas = {0.0, 22.5, 45.0, 67.5, 90.0};

/// Grains that no load can rest on: they are not held, as the grain in the middle is.
std::vector<char> loose_grains(const statics::Network& net) {
  const auto middle =
      std::min_element(net.x.begin(), net.x.end(), [](Vec2 a, Vec2 b) { return norm(a) < norm(b); });
  const auto held = static_cast<std::uint32_t>(middle - net.x.begin());
  const auto k = statics::stiffnesses(net, std::vector<char>(net.links.size(), 1));
  return statics::loose_bodies(net, k, {{held, 0}, {held, 1}, {held, 2}});
}

/// Pressure 1 on two arcs of +- alpha about the direction `load`: rays along the radius press on the grain
/// that they meet first.
statics::Boundary pressed(const Specimen& s, const std::vector<char>& loose, double radius, Vec2 load) {
  statics::Boundary boundary;
  const auto& discs = s.packing->discs;
  constexpr int rays = 400;
  for (const double side : {1.0, -1.0}) {
    for (int k = 0; k < rays; ++k) {
      const double turn = (2.0 * (k + 0.5) / rays - 1.0) * half_arc * pi / 180.0;
      const Vec2 d = side * (std::cos(turn) * load + std::sin(turn) * tangent(load));
      double reach = 0.0;
      std::uint32_t met = 0;
      for (std::uint32_t g = 0; g < discs.size(); ++g) {
        const Vec2 x{discs[g].x, discs[g].y};
        const double off = cross(d, x), room = discs[g].r * discs[g].r - off * off;
        if (loose[g] != 0 || room < 0.0 || dot(d, x) + std::sqrt(room) <= reach) continue;
        reach = dot(d, x) + std::sqrt(room), met = g;
      }
      const double force = radius * 2.0 * half_arc * pi / 180.0 / rays;
      boundary.loads.push_back({{met, 0}, -force * d.x});
      boundary.loads.push_back({{met, 1}, -force * d.y});
    }
  }
  return boundary;
}

/// Holds the grain farthest from the loaded diameter; it carries nothing, as the loads balance but for a
/// small couple.
void hold(statics::Boundary& boundary, const Specimen& s, const std::vector<char>& loose, Vec2 load) {
  const auto& discs = s.packing->discs;
  std::uint32_t held = 0;
  double farthest = -1.0;
  for (std::uint32_t g = 0; g < discs.size(); ++g) {
    const double off = std::fabs(cross(load, {discs[g].x, discs[g].y}));
    if (loose[g] == 0 && off > farthest) farthest = off, held = g;
  }
  for (int component = 0; component < 3; ++component) boundary.movements.push_back({{held, component}, 0.0});
}

/// Mean stress in a circle about the origin (xx, yy, xy, compression positive): Love & Weber, each contact by
/// the share of its branch inside.
std::array<double, 3> stress_in_middle(const statics::Network& net, const statics::Movements& u,
                                       double radius) {
  std::array<double, 3> sum{};
  for (const statics::Link& l : net.links) {
    constexpr int parts = 32;
    int inside = 0;
    for (int k = 0; k < parts; ++k) {
      const Vec2 x = net.x[l.a] + (k + 0.5) / parts * (net.x[l.b] - net.x[l.a]);
      if (norm(x) < radius) ++inside;
    }
    if (inside == 0) continue;
    const auto share = statics::stress_share(l, statics::stiffness(l, true), statics::strains(l, u));
    for (std::size_t i = 0; i < 3; ++i) sum[i] -= share[i] * inside / parts / (pi * radius * radius);
  }
  return sum;
}

/// Compliance in axes across (x) and along (y) the load.
theory::PlaneCompliance compliance_seen(const statics::Network& net, double radius, double margin,
                                        Vec2 load) {
  const double half = 0.5 * radius;
  const std::array<statics::Window, 1> middle = {{{{-half, -half}, {half, half}}}};
  const auto found = statics::effective_compliance(net, middle, margin, {load.y, -load.x});
  const statics::Compliance& S = found.S;
  return {S[0][0], S[1][1], S[0][1], S[0][2], S[1][2], S[2][2]};
}

/// The mean over a circle of D/8 about the centre: what the discs show beside theory.
struct Middle {
  double tension = 0.0;      ///< across the load, over theory
  double compression = 0.0;  ///< along the load, over theory
  double shear = 0.0;        ///< less that of theory, over its compression
};

Middle middle_of(const Specimen& s, double D, Vec2 load) {
  const statics::Network net = statics::make_network(s);
  const std::vector<char> loose = loose_grains(net);
  statics::Boundary boundary = pressed(s, loose, 0.5 * D, load);
  hold(boundary, s, loose, load);
  const auto m = stress_in_middle(net, statics::solve_once(net, boundary).u, D / 8.0);
  const Vec2 across{load.y, -load.x};
  const auto seen = [&](Vec2 a, Vec2 b) {
    return m[0] * a.x * b.x + m[1] * a.y * b.y + m[2] * (a.x * b.y + a.y * b.x);
  };
  const double P = D * std::sin(half_arc * pi / 180.0), margin = 4.0 * s.packing->discs.front().r;
  const theory::PlaneCompliance S = compliance_seen(net, 0.5 * D, margin, load);
  const theory::DiscStress t = theory::AnisotropicDisc({S, D, half_arc, P}).mean(D / 8.0);
  return {seen(across, across) / t.x, seen(load, load) / t.y, (seen(across, load) - t.xy) / t.y};
}

/// The disc about the origin.
void move_to_origin(Specimen& s) {
  auto packing = std::make_shared<Packing>(*s.packing);
  for (Disc& d : packing->discs) d.x -= 0.5 * packing->width, d.y -= 0.5 * packing->height;
  s.packing = std::move(packing);
}

// --- V25: a lattice

/// A disc of hexagonal lattice with a smooth joint after every `rows` rows, about the origin.
Specimen layered_lattice(double diameter, int rows) {
  constexpr double R = 2e-4;
  const int n = 2 * static_cast<int>(0.5 * diameter / (root3 * R)) + 4;  // even: no row on a plane
  Specimen s;
  auto packing = std::make_shared<Packing>();
  packing->width = packing->height = diameter, packing->hash = "by hand";
  const double middle_x = R * (n + 0.5), middle_y = R * (1.0 + root3 * 0.5 * (n - 1));
  for (const Disc& d : hexagonal(n, n, R))
    if (std::hypot(d.x - middle_x, d.y - middle_y) < 0.5 * diameter - R)
      packing->discs.push_back({d.x - middle_x, d.y - middle_y, R});
  s.packing = packing;
  s.matrix = soft_contact();
  bond_touching(s);
  BeddingRecipe set;
  set.k_n = 33.6e12, set.k_s = 9.6e12, set.spacing = rows * root3 * R;
  s.bedding.push_back(set);
  joint_crossing(s);
  return s;
}

/// The lattice stays, the load turns.
std::vector<Check> lattice_in_the_middle() {
  constexpr double D = 0.03;
  const Specimen s = layered_lattice(D, 2);
  std::vector<Check> checks;
  for (const double theta : thetas) {
    const Middle m = middle_of(s, D, {std::sin(theta * pi / 180.0), std::cos(theta * pi / 180.0)});
    const std::string at = fmt::format("theta = {:g} deg: ", theta);
    checks.push_back({at + "tension across the load over theory [-]", 1.0, m.tension, 0.03});
    checks.push_back({at + "compression along the load over theory [-]", 1.0, m.compression, 0.03});
    checks.push_back({at + "difference of the shear stresses over the compression [-]", 0.0, m.shear, 0.03});
  }
  return checks;
}

// --- V29: random packings

/// Joints of the paper's Table 2 across planes two mean diameters apart: a homogeneous disc has no spacing.
Specimen bedded_disc(const std::shared_ptr<const Packing>& disc, double theta) {
  BeddingRecipe set;
  set.rule = BeddingRule::crossing, set.theta = theta, set.spacing = 0.00133;
  Specimen s = genesis::make_specimen(disc, soft_contact(), {set}, fmt::format("theta = {:g} deg", theta));
  move_to_origin(s);
  return s;
}

/// Mean over packings, and how well they know it.
void add_mean(std::vector<Check>& checks, const std::string& what, double expected,
              const std::vector<double>& values) {
  const Summary all = summarise(values);
  checks.push_back(
      {what + fmt::format(", mean of {} packings [-]", values.size()), expected, all.mean, 0.03});
  checks.push_back({what + ", half of the 95 % interval of that mean, at most the tolerance [-]", 0.0,
                    all.half_width, 0.03});
}

/// The load stays, the layers turn.
std::vector<Check> packings_in_the_middle() {
  constexpr double D = 0.05;
  constexpr std::int64_t n_packings = 8;
  std::array<std::array<std::vector<double>, thetas.size()>, 3> all;
  for (std::int64_t p = 1; p <= n_packings; ++p) {
    Recipe r;
    r.specimen = {D, D}, r.packing.n_grains = 6476, r.packing.seed = p;
    const auto disc = std::make_shared<const Packing>(
        genesis::cut_disc(genesis::make_packing(r.specimen, r.packing, r.matrix), D));
    for (std::size_t i = 0; i < thetas.size(); ++i) {
      const Middle m = middle_of(bedded_disc(disc, thetas[i]), D, {0.0, 1.0});
      all[0][i].push_back(m.tension), all[1][i].push_back(m.compression), all[2][i].push_back(m.shear);
    }
  }
  std::vector<Check> checks;
  for (std::size_t i = 0; i < thetas.size(); ++i) {
    const std::string at = fmt::format("theta = {:g} deg: ", thetas[i]);
    add_mean(checks, at + "tension across the load over theory", 1.0, all[0][i]);
    add_mean(checks, at + "compression along the load over theory", 1.0, all[1][i]);
    add_mean(checks, at + "difference of the shear stresses over the compression", 0.0, all[2][i]);
  }
  return checks;
}

}  // namespace

std::vector<VerificationCase> pressed_disc_cases() {
  const std::string source =
      "Lekhnitskii 1968, Amadei 1996, Claesson & Bohloli 2002; series derived in theory/anisotropic_disc";
  return {{"V25", "Layered elastic disc pressed on two arcs: stress in the middle", source,
           "mean over a circle of D/8 in a disc of 75 grains with 43 planes; arcs on grains",
           lattice_in_the_middle},
          {"V29", "Random bedded packings pressed on two arcs: stress in the middle", source,
           "eight discs of 75 grains across: the tension in one alone has a standard deviation of 1 to 3 %",
           packings_in_the_middle}};
}

}  // namespace phy::verification
