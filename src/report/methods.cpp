#include "report/methods.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/lines.hpp"
#include "base/units.hpp"
#include "genesis/cut.hpp"
#include "report/axes.hpp"

namespace phy {
namespace {

std::string quantity(double value, Dimension d) { return print_quantity(value, d); }

std::string packing_text(const TestRecord& t) {
  const Recipe& r = t.recipe;
  const std::string source =
      r.packing.file.empty()
          ? fmt::format("radii between {} and {}, uniform by {}, seed {}",
                        quantity(r.packing.radius_min, Dimension::length),
                        quantity(r.packing.radius_max, Dimension::length),
                        r.packing.distribution == RadiusDistribution::by_number ? "number" : "area",
                        r.packing.seed)
          : "imported";
  return fmt::format(
      "The specimens are two-dimensional assemblies of {} discs ({}) in a rectangle of {} by {} (width by "
      "height{}). The packing has porosity {:.4f}, coordination number {:.3f} and fabric {:+.4f}; {}.",
      t.n_grains, source, quantity(r.specimen.width, Dimension::length),
      quantity(r.specimen.height, Dimension::length),
      r.test.kind == TestKind::direct_shear ? "" : ", load along the height", t.packing.porosity,
      t.packing.coordination, t.packing.fabric,
      t.stress_free
          ? "its overlaps are the stress-free state"
          : fmt::format("it carries a locked-in stress of {:.3f} MPa", t.packing.stress_left * 1e-6));
}

std::string matrix_text(const MatrixRecipe& m) {
  const auto p = [](double v) { return quantity(v, Dimension::pressure); };
  return fmt::format(
      "The matrix is a bonded-particle model (Potyondy & Cundall 2004): linear contacts (E_c = {}, k_s/k_n = "
      "{:g}, mu = {:g}) "
      "and parallel bonds (E_b = {}, k_s/k_n = {:g}, tensile strength {} with standard deviation {}, shear "
      "strength {} with "
      "standard deviation {}, radius multiplier {:g}, bond seed {}); grain density {}.",
      p(m.E_c), m.ks_over_kn, m.mu, p(m.E_b), m.bond_ks_over_kn, p(m.sigma_c), p(m.sigma_c_sd), p(m.tau_c),
      p(m.tau_c_sd), m.radius_multiplier, m.bond_seed, quantity(m.density, Dimension::density));
}

std::string bedding_text(const BeddingRecipe& b, TestKind kind) {
  const auto s = [](double v) { return quantity(v, Dimension::stiffness); };
  return fmt::format(
      "Bedding planes, {} apart, are smooth joints (Mas Ivars et al. 2011), assigned by the {}: k_n = {}, "
      "k_s = {}, mu = {:g}, "
      "tensile strength {}, cohesion {}, friction angle of the bonded joint {:g} deg, dilation angle {:g} "
      "deg. theta is the "
      "inclination of the planes from the horizontal{}.",
      quantity(b.spacing, Dimension::length),
      b.rule == BeddingRule::zone
          ? fmt::format("zone rule with a thickness of {}", quantity(b.zone_thickness, Dimension::length))
          : std::string("crossing rule"),
      s(b.k_n), s(b.k_s), b.mu, quantity(b.sigma_n, Dimension::pressure),
      quantity(b.cohesion, Dimension::pressure), b.phi, b.psi,
      kind == TestKind::direct_shear ? ", along which the boxes move" : ", the load being vertical");
}

std::string sides_text(const TestRecipe& t) {
  if (t.confining_stress == 0.0) return "The sides were free (confining stress 0).";
  return fmt::format(
      "A confining stress of {} was brought up all round before the loading and held on the sides by {}.",
      quantity(t.confining_stress, Dimension::pressure),
      t.confinement == Confinement::walls ? "two rigid walls without friction"
                                          : "a pressure on the outermost grains, as by a rubber jacket");
}

std::string shear_text(const TestRecipe& t) {
  return fmt::format(
      "The halves of the specimen, {}, were held in two boxes and sheared past each other at {} each, under "
      "a normal "
      "stress of {}{}.",
      t.shear_gap > 0.0 ? quantity(t.shear_gap, Dimension::length) + " of free rock between them"
                        : "each rigid",
      quantity(t.platen_speed, Dimension::speed), quantity(t.normal_stress, Dimension::pressure),
      t.normal_stiffness > 0.0
          ? fmt::format(" that grew with dilation by {}", quantity(t.normal_stiffness, Dimension::stiffness))
          : std::string(", kept constant"));
}

std::string tools_text(const Recipe& r) {
  const TestRecipe& t = r.test;
  const std::string speed = quantity(t.platen_speed, Dimension::speed),
                    platens = fmt::format("Two rigid platens (friction {:g}) closed at {} each",
                                          t.platen_friction, speed);
  switch (t.kind) {
    case TestKind::uniaxial: return platens + " on specimens with free sides.";
    case TestKind::biaxial: return platens + ". " + sides_text(t);
    case TestKind::direct_tension:
      return fmt::format("Grips on both ends, free to move sideways, pulled at {} each; the sides were free.",
                         speed);
    case TestKind::brazilian:
      return fmt::format("Discs of {} were cut from the specimens; {} closed on them at {} each.",
                         quantity(disc_diameter(r), Dimension::length),
                         t.loading_angle > 0.0
                             ? fmt::format("two jaws, each on an arc of {:g} deg,", t.loading_angle)
                             : "two flat platens",
                         speed);
    case TestKind::direct_shear: return shear_text(t);
  }
  return "";
}

/// What ended a test, by its history: a test whose stress has fallen far enough ends first for that.
std::string end_of(const TestRecord& test) {
  const TestRecipe& t = test.recipe.test;
  const Outcome& outcome = test.result.outcome;
  const std::vector<HistoryRow>& rows = test.result.history.rows;
  if (outcome.status != Status::peaked || rows.empty())
    return to_string(outcome.status) + (outcome.reason.empty() ? "" : ", " + outcome.reason);
  const TestAxes axes = test_axes(t.kind);
  if (t.kind == TestKind::direct_shear)
    return fmt::format("past the peak, at the full shear displacement of {:.3g} mm",
                       axes.strain_of(rows.back()) * 1e3);
  const auto peak = std::max_element(rows.begin(), rows.end(), [&](const HistoryRow& a, const HistoryRow& b) {
    return axes.stress_of(a) < axes.stress_of(b);
  });
  if (axes.stress_of(rows.back()) < t.stop_at * axes.stress_of(*peak))
    return fmt::format("the {} had fallen below {:g} % of its peak", axes.stress, 100.0 * t.stop_at);
  return fmt::format("the {} exceeded that of the peak by {:g} %", axes.strain, 100.0 * t.post_peak);
}

/// How the tests ended, those that ended alike together.
std::string ends_text(const RunRecord& run) {
  std::vector<std::string> ends;
  for (const TestRecord& t : run.tests) add_line(ends, t.result.name, end_of(t));
  return fmt::format("How each test ended: {}.", fmt::join(ends, "; "));
}

std::string loading_text(const RunRecord& run) {
  const TestRecord& t = run.tests.front();
  double least = t.result.dt, most = t.result.dt;
  for (const TestRecord& other : run.tests)
    least = std::min(least, other.result.dt), most = std::max(most, other.result.dt);
  const Recipe& r = t.recipe;
  return fmt::format(
      "{} The explicit time step was {:.3g} to {:.3g} s ({:g} of the proven stable step), local damping "
      "{:g}, {} "
      "precision. {}",
      tools_text(r), least, most, r.engine.step_safety, r.engine.damping,
      r.engine.precision == Precision::double_precision ? "double" : "single", ends_text(run));
}

std::string definitions_text(const TestRecord& t) {
  std::string text = "Definitions. ";
  const std::string strength = test_axes(t.recipe.test.kind).strength;
  for (const std::string& name : {std::string("E_tangent"), std::string("nu"), strength,
                                  std::string("sigma_ci"), std::string("sigma_cd")})
    for (const Number& n : t.result.numbers)
      if (n.name == name && !n.definition.empty()) text += fmt::format("{}: {}. ", name, n.definition);
  return text;
}

}  // namespace

std::vector<std::string> methods_text(const RunRecord& run) {
  if (run.tests.empty()) return {};
  const TestRecord& t = run.tests.front();
  std::vector<std::string> text = {packing_text(t), matrix_text(t.recipe.matrix)};
  for (const BeddingRecipe& b : t.recipe.bedding) text.push_back(bedding_text(b, t.recipe.test.kind));
  text.push_back(loading_text(run));
  text.push_back(definitions_text(t));
  text.push_back(
      fmt::format("Computed with {} (packing {}). D.O. Potyondy & P.A. Cundall, A bonded-particle model for "
                  "rock, Int. J. Rock Mech. "
                  "Min. Sci. 41 (2004) 1329-1364. D. Mas Ivars et al., The synthetic rock mass approach for "
                  "jointed rock mass modelling, "
                  "Int. J. Rock Mech. Min. Sci. 48 (2011) 219-244.",
                  t.program, t.packing_hash));
  return text;
}

}  // namespace phy
