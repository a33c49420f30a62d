#include "report/methods.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/units.hpp"
#include "records/rock_model.hpp"
#include "records/test_description.hpp"
#include "report/baselines.hpp"
#include "report/calibration_summary.hpp"
#include "report/words.hpp"

namespace phy::report {
namespace {

std::string quantity(double value, Dimension d) { return print_quantity(value, d); }

std::string radii_text(const PackingRecipe& p) {
  // Radii come from porosity and number of grains with all digits of a double.
  const auto length = [](double value) { return quantity(rounded(value, 4), Dimension::length); };
  return fmt::format("radii between {} and {}, uniform by {}", length(p.radius_min), length(p.radius_max),
                     p.distribution == RadiusDistribution::by_number ? "number" : "area");
}

/// After the size of the specimen.
std::string opening_text(const SpecimenSize& s) {
  if (s.hole_diameter > 0.0)
    return fmt::format(", with a circular hole of {} in the middle",
                       quantity(s.hole_diameter, Dimension::length));
  if (s.flaw_length == 0.0) return {};
  return fmt::format(", with an open flaw of {} in the middle, inclined by {} from the horizontal and {}",
                     quantity(s.flaw_length, Dimension::length), quantity(s.flaw_angle, Dimension::angle),
                     s.flaw_width > 0.0 ? quantity(s.flaw_width, Dimension::length) + " wide"
                                        : std::string("as wide as the largest disc"));
}

std::string packing_text(const SpecimenRecord& t) {
  const Recipe& r = t.recipe;
  const std::string source =
      // Imported discs have no law of radii and no seed that would make them again.
      r.packing.file.empty() ? fmt::format("{}, seed {}", radii_text(r.packing), r.packing.seed) : "imported";
  return fmt::format(
      "The specimens are two-dimensional assemblies of {} discs ({}) in a rectangle of {} by {} (width by "
      "height{}){}. The packing has porosity {:.4f}, coordination number {:.3f} and fabric {:+.4f}; {}.",
      t.n_grains, source, quantity(r.specimen.width, Dimension::length),
      quantity(r.specimen.height, Dimension::length), r.test.kind->load_on_box, opening_text(r.specimen),
      t.packing.porosity, t.packing.coordination, t.packing.fabric,
      t.stress_free
          ? "its overlaps are the stress-free state"
          : fmt::format("it carries a locked-in stress of {:.3f} MPa", t.packing.stress_left * 1e-6));
}

/// Directions and bonds left out, as clauses after the matrix.
std::string departures_text(const Recipe& r) {
  const MatrixRecipe& m = r.matrix;
  const char* const contacts = r.bedding.empty() ? "contacts" : "contacts that are no joints";
  std::string text;
  // What is as by default is not said: a methods section names departures alone.
  if (m.unbonded_fraction > 0.0)
    text += fmt::format(" {:g} % of the {}, drawn at random, have no bond.", 100.0 * m.unbonded_fraction,
                        contacts);
  if (m.gapped_fraction > 0.0)
    text += fmt::format(" {:g} % of the {}, drawn at random, have no bond and start {} apart.",
                        100.0 * m.gapped_fraction, contacts, quantity(m.initial_gap, Dimension::length));
  if (!m.directional()) return text;
  text += r.bedding.empty() ? fmt::format(" theta is the inclination of the foliation from the horizontal{}.",
                                          r.test.kind->load_on_bedding)
                            : fmt::format(
                                  " The foliation of the matrix lies at {:g} deg where the bedding lies at "
                                  "{:g} deg, and turns with it.",
                                  m.foliation, r.bedding.front().theta);
  // The formulas in full: no other program has these factors, so a name would tell a reader nothing.
  return text + fmt::format(
                    " Contacts have directions: a is the angle between the normals of contact and foliation. "
                    "Stiffness, tensile strength and shear strength are multiplied by 1 + W cos 2a, W = (1 - "
                    "r)/(1 + r), r = {:g}, {:g} and {:g}. The shear strength is also multiplied by 1 - V cos "
                    "4a, V = (q - 1)/(q + 1), q = {:g}.",
                    m.stiffness_ratio, m.tension_ratio, m.cohesion_ratio, m.cohesion_oblique);
}

// Bonds of constant shear strength have no angle, and "0 deg" would read as a choice.
std::string friction_angle_text(const MatrixRecipe& m) {
  return m.shear_strength == ShearStrength::constant ? "" : fmt::format("friction angle {:g} deg, ", m.phi);
}

std::string flat_joint_text(const Recipe& r) {
  const MatrixRecipe& m = r.matrix;
  const auto p = [](double v) { return quantity(v, Dimension::pressure); };
  return fmt::format(
      "The matrix is a flat-jointed bonded-particle model (Potyondy 2012). Interfaces of {} elements have "
      "E_c = "
      "{}, k_s/k_n = {:g} and mu = {:g}. Their tensile strength is {} with standard deviation {}, compared "
      "at "
      "the {} of an element. Their cohesion is {} with standard deviation {}. They have {}radius multiplier "
      "{:g} and bond "
      "seed {}. Grain density {}.{}",
      m.elements, p(m.E_c), m.ks_over_kn, m.mu, p(m.sigma_c), p(m.sigma_c_sd),
      m.break_at == BreakAt::edge ? "edge" : "centre", p(m.tau_c), p(m.tau_c_sd), friction_angle_text(m),
      m.radius_multiplier, m.bond_seed, quantity(m.density, Dimension::density), departures_text(r));
}

std::string matrix_text(const Recipe& r) {
  const MatrixRecipe& m = r.matrix;
  if (m.model == MatrixModel::flat_joint) return flat_joint_text(r);
  const auto p = [](double v) { return quantity(v, Dimension::pressure); };
  return fmt::format(
      "The matrix is a bonded-particle model (Potyondy & Cundall 2004). Linear contacts have E_c = {}, "
      "k_s/k_n "
      "= {:g} and mu = {:g}. Parallel bonds have E_b = {}, k_s/k_n = {:g}, tensile strength {} with standard "
      "deviation {}, and shear strength {} with standard deviation {}. They have {}radius multiplier {:g}, "
      "moment contribution {:g} and bond seed {}. Grain density {}.{}",
      p(m.E_c), m.ks_over_kn, m.mu, p(m.E_b), m.bond_ks_over_kn, p(m.sigma_c), p(m.sigma_c_sd), p(m.tau_c),
      p(m.tau_c_sd), friction_angle_text(m), m.radius_multiplier, m.moment_contribution, m.bond_seed,
      quantity(m.density, Dimension::density), departures_text(r));
}

std::string layers_text(const BeddingRecipe& b) {
  std::vector<std::string> factors;
  if (b.layer_stiffness != 1.0)
    factors.push_back(fmt::format("contacts and bonds have {:g} times the moduli", b.layer_stiffness));
  if (b.layer_strength != 1.0)
    factors.push_back(fmt::format("bonds have {:g} times the strengths", b.layer_strength));
  if (factors.empty()) factors.emplace_back("nothing differs from those");
  return fmt::format("in a layer of {} about each plane {} of the matrix",
                     quantity(b.layer_thickness, Dimension::length), fmt::join(factors, " and "));
}

/// Which contacts are joints.
std::string joints_text(const BeddingRecipe& b) {
  if (!b.has_planes())
    return fmt::format(
        "Bedding is dispersed (after Duan & Kwok 2015). Every contact whose normal lies within {:g} deg of "
        "the bedding's is a smooth joint (Mas Ivars et al. 2011) with the bedding's normal",
        b.orientation_range);
  std::string text = fmt::format(
      "Bedding planes, {} apart, are smooth joints (Mas Ivars et al. 2011), assigned by the {}",
      quantity(b.spacing, Dimension::length),
      b.rule == BeddingRule::zone
          ? fmt::format("zone rule with a thickness of {}", quantity(b.zone_thickness, Dimension::length))
          : std::string("crossing rule"));
  if (b.rule == BeddingRule::zone && !b.bridges) text += " and to all contacts that cross a plane";
  if (b.spacing_sd > 0.0)
    text += fmt::format("; the spacing has a standard deviation of {:g} %", 100.0 * b.spacing_sd);
  if (b.theta_sd > 0.0)
    text +=
        fmt::format("; the inclination has a standard deviation of {:g} deg from plane to plane", b.theta_sd);
  if (b.persistence < 1.0)
    text += fmt::format(
        "; {:g} % of the planes are jointed, in patches of {}, the rest is bonded as the matrix",
        100.0 * b.persistence,
        b.patch_length > 0.0 ? quantity(b.patch_length, Dimension::length) : std::string("single contacts"));
  if (b.layer_thickness > 0.0) text += "; " + layers_text(b);
  return text;
}

std::string bedding_text(const BeddingRecipe& b, const TestDescription& test) {
  const auto s = [](double v) { return quantity(v, Dimension::stiffness); };
  const auto p = [](double v) { return quantity(v, Dimension::pressure); };
  if (b.unjointed())
    return fmt::format(
        "The rock is layered without joints, planes {} apart: {}. theta is their inclination from the "
        "horizontal{}.",
        quantity(b.spacing, Dimension::length), layers_text(b), test.load_on_bedding);
  return fmt::format(
      "{}: k_n = {}, "
      "k_s = {}, mu = {:g}, "
      "tensile strength {}{}, cohesion {}, friction angle of the bonded joint {:g} deg, dilation angle {:g} "
      "deg. theta is the "
      "inclination of the {} from the horizontal{}.",
      joints_text(b), s(b.k_n), s(b.k_s), b.mu, p(b.sigma_n),
      b.sigma_n_sd > 0.0 ? fmt::format(" with standard deviation {}", p(b.sigma_n_sd)) : "", p(b.cohesion),
      b.phi, b.psi, b.has_planes() ? "planes" : "bedding", test.load_on_bedding);
}

/// What ended a test, by its history: a test whose stress has fallen far enough ends first for that.
std::string end_of(const SpecimenRecord& test) {
  const TestRecipe& t = test.recipe.test;
  const Outcome& outcome = test.result.outcome;
  const std::vector<HistoryRow>& rows = test.result.history.rows;
  if (outcome.status != Status::peaked || rows.empty())
    return to_string(outcome.status) + (outcome.reason.empty() ? "" : ", " + outcome.reason);
  const TestCurve& axes = t.kind->curve;
  // The wall of an opening is asked before its stress is.
  if (t.kind->closed_at > 0.0 && rows.back().closure > t.kind->closed_at) return outcome.reason;
  if (t.kind->runs_to_end)
    return fmt::format("past the peak, at the full {} of {:.3g} {}", axes.strain,
                       axes.strain_of(rows.back()) * axes.strain_factor, axes.strain_unit);
  // Read again from the rows: a result keeps the sentence about its end, but a paper needs rule and limit.
  const auto peak = std::max_element(rows.begin(), rows.end(), [&](const HistoryRow& a, const HistoryRow& b) {
    return axes.stress_of(a) < axes.stress_of(b);
  });
  // In the order in which the procedure looks: a row may fulfil both rules.
  if (axes.stress_of(rows.back()) < t.stop_at * axes.stress_of(*peak))
    return fmt::format("the {} had fallen below {:g} % of its peak", axes.stress, 100.0 * t.stop_at);
  const double end = axes.strain_of(rows.back()), far = (1.0 + t.post_peak) * axes.strain_of(*peak);
  if (!t.kind->may_harden || (t.post_peak > 0.0 && end > far))
    return fmt::format("the {} exceeded its value at the peak by {:g} %", axes.strain, 100.0 * t.post_peak);
  return fmt::format("past a peak that the {} fell from by 10 %, at the full {} of {:.3g} {}", axes.stress,
                     axes.strain, end * axes.strain_factor, axes.strain_unit);
}

/// How the tests ended, those that ended alike together.
std::string ends_text(const RunRecord& run) {
  std::vector<std::pair<std::string, std::vector<std::string>>> ends;
  for (const SpecimenRecord& t : run.tests) {
    const std::string end = end_of(t);
    // Journals have no room for seven equal sentences.
    auto at = std::find_if(ends.begin(), ends.end(), [&](const auto& e) { return e.first == end; });
    if (at == ends.end()) at = ends.insert(at, {end, {}});
    at->second.push_back(t.result.name);
  }
  std::vector<std::string> clauses;
  for (const auto& [end, names] : ends) clauses.push_back(fmt::format("{}: {}", fmt::join(names, ", "), end));
  return fmt::format("How each test ended: {}.", fmt::join(clauses, "; "));
}

std::string inertia_text(const Recipe& r) {
  // Scaled masses change no static strength, but a reader who repeats the test needs them.
  return r.engine.grain_inertia == GrainInertia::disc
             ? ""
             : " Every grain had the mean mass of a grain and the moment of inertia of a ring (differential "
               "density scaling).";
}

std::string loading_text(const RunRecord& run) {
  const SpecimenRecord& t = run.tests.front();
  double least = t.result.dt, most = t.result.dt;
  for (const SpecimenRecord& other : run.tests)
    // Specimens of one packing have other joints, and the stiffest contact decides the step.
    least = std::min(least, other.result.dt), most = std::max(most, other.result.dt);
  const Recipe& r = t.recipe;
  std::string step = fmt::format("{:.3g}", least);
  if (const std::string longest = fmt::format("{:.3g}", most); longest != step) step += " to " + longest;
  return fmt::format(
      "{} The explicit time step was {} s ({:g} of the proven stable step), local damping {:g}, {} "
      "precision.{} {}",
      r.test.kind->loading_text(r), step, r.engine.step_safety, r.engine.damping,
      r.engine.precision == Precision::double_precision ? "double" : "single", inertia_text(r),
      ends_text(run));
}

/// A number of all specimens; where they define it differently, by what gave their strength, each definition
/// with its specimens.
std::string definition_text(const RunRecord& run, const std::string& name) {
  std::vector<std::pair<std::string, std::vector<std::string>>> all;
  for (const SpecimenRecord& t : run.tests)
    for (const Number& n : t.result.numbers) {
      if (n.name != name || n.definition.empty()) continue;
      auto known =
          std::find_if(all.begin(), all.end(), [&](const auto& d) { return d.first == n.definition; });
      if (known == all.end()) known = all.insert(all.end(), {n.definition, {}});
      known->second.push_back(t.result.name);
    }
  std::string text;
  for (const auto& [definition, names] : all)
    text += all.size() == 1 ? fmt::format("{}: {}. ", name, definition)
                            : fmt::format("{} of {}: {}. ", name, fmt::join(names, ", "), definition);
  return text;
}

std::string definitions_text(const RunRecord& run) {
  std::string text = "Definitions. ";
  const std::string strength = run.tests.front().recipe.test.kind->curve.quantity().number;
  // Numbers that papers quote under one name with many meanings; all others have theirs in result.json.
  for (const std::string& name : std::vector<std::string>{"E_tangent", "nu", strength, "sigma_ci",
                                                          "sigma_ci_strain", "sigma_cd", "sigma_cd_volume"})
    text += definition_text(run, name);
  return text;
}

std::string references_text(const Recipe& r) {
  const auto any = [&](const auto& of) { return std::any_of(r.bedding.begin(), r.bedding.end(), of); };
  std::string text =
      r.matrix.model == MatrixModel::flat_joint
          ? "D.O. Potyondy, A flat-jointed bonded-particle material for hard rock, 46th US Rock "
            "Mechanics/Geomechanics Symposium (2012) ARMA 12-501."
          : "D.O. Potyondy & P.A. Cundall, A bonded-particle model for rock, Int. J. Rock Mech. Min. Sci. 41 "
            "(2004) 1329-1364.";
  // Only works whose models were used: an editor would strike the others.
  if (any([](const BeddingRecipe& b) { return !b.unjointed(); }))
    text +=
        " D. Mas Ivars et al., The synthetic rock mass approach for jointed rock mass modelling, Int. J. "
        "Rock "
        "Mech. Min. Sci. 48 (2011) 219-244.";
  if (any([](const BeddingRecipe& b) { return !b.has_planes(); }))
    text +=
        " K. Duan & C.Y. Kwok, Discrete element modeling of anisotropic rock under Brazilian test "
        "conditions, "
        "Int. J. Rock Mech. Min. Sci. 78 (2015) 46-56.";
  return text;
}

/// Estimates with the four digits that a reader needs; calibrated.toml has them all.
Recipe rounded(Recipe r) {
  const auto round = [](std::initializer_list<double*> numbers) {
    for (double* v : numbers) *v = phy::rounded(*v, 4);
  };
  MatrixRecipe& m = r.matrix;
  round({&m.E_c, &m.E_b, &m.sigma_c, &m.sigma_c_sd, &m.tau_c, &m.tau_c_sd});
  for (BeddingRecipe& b : r.bedding) round({&b.k_n, &b.k_s, &b.sigma_n, &b.sigma_n_sd, &b.cohesion});
  return r;
}

/// Of a calibration: packings by their seeds only.
std::string grains_text(const Recipe& r) {
  return fmt::format(
      "The specimens are two-dimensional assemblies of discs ({}; {}) in a rectangle of {} by {} (width by "
      "height){}.",
      r.packing.n_grains > 0 ? fmt::format("{} per specimen", r.packing.n_grains)
                             : fmt::format("porosity {:g}", r.packing.porosity),
      radii_text(r.packing), quantity(r.specimen.width, Dimension::length),
      quantity(r.specimen.height, Dimension::length), opening_text(r.specimen));
}

/// "E, UCS", without repetition; angles in the same way.
std::string table_text(const Calibration& c) {
  std::vector<std::string> names;
  std::set<double> angles;
  int n = 0;
  for (const Comparison& f : c.fitted) {
    angles.insert(f.target.theta), n += f.target.n;
    if (const std::string name = to_string(f.target.property);
        std::find(names.begin(), names.end(), name) == names.end())
      names.push_back(name);
  }
  return fmt::format("{} at inclinations of {:g} deg ({} means of {} values)", fmt::join(names, ", "),
                     fmt::join(angles, ", "), c.fitted.size(), n);
}

/// What makes the layers, where it is more than joints on planes.
std::string layers_text(const Calibration& c) {
  const RockModel* model = model_of(c.recipe);
  return model != nullptr ? model->sentence : "";
}

/// What stands in for a test of its own by an empirical relation.
std::string relations_text(const Calibration& c) {
  std::string text;
  for (const MeasuredProperty& p : measured_properties())
    // A property without a test of its own stands in by a factor of the literature, which must be told.
    if (p.share != 1.0 && std::any_of(c.fitted.begin(), c.fitted.end(),
                                      [&](const Comparison& f) { return f.target.property == p.property; }))
      text += fmt::format(" {} of the model is {:g} of its strength in the {} test, an empirical relation.",
                          p.name, p.share, p.test);
  return text;
}

std::string fit_text(const Calibration& c, const std::string& version) {
  // Without a test of strength nothing but moduli was fitted, and half of the paragraph falls away.
  const std::int64_t n_ucs = c.counts.compression();
  std::string text = fmt::format(
      "The micro-parameters were calibrated with phyllite {} against laboratory values of {}: {}; E was "
      "compared as {}.",
      version, c.rock, table_text(c), to_string(c.E_is));
  text += layers_text(c);
  const bool posterior = c.method == CalibrationMethod::posterior;
  text += fmt::format(" Moduli were {} ({} direct elastic solutions in all)",
                      posterior ? "fitted by least squares"
                                : "found step by step, by Eq. 1 through E(theta), E and nu along the layers, "
                                  "and Eq. 2 made anew on the packings at hand",
                      c.counts.solutions);
  if (n_ucs > 0)
    text += fmt::format(
        ", strengths {} ({} compression{} tests in all, verification included)",
        posterior ? fmt::format("by a surrogate and its posterior{}",
                                c.effort.empty() ? "" : ", effort " + c.effort)
                  : "one after the other by bisection, each against UCS at one angle on one packing",
        n_ucs,
        c.counts.tension > 0 ? fmt::format(" and {} {}", c.counts.tension,
                                           fmt::join(other_tests(c, {"tensile", "bend", "shear"}), " and "))
                             : "");
  if (!c.verification.empty())
    text += fmt::format(", and both were verified on {} packings that the fit had not seen",
                        c.verification.front().n_packings);
  text += ".";
  // The cost of models that were tried belongs to the result: it was a choice among several.
  if (!c.discarded.empty())
    text += fmt::format(" The numbers include solutions and tests of {} that {} not taken: {}.",
                        c.discarded.size() > 1 ? "other models" : "another model",
                        c.discarded.size() > 1 ? "were" : "was", fmt::join(c.discarded, "; "));
  text += relations_text(c);
  // Direct solutions have no masses.
  return text + (n_ucs > 0 ? inertia_text(c.recipe) : "");
}

std::string outcome_text(const Calibration& c) {
  std::string text;
  for (const ErrorRow& row : error_rows(c)) {
    std::vector<std::string> errors;
    for (std::size_t i = 0; i < n_properties; ++i)
      if (const auto p = static_cast<Property>(i); std::isfinite(row.rms[i]))
        errors.push_back(fmt::format("{} {}", to_string(p), miss_text(p, row.rms[i])));
    if (!errors.empty())
      text += fmt::format("{} {} ({})", text.empty() ? "" : ";", fmt::join(errors, ", "), row.of);
  }
  const std::string open = open_parameters(c);
  return fmt::format("Root mean square errors:{}. Verdict: {}{}", text, verdict_words(c),
                     open.empty() ? ""
                                  : fmt::format(" The data do not constrain {}: 95 % intervals over half of "
                                                "the admitted values, in logarithms.",
                                                open));
}

}  // namespace

std::vector<std::string> methods_text(const Calibration& c, const std::string& version) {
  const Recipe r = rounded(c.recipe);
  std::vector<std::string> text = {grains_text(r), matrix_text(r)};
  for (const BeddingRecipe& b : r.bedding) text.push_back(bedding_text(b, *r.test.kind));
  text.insert(text.end(), {fit_text(c, version), outcome_text(c), references_text(c.recipe)});
  return text;
}

std::vector<std::string> methods_text(const RunRecord& run) {
  if (run.tests.empty()) return {};
  const SpecimenRecord& t = run.tests.front();
  std::vector<std::string> text = {packing_text(t), matrix_text(t.recipe)};
  for (const BeddingRecipe& b : t.recipe.bedding) text.push_back(bedding_text(b, *t.recipe.test.kind));
  text.push_back(loading_text(run));
  text.push_back(definitions_text(run));
  text.push_back(
      fmt::format("Computed with {} (packing {}). {}", t.program, t.packing_hash, references_text(t.recipe)));
  return text;
}

}  // namespace phy::report
