// Whole bodies against theory: a cracked plate, a column with a joint through it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "analysis/analyse.hpp"
#include "base/exact_math.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "lab/tests.hpp"
#include "records/assembly.hpp"
#include "statics/crack_tip.hpp"
#include "statics/system.hpp"
#include "theory/jaeger.hpp"
#include "verification/cases.hpp"

namespace phy::verification {
namespace {

constexpr double R_body = 2e-4;

// --- V26: energy release of a cracked plate

struct CrackedPlate {
  double energy = 0.0;  // elastic energy at stress 1 [J/m]
  double K_I = 0.0;     // at stress 1 [sqrt(m)]
};

/// Pulls a lattice along y by 1 Pa; the bonds that cross its middle left of `a` are cut.
CrackedPlate cracked_plate(int n_x, int n_y, double a, double E, double nu) {
  Specimen s = assembly(hexagonal(n_x, n_y, R_body), soft_contact());
  bond_touching(s);
  const auto& d = s.packing->discs;
  const double middle = R_body * (1.0 + root3 * (0.5 * n_y - 0.5));
  std::erase_if(s.contacts, [&](const Contact& c) {
    return (d[c.a].y < middle) != (d[c.b].y < middle) && 0.5 * (d[c.a].x + d[c.b].x) < a;
  });
  const statics::Network net = statics::make_network(s);
  statics::Boundary boundary;
  // Each grain of the end rows carries the stress over its own width.
  const auto top = static_cast<std::uint32_t>(n_x * (n_y - 1));
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(n_x); ++i) {
    boundary.loads.push_back({{i, 1}, -2.0 * R_body});
    boundary.loads.push_back({{top + i, 1}, 2.0 * R_body});
  }
  const auto right = static_cast<std::uint32_t>(n_x * (n_y / 2) - 1);  // far from the crack
  for (int component = 0; component < 3; ++component) boundary.movements.push_back({{right, component}, 0.0});
  const statics::Movements u = statics::solve_once(net, boundary).u;
  CrackedPlate plate;
  for (const statics::Given& load : boundary.loads)
    // Clapeyron: the work of the loads is twice the energy that is stored.
    plate.energy += 0.5 * load.value *
                    u[std::size_t{3} * load.where.body + static_cast<std::size_t>(load.where.component)];
  // The lattice is isotropic (V1): K_I may be read with two constants.
  const statics::Compliance S = {
      {{1.0 / E, -nu / E, 0.0}, {-nu / E, 1.0 / E, 0.0}, {0.0, 0.0, 2.0 * (1.0 + nu) / E}}};
  plate.K_I = statics::stress_intensity(net, u, {{a, middle}, {1.0, 0.0}, 8.0 * R_body, 0.4 * a}, S).K_I;
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
    const double a = R_body * (std::round(share * 2.0 * n_x) + 1.0), step = 4.0 * R_body;
    const double G =
        // At equal load the energy grows with the crack: a central difference gives its release.
        (cracked_plate(n_x, n_y, a + step, E, nu).energy - cracked_plate(n_x, n_y, a - step, E, nu).energy) /
        (2.0 * step);
    const double K = cracked_plate(n_x, n_y, a, E, nu).K_I;
    checks.push_back(
        {fmt::format("crack over width {:.2f}: G of the energies over K_I^2/E [-]", a / (2.0 * R_body * n_x)),
         1.0, G / (K * K / E), 0.03});
  }
  return checks;
}

// --- V27: one joint through a column

std::vector<Check> joint_in_column() {
  Recipe r;
  r.specimen = {0.01, 0.028};
  r.packing.n_grains = 730;
  // Stiff and strong rock: the joint alone is to deform and to fail.
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
  // One plane in the column: the next one is ten metres away.
  set.rule = BeddingRule::crossing, set.spacing = 10.0;
  // Friction before and after breakage alike, so that the peak is Coulomb's.
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
      {"V26", "Energy release of a cracked plate: dU/da against K_I^2/E", "Irwin 1957",
       "K_I is read beside the end of the crack, where the lattice is no continuum; G over 8 grains' radii",
       energy_release},
      {"V27", "One bonded joint through a column of stiff rock: strength",
       "Jaeger 1960 with c_w = C sum(A)/L, as in Mas Ivars et al. 2011",
       "contacts of the joint carry nearly the same stress; the platens still move (docs/evidence.md)",
       joint_in_column}};
}

}  // namespace phy::verification
