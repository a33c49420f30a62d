// Results that others published, in a short form: docs/evidence.md has the long one.
#include <cmath>
#include <memory>
#include <vector>

#include "analysis/analyse.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "lab/tests.hpp"
#include "theory/transverse_isotropy.hpp"
#include "verification/cases.hpp"

namespace phy::verification {
namespace {

/// The granite of examples/evidence/lac-du-bonnet.toml, half as wide and half as high, pressed faster.
Recipe granite(std::int64_t seed) {
  Recipe r;
  r.specimen = {0.01585, 0.0317};
  r.packing.radius_min = 0.2707e-3, r.packing.radius_max = 0.4493e-3;
  r.packing.n_grains = 0, r.packing.porosity = 0.16, r.packing.seed = seed;
  r.packing.initial_stress = InitialStress::isotropic, r.packing.isotropic_stress = 0.1e6;
  MatrixRecipe& m = r.matrix;
  m.density = 2630.0, m.mu = 0.5, m.bond_gap = 0.36e-6;
  m.E_c = m.E_b = 62e9, m.ks_over_kn = m.bond_ks_over_kn = 0.4;
  m.sigma_c = m.tau_c = 157e6, m.sigma_c_sd = m.tau_c_sd = 36e6;
  r.test.platen_speed = 0.1, r.test.pre_strain = 5e-4, r.test.stop_at = 0.8;
  r.test.n_frames = r.test.n_snapshots = 0;
  return r;
}

/// Read as in the first row of the table in docs/evidence.md: platens, secant to half of the strength, plane
/// strain.
std::vector<Check> lac_du_bonnet() {
  constexpr int n_packings = 2;
  double E = 0.0, ucs = 0.0;
  for (int p = 1; p <= n_packings; ++p) {
    const Recipe r = granite(p);
    const auto packing =
        std::make_shared<const Packing>(genesis::make_packing(r.specimen, r.packing, r.matrix));
    const auto specimen = std::make_shared<const Specimen>(genesis::make_specimens(packing, r).front());
    const TestResult result = lab::run_alone(specimen, r);
    const auto number = [&](const char* name) {
      const Number* found = analysis::find(result.numbers, name);
      return found == nullptr ? std::nan("") : found->value;
    };
    E += theory::body_from_plane_strain({number("E_secant_platen"), number("nu_platen")}).E / n_packings;
    ucs += number("ucs") / n_packings;
  }
  return {{"E in plane strain, mean of two packings [Pa]", 70.9e9, E, 0.04},
          {"UCS, mean of two packings [Pa]", 199.1e6, ucs, 0.12}};
}

}  // namespace

std::vector<VerificationCase> published_cases() {
  return {{"V30", "Lac du Bonnet granite at half its size: E and UCS of PFC2D",
           "Potyondy & Cundall 2004, Table 2 as quoted second hand (docs/evidence.md)",
           "two standard errors of two packings of 1,000 discs: over eight, E has a standard deviation of "
           "2.7 %, UCS of 8.7 %",
           lac_du_bonnet}};
}

}  // namespace phy::verification
