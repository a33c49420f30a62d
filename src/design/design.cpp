#include "design/design.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/stats.hpp"

namespace phy::design {
namespace {

using Kind = FindingKind;

struct Misses {
  double squares = 0.0, sum = 0.0;
  std::size_t n = 0;
  void add(double miss) {
    if (std::isfinite(miss)) squares += miss * miss, sum += miss, ++n;
  }
  double rms() const { return std::sqrt(squares / static_cast<double>(n)); }
  double mean() const { return sum / static_cast<double>(n); }
};

/// A fit whose covariance counts the factor that nobody knows: how the constants move with it is tried.
Fit fit_of(const DrawTests& draw, const StrengthLaw& law) {
  constexpr double factor = 1.01;
  Fit fit = law.fit(draw.compression);
  if (!fit.ok() || draw.unknown_factor == 0.0) return fit;
  StrengthPoints more = draw.compression;
  for (StrengthPoint& p : more) p.ucs *= factor;
  const Fit moved = law.fit(more);
  if (moved.keys != fit.keys) return fit;
  const Eigen::VectorXd slope = (moved.x - fit.x) / std::log(factor);
  fit.covariance += draw.unknown_factor * draw.unknown_factor * slope * slope.transpose();
  return fit;
}

/// Means over the draws, in logarithms: specimens of one packing scatter more than any law is wrong.
StrengthPoints mean_points(const std::vector<DrawTests>& draws) {
  std::map<std::pair<double, double>, std::vector<double>> logs;
  for (const DrawTests& draw : draws)
    for (const StrengthPoint& p : draw.compression) logs[{p.theta, p.sigma_3}].push_back(std::log(p.ucs));
  StrengthPoints means;
  for (const auto& [at, values] : logs)
    means.push_back({at.first, std::exp(summarise(values).mean), at.second});
  return means;
}

Pooled strengths_of(const DesignTests& tests, const StrengthLaw& law) {
  std::vector<Fit> fits;
  for (const DrawTests& draw : tests.draws) fits.push_back(fit_of(draw, law));
  Pooled pooled = pool(fits);
  pooled.left_out = left_out_error(law, mean_points(tests.draws));
  return pooled;
}

void fit_parts(Design& d) {
  const DesignTests& tests = d.tests;
  const auto part = [&](Part p) -> Pooled& { return d.parts[static_cast<std::size_t>(p)]; };
  std::vector<Fit> elasticity, tension;
  for (const DrawTests& draw : tests.draws) {
    elasticity.push_back(fit_elasticity(draw.elasticity, tests.reading));
    tension.push_back(fit_tension(draw.tension));
  }
  part(Part::elasticity) = pool(elasticity), part(Part::tension) = pool(tension);
  if (!tests.strengths_sought) {
    for (const Part p : {Part::ubiquitous_joint, Part::tension, Part::hoek_brown, Part::fabric})
      part(p) = {.refusal = Refusal::not_sought};
    return;
  }
  for (const StrengthLaw& law : strength_laws()) {
    // The fabric stands in for a plane, in the order of the list.
    if (law.part == Part::fabric && part(Part::ubiquitous_joint).ok()) continue;
    // Rock without joints on planes may look as if it had one: there is nothing to slip on.
    const bool nothing = law.part == Part::ubiquitous_joint && !tests.weak_planes;
    part(law.part) = nothing ? Pooled{.refusal = Refusal::planes_absent} : strengths_of(tests, law);
  }
}

bool inside(const DesignTests& tests, double stress) {
  return stress >= tests.stresses.front() && stress <= tests.stresses.back();
}

/// The laboratory's own strengths inside the range, held against a law.
Misses strengths_missed(const Design& d, const StrengthLaw& law) {
  Misses misses;
  const Fit mean = d.part(law.part).mean();
  for (const Target& t : d.tests.laboratory)
    if ((t.property == Property::ucs || t.property == Property::confined) && inside(d.tests, t.confining))
      misses.add(std::log(law.sigma_1(mean, t.theta, t.confining) / t.mean));
  return misses;
}

/// Its moduli under the least stress, as the calibration compares them.
Misses moduli_missed(const Design& d) {
  Misses misses;
  // Another E is lower or higher by its definition.
  if (d.tests.E_is != ModulusReading::small_strain) return misses;
  // The laboratory's E is what the model's two dimensions were calibrated to.
  const auto S = plane_compliance(body_of(d.part(Part::elasticity).mean()), d.tests.reading.state);
  for (const Target& t : least_confined(d.tests.laboratory))
    if (t.property == Property::E) misses.add(std::log(theory::seen_at(S, t.theta).E / t.mean));
  return misses;
}

void add_laboratory(Design& d, Part part, const Misses& misses) {
  if (misses.n > 0)
    d.findings.push_back({.kind = Kind::design_laboratory,
                          .numbers = {{"error", misses.rms()},
                                      {"mean", misses.mean()},
                                      {"values", static_cast<double>(misses.n)}},
                          .names = {word_of(part), part == Part::elasticity ? "E" : "strength"}});
}

void find_laboratory(Design& d) {
  if (d.part(Part::elasticity).ok()) add_laboratory(d, Part::elasticity, moduli_missed(d));
  // Every law against the same values, so that they compare.
  std::size_t n = 0;
  for (const StrengthLaw& law : strength_laws()) {
    if (!d.part(law.part).ok()) continue;
    const Misses misses = strengths_missed(d, law);
    add_laboratory(d, law.part, misses), n += misses.n;
  }
  if (n == 0 && d.tests.strengths_sought) d.findings.push_back({.kind = Kind::design_no_laboratory});
}

/// A fabric that nobody needs.
bool is_stood_in(const Design& d, Part part) {
  return part == Part::fabric && d.part(Part::ubiquitous_joint).ok();
}

/// Inclinations that were tested and have no curve of Hoek and Brown.
void find_angles_without(Design& d) {
  const Pooled& part = d.part(Part::hoek_brown);
  if (!part.ok()) return;
  std::set<double> angles;
  for (const DrawTests& draw : d.tests.draws)
    for (const StrengthPoint& p : draw.compression) angles.insert(p.theta);
  for (const double theta : angles)
    if (part.find({Constant::sigma_ci, theta}) == nullptr)
      d.findings.push_back({.kind = Kind::design_refused,
                            .numbers = {{"theta", theta}},
                            .names = {word_of(Part::hoek_brown), word_of(Refusal::no_common)}});
}

void find_refusals(Design& d) {
  for (std::size_t p = 0; p < n_parts; ++p) {
    const Pooled& part = d.parts[p];
    // Nothing is said of what is whole.
    if (part.ok() ? part.n_without == 0 : is_stood_in(d, static_cast<Part>(p))) continue;
    d.findings.push_back({.kind = part.ok() ? Kind::design_partly : Kind::design_refused,
                          .numbers = {{"draws", static_cast<double>(part.n_draws + part.n_without)},
                                      {"without", static_cast<double>(part.n_without)}},
                          .names = {word_of(static_cast<Part>(p)), word_of(part.refusal)}});
  }
  find_angles_without(d);
}

/// What every strength is.
void find_strengths(Design& d) {
  const DesignTests& tests = d.tests;
  if (!tests.strengths_sought) return;
  std::size_t n = 0;
  for (const DrawTests& draw : tests.draws) n += draw.compression.size() + draw.tension.size();
  d.findings.push_back({.kind = Kind::design_range,
                        .numbers = {{"least", tests.stresses.front()},
                                    {"most", tests.stresses.back()},
                                    {"draws", static_cast<double>(tests.draws.size())},
                                    {"tests", static_cast<double>(n)},
                                    {"without", static_cast<double>(tests.n_without_strength)}}});
  d.findings.push_back(
      {.kind = tests.of_rock ? Kind::design_of_rock : Kind::design_of_model, .names = tests.undetermined});
}

/// Files of codes that lack a constant.
std::vector<std::string> files_without(const Design& d) {
  std::vector<std::string> names;
  const Values values = d.values();
  for (const Code& code : codes())
    if (!file_of(code, values, d.tests.rock)) names.emplace_back(code.file);
  return names;
}

/// What the table calls E, where constants at small strain do not compare with it.
std::vector<std::string> E_of_table(const DesignTests& tests) {
  const bool any = std::any_of(tests.laboratory.begin(), tests.laboratory.end(),
                               [](const Target& t) { return t.property == Property::E; });
  if (!any || tests.E_is == ModulusReading::small_strain) return {};
  return {to_string(tests.E_is)};
}

/// Two laws of one rock, fitted apart, may contradict each other.
void find_tension_above(Design& d) {
  const Values v = d.values();
  const double tension = v(Constant::sigma_t), least = v.tension_by_cohesion();
  if (tension > least)
    d.findings.push_back(
        {.kind = Kind::design_tension_above, .numbers = {{"sigma_t", tension}, {"by_cohesion", least}}});
}

void find_elasticity(Design& d) {
  const Pooled& part = d.part(Part::elasticity);
  if (!part.ok()) return;
  const bool given = std::isfinite(d.tests.reading.nu);
  d.findings.push_back({.kind = given ? Kind::design_nu_given : Kind::design_nu_unseen,
                        .numbers = {{"nu", part.value({Constant::nu})}}});
  d.findings.push_back({.kind = d.tests.reading.state == theory::PlaneState::stress
                                    ? Kind::design_plane_stress
                                    : Kind::design_plane_strain,
                        .names = E_of_table(d.tests)});
}

}  // namespace

Values Design::values() const {
  Values v;
  for (std::size_t p = 0; p < n_parts; ++p) v.parts[p] = &parts[p];
  v.dip = tests.dip;
  return v;
}

Design design_of(DesignTests tests) {
  Design d{std::move(tests), {}, {}};
  fit_parts(d);
  find_strengths(d);
  find_elasticity(d), find_refusals(d), find_laboratory(d);
  find_tension_above(d);
  d.findings.push_back({.kind = Kind::design_left_out});
  if (d.tests.strengths_sought) d.findings.push_back({.kind = Kind::design_strike});
  d.findings.push_back({.kind = Kind::design_not_fitted, .names = files_without(d)});
  return d;
}

}  // namespace phy::design
