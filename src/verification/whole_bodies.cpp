// Whole bodies against continuum theory: a layered disc that is pressed, a cracked plate, a column with a
// joint through it. The layered body is a hexagonal lattice with a smooth joint between every second row and
// the next. Its compliance is measured on the lattice itself, by uniform gradients, so that what is compared
// is the field of the whole body and not a modulus.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "analysis/analyse.hpp"
#include "base/exact_math.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "lab/tests.hpp"
#include "records/assembly.hpp"
#include "statics/crack_tip.hpp"
#include "statics/system.hpp"
#include "theory/anisotropic_disc.hpp"
#include "theory/jaeger.hpp"
#include "verification/cases.hpp"

namespace phy::verification {
namespace {

constexpr double R = 2e-4;
const double root3 = std::numbers::sqrt3;

// --- V25: a pressed disc

/// A disc of lattice with a joint after every `rows` rows, about the origin.
Specimen layered_disc(double diameter, int rows) {
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

/// Pressure 1 on two arcs of +- alpha degrees about the direction `load`: rays along the radius press on the
/// grain that they meet first.
statics::Boundary pressed(const Specimen& s, double radius, Vec2 load, double alpha) {
  statics::Boundary boundary;
  const auto& discs = s.packing->discs;
  constexpr int rays = 400;
  for (const double side : {1.0, -1.0}) {
    for (int k = 0; k < rays; ++k) {
      const double turn = (2.0 * (k + 0.5) / rays - 1.0) * alpha * pi / 180.0;
      const Vec2 d = side * (std::cos(turn) * load + std::sin(turn) * tangent(load));
      double reach = 0.0;
      std::uint32_t met = 0;
      for (std::uint32_t g = 0; g < discs.size(); ++g) {
        const Vec2 x{discs[g].x, discs[g].y};
        const double off = cross(d, x), room = discs[g].r * discs[g].r - off * off;
        if (room < 0.0 || dot(d, x) + std::sqrt(room) <= reach) continue;
        reach = dot(d, x) + std::sqrt(room), met = g;
      }
      const double force = radius * 2.0 * alpha * pi / 180.0 / rays;
      boundary.loads.push_back({{met, 0}, -force * d.x});
      boundary.loads.push_back({{met, 1}, -force * d.y});
    }
  }
  std::uint32_t held = 0;  // carries nothing: the loads balance but for a small couple
  for (std::uint32_t g = 1; g < discs.size(); ++g)
    if (std::fabs(cross(load, {discs[g].x, discs[g].y})) >
        std::fabs(cross(load, {discs[held].x, discs[held].y})))
      held = g;
  for (int component = 0; component < 3; ++component) boundary.movements.push_back({{held, component}, 0.0});
  return boundary;
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
theory::PlaneCompliance compliance_seen(const statics::Network& net, double radius, Vec2 load) {
  const double half = 0.5 * radius;
  const std::array<statics::Window, 1> middle = {{{{-half, -half}, {half, half}}}};
  const auto found = statics::effective_compliance(net, middle, 4.0 * R, {load.y, -load.x});
  const statics::Compliance& S = found.S;
  return {S[0][0], S[1][1], S[0][1], S[0][2], S[1][2], S[2][2]};
}

std::vector<Check> layered_disc_in_the_middle() {
  constexpr double D = 0.03, alpha = 7.5;
  const Specimen s = layered_disc(D, 2);
  const statics::Network net = statics::make_network(s);
  std::vector<Check> checks;
  for (const double theta : {0.0, 22.5, 45.0, 67.5, 90.0}) {
    const Vec2 load{std::sin(theta * pi / 180.0), std::cos(theta * pi / 180.0)};
    const Vec2 across{load.y, -load.x};
    const auto u = statics::solve_once(net, pressed(s, 0.5 * D, load, alpha)).u;
    const auto m = stress_in_middle(net, u, D / 8.0);
    const auto seen = [&](Vec2 a, Vec2 b) {
      return m[0] * a.x * b.x + m[1] * a.y * b.y + m[2] * (a.x * b.y + a.y * b.x);
    };
    const double P = D * std::sin(alpha * pi / 180.0);
    const theory::DiscStress t =
        theory::AnisotropicDisc({compliance_seen(net, 0.5 * D, load), D, alpha, P}).mean(D / 8.0);
    const std::string at = fmt::format("theta = {:g} deg: ", theta);
    checks.push_back({at + "tension across the load over theory [-]", 1.0, seen(across, across) / t.x, 0.03});
    checks.push_back({at + "compression along the load over theory [-]", 1.0, seen(load, load) / t.y, 0.03});
    checks.push_back({at + "difference of the shear stresses over the compression [-]", 0.0,
                      (seen(across, load) - t.xy) / t.y, 0.03});
  }
  return checks;
}

// --- V26: energy release of a cracked plate

struct CrackedPlate {
  double energy = 0.0;  // elastic energy at stress 1 [J/m]
  double K_I = 0.0;     // at stress 1 [sqrt(m)]
};

/// Pulls a lattice along y by 1 Pa; the bonds that cross its middle left of `a` are cut.
CrackedPlate cracked_plate(int n_x, int n_y, double a, double E, double nu) {
  Specimen s = assembly(hexagonal(n_x, n_y, R), soft_contact());
  bond_touching(s);
  const auto& d = s.packing->discs;
  const double middle = R * (1.0 + root3 * (0.5 * n_y - 0.5));
  std::erase_if(s.contacts, [&](const Contact& c) {
    return (d[c.a].y < middle) != (d[c.b].y < middle) && 0.5 * (d[c.a].x + d[c.b].x) < a;
  });
  const statics::Network net = statics::make_network(s);
  statics::Boundary boundary;
  const auto top = static_cast<std::uint32_t>(n_x * (n_y - 1));
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n_x); ++i) {
    boundary.loads.push_back({{i, 1}, -2.0 * R});
    boundary.loads.push_back({{top + i, 1}, 2.0 * R});
  }
  const auto right = static_cast<std::uint32_t>(n_x * (n_y / 2) - 1);  // far from the crack
  for (int component = 0; component < 3; ++component) boundary.movements.push_back({{right, component}, 0.0});
  const statics::Movements u = statics::solve_once(net, boundary).u;
  CrackedPlate plate;
  for (const statics::Given& load : boundary.loads)
    plate.energy += 0.5 * load.value *
                    u[std::size_t{3} * load.where.body + static_cast<std::size_t>(load.where.component)];
  const statics::Compliance S = {
      {{1.0 / E, -nu / E, 0.0}, {-nu / E, 1.0 / E, 0.0}, {0.0, 0.0, 2.0 * (1.0 + nu) / E}}};
  plate.K_I = statics::stress_intensity(net, u, {{a, middle}, {1.0, 0.0}, 8.0 * R, 0.4 * a}, S).K_I;
  return plate;
}

std::vector<Check> energy_release() {
  constexpr int n_x = 90, n_y = 100;
  const MatrixRecipe m = soft_contact();
  const double K_n = m.E_b, K_s = m.bond_ks_over_kn * m.E_b;
  const double E = 2.0 * root3 * K_n * (K_n + K_s) / (3.0 * K_n + K_s), nu = (K_n - K_s) / (3.0 * K_n + K_s);
  std::vector<Check> checks;
  for (const double share : {0.3, 0.4, 0.5}) {
    // Ends half-way between the bonds that cross the middle, one every R.
    const double a = R * (std::round(share * 2.0 * n_x) + 1.0), step = 4.0 * R;
    const double G =
        (cracked_plate(n_x, n_y, a + step, E, nu).energy - cracked_plate(n_x, n_y, a - step, E, nu).energy) /
        (2.0 * step);
    const double K = cracked_plate(n_x, n_y, a, E, nu).K_I;
    checks.push_back(
        {fmt::format("crack over width {:.2f}: G of the energies over K_I^2/E [-]", a / (2.0 * R * n_x)), 1.0,
         G / (K * K / E), 0.03});
  }
  return checks;
}

// --- V27: one joint through a column

std::vector<Check> joint_in_column() {
  Recipe r;
  r.specimen = {0.01, 0.028};
  r.packing.n_grains = 730;
  r.matrix.E_c = r.matrix.E_b = 1000e9;
  r.matrix.sigma_c = r.matrix.tau_c = 300e6, r.matrix.sigma_c_sd = r.matrix.tau_c_sd = 30e6;
  r.test.kind = TestKind("biaxial");
  r.test.confinement = Confinement::jacket;
  r.test.confining_stress = 5e6;
  r.test.angles = {45.0, 60.0};
  r.test.platen_speed = 0.02;
  r.test.stop_at = 0.9;
  r.test.max_strain = 2e-3;
  r.bedding.resize(1);
  BeddingRecipe& set = r.bedding.front();
  set.rule = BeddingRule::crossing, set.spacing = 10.0;
  set.sigma_n = 1e9, set.cohesion = 5e6, set.mu = 0.4, set.phi = std::atan(0.4) * 180.0 / pi;
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
  std::vector<Check> checks;
  for (const Specimen& s : genesis::make_specimens(packing, r)) {
    if (s.bedding.empty()) continue;
    const double theta = s.bedding.front().theta;
    const theory::Coulomb plane{set.cohesion * s.bedding_report.front().overlap_ratio, set.phi};
    const TestResult result = lab::run_alone(std::make_shared<const Specimen>(s), r);
    const Number* found = analysis::find(result.numbers, "sigma_1");
    checks.push_back({fmt::format("bonded joint at {:g} deg, 5 MPa: sigma_1 [Pa]", theta),
                      theory::weak_plane_sigma_1(plane, theta, 5e6),
                      found == nullptr ? std::nan("") : found->value, 0.05});
  }
  return checks;
}

}  // namespace

std::vector<VerificationCase> whole_body_cases() {
  return {
      {"V25", "Layered elastic disc pressed on two arcs: stress in the middle",
       "Lekhnitskii 1968, Amadei 1996, Claesson & Bohloli 2002; series derived in theory/anisotropic_disc",
       "mean over a circle of D/8 in a disc of 75 grains with 43 planes; arcs on grains",
       layered_disc_in_the_middle},
      {"V26", "Energy release of a cracked plate: dU/da against K_I^2/E", "Irwin 1957",
       "K_I is read beside the end of the crack, where the lattice is no continuum; G over 8 grains' radii",
       energy_release},
      {"V27", "One bonded joint through a column of stiff rock: strength",
       "Jaeger 1960 with c_w = C sum(A)/L, as in Mas Ivars et al. 2011",
       "contacts of the joint carry nearly the same stress; the platens still move (docs/evidence.md)",
       joint_in_column}};
}

}  // namespace phy::verification
