// Whole laboratory tests against closed forms: the same rooms that users run, on specimens made by hand.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "lab/lab_test.hpp"
#include "records/assembly.hpp"
#include "verification/cases.hpp"

namespace phy {
namespace {

constexpr double R = 3e-4;

/// Runs one test alone, in double precision.
TestResult run(Specimen s, const Recipe& recipe) {
  const auto specimen = std::make_shared<const Specimen>(std::move(s));
  GroupOptions options;
  options.isa = native_isa();
  options.interval = static_cast<int>(recipe.test.history_interval);
  const auto group = make_group(specimen->packing, options);
  const auto test = make_test(specimen, recipe, *group, 0);
  do group->advance();
  while (!test->after_block());
  return test->take_result();
}

double value(const TestResult& r, const char* name) {
  const Number* n = find(r.numbers, name);
  return n == nullptr ? std::nan("") : n->value;
}

// The lattice has ends and free sides, the formula has none: bonds of the five outermost grains on every side
// are made stronger, and the stress counts on the 2 n_x - 1 inclined contacts between two rows.
std::vector<Check> lattice_tension() {
  constexpr std::uint32_t n_x = 24, n_y = 30;
  MatrixRecipe m = soft_contact();
  m.sigma_c = 10e6;
  Specimen s = assembly(hexagonal(n_x, n_y, R), m);
  bond_touching(s);
  const auto outer = [&](std::uint32_t g) {
    return std::min({g % n_x, n_x - 1 - g % n_x, g / n_x, n_y - 1 - g / n_x}) < 5;
  };
  for (Contact& c : s.contacts)
    if (outer(c.a) || outer(c.b)) c.sigma_c *= 2.0;
  Recipe r;
  r.test.kind = TestKind::direct_tension;
  r.test.grip_thickness = 2.0 * R;
  r.test.platen_speed = 0.01;
  r.test.history_interval = 20;
  const double width = s.packing->width, k = m.bond_ks_over_kn;
  const TestResult result = run(std::move(s), r);
  const double root3 = std::numbers::sqrt3;
  const double E = 2.0 * root3 * m.E_b * (1.0 + k) / (3.0 + k);
  return {{"direct tensile strength [Pa]", 2.0 * root3 * m.sigma_c * (1.0 + k) / (2.0 + k),
           value(result, "sigma_t") * width / ((2.0 * n_x - 1.0) * R), 0.02},
          {"modulus in tension, gauge [Pa]", E, value(result, "E_tangent") * width / ((2.0 * n_x - 1.0) * R),
           0.02}};
}

}  // namespace

std::vector<VerificationCase> test_cases() {
  return {{"V13", "Direct tension of a hexagonal lattice, strengths without scatter",
           "uniform state of the lattice: s_t = 2 sqrt(3) lambda sigma_c (K_n + K_s)/(2 K_n + K_s)",
           "the free sides disturb the state over a few grains", lattice_tension}};
}

}  // namespace phy
