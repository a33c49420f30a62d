#include "calibrate/identifiability.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/stats.hpp"
#include "calibrate/elastic_limits.hpp"
#include "calibrate/toughness.hpp"

namespace phy::calibrate {
namespace {

constexpr double no_joint = 1e9;  // stiffness of a rock without joints, in units of E

/// The curve through the table: Eq. 1 with everything free, or a guess of usual joints where it refuses.
theory::JointedRock first_rock(const Evidence& evidence) {
  double nu = 0.25;
  for (const Target& t : of_property(evidence.moduli, Property::nu)) nu = t.mean;
  const double stiffest = evidence.scales.modulus;
  if (!evidence.rock.bedded) return {stiffest, no_joint * stiffest, no_joint * stiffest, nu};
  const theory::Eq1Fit fit = eq1_through(evidence);
  if (fit.ok()) return {fit.rock.E, fit.rock.K_n_delta, fit.rock.K_s_delta, nu};
  return {stiffest, 2.0 * stiffest, stiffest, nu};
}

/// By the number itself, or by its logarithm?
bool by_number(const ElasticParameter& p) { return p.per_log > 0.0; }

double prior_sd(const ElasticParameter& p) {
  return by_number(p) ? p.prior_sd : 0.5 * std::log(p.range.high / p.range.low);
}

/// E or nu (E by its logarithm) of a rock of which one number has moved by a small step.
double moved(theory::JointedRock rock, const ElasticParameter& p, double step, const Target& t) {
  double& number = rock.*p.acts_on;
  number = by_number(p) ? number + step : std::exp(std::log(number) + step);
  return t.property == Property::E ? std::log(theory::goodman_E(rock, t.theta))
                                   : theory::goodman_nu(rock, t.theta);
}

/// Standard deviations that the table can give, of what the parameters act on; without E that of the prior
/// alone.
std::vector<double> expected_sd(const Evidence& evidence, const std::vector<const ElasticParameter*>& list) {
  constexpr double h = 1e-4;
  const auto n = static_cast<Eigen::Index>(list.size());
  std::vector<double> sd;
  for (const ElasticParameter* p : list) sd.push_back(prior_sd(*p));
  if (!evidence.has(Property::E)) return sd;
  Eigen::MatrixXd information =
      Eigen::Map<const Eigen::ArrayXd>(sd.data(), n).square().inverse().matrix().asDiagonal();
  const theory::JointedRock rock = first_rock(evidence);
  for (const Target& t : evidence.moduli) {
    Eigen::VectorXd slope(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const ElasticParameter& p = *list[static_cast<std::size_t>(i)];
      slope[i] = (moved(rock, p, h, t) - moved(rock, p, -h, t)) / (2.0 * h);
    }
    const double se = t.property == Property::E ? t.normal_error() / t.mean : t.normal_error();
    information += slope * slope.transpose() / (se * se);
  }
  const Eigen::VectorXd known = information.inverse().diagonal().cwiseSqrt();
  return {known.begin(), known.end()};
}

/// `sd`: of what it acts on.
Estimate identified_modulus(const ElasticParameter& p, double sd, const Evidence& evidence) {
  Estimate e = sought(p);
  e.box_low = p.range.low, e.box_high = p.range.high;
  const LabTest& test = evidence.rock.bedded ? p.bedded_test : p.intact_test;
  const bool fitted = evidence.has(Property::E);
  const double in_log = by_number(p) ? sd / p.per_log : sd;
  e.low = std::exp(-z_95 * in_log), e.high = std::exp(z_95 * in_log);  // factors on the value
  e.determined = fitted && 2.0 * z_95 * in_log < 0.5 * std::log(p.range.high / p.range.low);
  if (fitted)
    e.rests_on = {Basis::tests, {LabTest{evidence.has(test.property) ? test.property : Property::E}}};
  if (!e.determined) e.next = {holds(evidence.targets, test) ? Remedy::more_specimens : Remedy::test, {test}};
  return e;
}

/// The rule in terms of what the table holds: without a strength in compression nothing is fitted, and where
/// the tests of a rule are missing, those are all that the fit has.
Estimate identified_strength(const StrengthParameter& p, const Evidence& evidence) {
  Estimate e = sought(p);
  e.box_low = p.range.low, e.box_high = p.range.high;
  e.low = e.high = std::nan("");
  const Rule rule = p.rule(evidence);
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

/// What is taken for the scatter of a property that the table tells little of; empty: it tells.
std::string assumed_scatter(const std::vector<Target>& targets, Property property) {
  double least = 0.0, most = 0.0;
  std::size_t n = 0;
  const std::vector<Target> some = of_property(targets, property);
  for (const Target& t : some) {
    if (!t.sd_assumed) continue;
    const double sd = property == Property::nu ? t.sd : 100.0 * t.sd / t.mean;
    least = n == 0 ? sd : std::min(least, sd), most = std::max(most, sd), ++n;
  }
  if (n == 0) return "";
  const std::string from = fmt::format("{:.2g}", least), to = fmt::format("{:.2g}", most);
  return fmt::format(
      "{}: the table tells little of the scatter of {} of {} cells; {}{} is taken for single specimens",
      to_string(property), n, some.size(), from == to ? from : from + " to " + to,
      property == Property::nu ? "" : " %");
}

}  // namespace

std::vector<Estimate> identifiability(const Evidence& evidence) {
  std::vector<Estimate> estimates;
  const std::vector<const ElasticParameter*> elastic = elastic_parameters(evidence.rock.model);
  const std::vector<double> sd = expected_sd(evidence, elastic);
  for (std::size_t i = 0; i < elastic.size(); ++i)
    estimates.push_back(identified_modulus(*elastic[i], sd[i], evidence));
  for (const StrengthParameter* p : strength_parameters(evidence))
    estimates.push_back(identified_strength(*p, evidence));
  return estimates;
}

std::vector<std::string> advice(const Evidence& evidence) {
  std::vector<std::string> lines;
  for (int i = 0; i < n_properties; ++i)
    if (std::string line = assumed_scatter(evidence.targets, static_cast<Property>(i)); !line.empty())
      lines.push_back(std::move(line));
  if (!evidence.has(Property::E))
    lines.emplace_back("no E: the elastic parameters stay those of the recipe");
  else
    lines.emplace_back(
        "expected intervals count the scatter of the laboratory alone; what packings of the model differ by "
        "comes on top");
  if (!evidence.fits_strength())
    lines.emplace_back("no strength in compression: none is fitted, they stay those of the recipe");
  if (evidence.fits_strength())
    for (std::string& line : coarse_half_discs(evidence)) lines.push_back(std::move(line));
  if (!evidence.rock.bedded) {
    if (std::string line = confinement_limit(evidence.targets, evidence.rock.E_is); !line.empty())
      lines.push_back(std::move(line));
    return lines;
  }
  if (const std::string limit = elastic_limit(evidence.targets); !limit.empty())
    lines.push_back(evidence.rock.E_is == ModulusReading::small_strain
                        ? limit
                        : fmt::format("{}. As {} (E_is) E and nu need not be those of an elastic body", limit,
                                      to_string(evidence.rock.E_is)));
  return lines;
}

}  // namespace phy::calibrate
