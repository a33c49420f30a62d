#include "survey/identifiability.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/nan.hpp"
#include "base/stats.hpp"
#include "maps/layered_table.hpp"
#include "survey/cells.hpp"
#include "survey/elastic_limits.hpp"
#include "survey/half_discs.hpp"
#include "theory/goodman.hpp"

namespace phy::survey {
namespace {

constexpr double no_joint = 1e9;  // stiffness of a rock without joints, in units of E

/// The curve through the table: Eq. 1 with everything free, or a guess of usual joints where it refuses.
theory::JointedRock first_rock(const Evidence& evidence) {
  double nu = 0.25;
  for (const Target& t : of_property(evidence.moduli, Property::nu)) nu = t.mean;
  const double stiffest = evidence.scales.modulus;
  if (!evidence.rock.bedded) return {stiffest, no_joint * stiffest, no_joint * stiffest, nu};
  const theory::Eq1Fit fit = maps::eq1_through(evidence);
  if (fit.ok()) return {fit.rock.E, fit.rock.K_n_delta, fit.rock.K_s_delta, nu};
  return {stiffest, 2.0 * stiffest, stiffest, nu};
}

double theory::JointedRock::*number_of(MacroNumber number) {
  switch (number) {
    case MacroNumber::E: return &theory::JointedRock::E;
    case MacroNumber::nu: return &theory::JointedRock::nu;
    case MacroNumber::K_n_delta: return &theory::JointedRock::K_n_delta;
    case MacroNumber::K_s_delta: break;
  }
  return &theory::JointedRock::K_s_delta;
}

/// By the number itself, or by its logarithm?
bool by_number(const Parameter& p) { return p.modulus->per_log > 0.0; }

double prior_sd(const Parameter& p) {
  return by_number(p) ? p.modulus->prior_sd : 0.5 * std::log(p.range.high / p.range.low);
}

/// E or nu (E by its logarithm) of a rock of which one number has moved by a small step, with E where the
/// parameter behind it moves that too.
double moved(theory::JointedRock rock, const Parameter& p, double step, const Target& t) {
  double& number = rock.*number_of(p.modulus->acts_on);
  number = by_number(p) ? number + step : std::exp(std::log(number) + step);
  if (by_number(p)) rock.E *= std::exp(-p.modulus->E_per_log / p.modulus->per_log * step);
  return t.property == Property::E ? std::log(theory::goodman_E(rock, t.theta))
                                   : theory::goodman_nu(rock, t.theta);
}

/// Chi-square of the nearest layered body per degree of freedom, 1 or more: moduli of a table that no body
/// has are known no better than the nearest one fits.
double misfit_of(const Evidence& evidence) {
  if (!evidence.rock.bedded) return 1.0;
  const theory::LayeredFit nearest =
      theory::fit_layered(maps::layered_readings(evidence.moduli), theory::LayeredBody::any);
  return std::max(1.0, nearest.chi_square / std::max(1, nearest.degrees_of_freedom));
}

/// Standard deviations that the table can give, of what the parameters act on; without E that of the prior
/// alone.
std::vector<double> expected_sd(const Evidence& evidence, const std::vector<const Parameter*>& list) {
  constexpr double h = 1e-4;
  const auto n = static_cast<Eigen::Index>(list.size());
  std::vector<double> sd;
  for (const Parameter* p : list) sd.push_back(prior_sd(*p));
  if (!evidence.has(Property::E)) return sd;
  Eigen::MatrixXd information =
      Eigen::Map<const Eigen::ArrayXd>(sd.data(), n).square().inverse().matrix().asDiagonal();
  const theory::JointedRock rock = first_rock(evidence);
  const double misfit = misfit_of(evidence);
  for (const Target& t : evidence.moduli) {
    Eigen::VectorXd slope(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Parameter& p = *list[static_cast<std::size_t>(i)];
      slope[i] = (moved(rock, p, h, t) - moved(rock, p, -h, t)) / (2.0 * h);
    }
    const double se = t.property == Property::E ? t.normal_error() / t.mean : t.normal_error();
    information += slope * slope.transpose() / (misfit * se * se);
  }
  const Eigen::VectorXd known = information.inverse().diagonal().cwiseSqrt();
  return {known.begin(), known.end()};
}

/// `sd`: of what it acts on.
Estimate identified_modulus(const Parameter& p, double sd, const Evidence& evidence) {
  Estimate e = sought(p);
  e.box_low = p.range.low, e.box_high = p.range.high;
  const LabTest& test = evidence.rock.bedded ? p.modulus->bedded_test : p.modulus->intact_test;
  const bool fitted = evidence.has(Property::E);
  const double in_log = by_number(p) ? sd / p.modulus->per_log : sd;
  e.low = std::exp(-z_95 * in_log), e.high = std::exp(z_95 * in_log);  // factors on the value
  e.determined = fitted && 2.0 * z_95 * in_log < 0.5 * std::log(p.range.high / p.range.low);
  if (fitted)
    e.rests_on = {Basis::tests, {LabTest{evidence.has(test.property) ? test.property : Property::E}}};
  if (!e.determined) e.next = {holds(evidence.targets, test) ? Remedy::more_specimens : Remedy::test, {test}};
  return e;
}

/// The rule in terms of what the table holds: without a strength in compression nothing is fitted, and where
/// the tests of a rule are missing, those are all that the fit has.
Estimate identified_strength(const Parameter& p, const Evidence& evidence) {
  Estimate e = sought(p);
  e.box_low = p.range.low, e.box_high = p.range.high;
  e.low = e.high = std::nan("");
  const Rule rule = p.strength->rule(evidence);
  const bool fitted = evidence.fits_strength();
  e.determined = fitted && rule.held && !rule.shared;
  if (fitted) {
    const LabTest compression{compression_of(evidence)};
    e.rests_on = {Basis::tests,
                  rule.held ? held_by(evidence.targets, rule.tests) : std::vector<LabTests>{compression}};
  }
  if (e.determined) return e;
  std::vector<LabTests> next = rule.next;
  const auto is_ucs = [](const LabTests& t) { return t.any_of.front().property == Property::ucs; };
  if (!fitted && std::none_of(next.begin(), next.end(), is_ucs))
    next.insert(next.begin(), LabTest{Property::ucs});
  if (!next.empty()) e.next = {Remedy::test, std::move(next)};
  return e;
}

/// What is taken for the scatter of cells of which the table says little, by property.
void report_assumed_scatter(const Evidence& evidence, std::vector<Finding>& found) {
  for (int i = 0; i < n_properties; ++i) {
    const auto property = static_cast<Property>(i);
    const std::vector<Target> some = of_property(evidence.targets, property);
    Finding f{FindingKind::scatter_assumed};
    double least = nan, most = nan;
    for (const Target& t : some) {
      if (!t.sd_assumed) continue;
      const double sd = property == Property::nu ? t.sd : t.sd / t.mean;
      least = std::fmin(least, sd), most = std::fmax(most, sd);
      f.cells.push_back(cell_in(evidence.rock, t));
    }
    if (f.cells.empty()) continue;
    f.numbers = {{"least", least}, {"most", most}, {"of", static_cast<double>(some.size())}};
    found.push_back(std::move(f));
  }
}

void append(std::vector<Finding>& found, const std::vector<Finding>& more) {
  found.insert(found.end(), more.begin(), more.end());
}

}  // namespace

std::vector<Estimate> identifiability(const Evidence& evidence) {
  std::vector<Estimate> estimates;
  const std::vector<const Parameter*> elastic = elastic_parameters(evidence.rock.model);
  const std::vector<double> sd = expected_sd(evidence, elastic);
  for (std::size_t i = 0; i < elastic.size(); ++i)
    estimates.push_back(identified_modulus(*elastic[i], sd[i], evidence));
  for (const Parameter* p : strength_parameters(evidence))
    estimates.push_back(identified_strength(*p, evidence));
  return estimates;
}

std::vector<Finding> limits_of_table(const Evidence& evidence) {
  const ModulusReading E_is = evidence.rock.E_is;
  std::vector<Finding> found;
  report_assumed_scatter(evidence, found);
  // packings of the model differ too, which comes on top of what the laboratory's scatter lets expect
  const bool moduli = evidence.has(Property::E);
  found.push_back({moduli ? FindingKind::packings_not_counted : FindingKind::no_modulus});
  if (evidence.fits_strength())
    append(found, coarse_half_discs(evidence));
  else
    found.push_back({FindingKind::no_compression});
  append(found, cells_in(evidence.rock, confinement_limits(evidence.targets, E_is)));
  if (!evidence.rock.bedded) return found;
  append(found, few_grains_between(evidence));
  for (Finding f : elastic_limits(evidence.targets)) {
    // on the way to its strength a rock need not be an elastic body
    if (E_is != ModulusReading::small_strain) f.names = {to_string(E_is)};
    found.push_back(std::move(f));
  }
  return found;
}

}  // namespace phy::survey
