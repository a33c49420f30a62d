#include "calibrate/foresee.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>

#include "calibrate/elastic_limits.hpp"
#include "calibrate/parameters.hpp"
#include "theory/eq1_fit.hpp"

namespace phy {
namespace {

constexpr double z_95 = 1.959964;

/// Jointed rock with logarithmic moduli: the four numbers that the four micro-parameters act on.
JointedRock rock_at(const Eigen::Vector4d& x) {
  return {std::exp(x[0]), std::exp(x[2]), std::exp(x[3]), x[1]};
}

constexpr double no_joint = 1e9;  // stiffness of a rock without joints, in units of E

/// The curve through the table: Eq. 1 with everything free, or a guess of usual joints where it refuses.
Eigen::Vector4d first_rock(const std::vector<Target>& targets, bool bedded) {
  std::vector<ModulusReading> readings;
  double stiffest = 0.0, nu = 0.25;
  for (const Target& t : targets) {
    if (t.property == Property::E)
      readings.push_back({t.theta, t.mean}), stiffest = std::max(stiffest, t.mean);
    if (t.property == Property::nu) nu = t.mean;
  }
  if (!bedded) return {std::log(stiffest), nu, std::log(no_joint * stiffest), std::log(no_joint * stiffest)};
  Eq1Options options;
  options.reference = Eq1Reference::free;
  const Eq1Fit fit = fit_eq1(readings, options);
  if (fit.ok()) return {std::log(fit.rock.E), nu, std::log(fit.rock.K_n_delta), std::log(fit.rock.K_s_delta)};
  return {std::log(stiffest), nu, std::log(2.0 * stiffest), std::log(stiffest)};
}

/// Standard deviations of log E, nu, log K_n, log K_s that the table can give, against the prior alone.
Eigen::Vector4d expected_sd(const std::vector<Target>& targets, bool bedded,
                            const Eigen::Vector4d& prior_sd) {
  const Eigen::Vector4d x = first_rock(targets, bedded);
  Eigen::Matrix4d information = prior_sd.array().square().inverse().matrix().asDiagonal();
  for (const Target& t : targets) {
    if (is_strength(t.property)) continue;
    const bool modulus = t.property == Property::E;
    const auto value = [&](const Eigen::Vector4d& y) {
      return modulus ? std::log(goodman_E(rock_at(y), t.theta)) : goodman_nu(rock_at(y), t.theta);
    };
    Eigen::Vector4d slope;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector4d h = 1e-4 * Eigen::Vector4d::Unit(i);
      slope[i] = (value(x + h) - value(x - h)) / 2e-4;
    }
    const double se = modulus ? t.standard_error() / t.mean : t.standard_error();
    information += slope * slope.transpose() / (se * se);
  }
  return information.inverse().diagonal().cwiseSqrt();
}

/// The test that tells most of an elastic parameter; more of them, where the table has it.
std::string elastic_test(const std::string& key, const std::vector<Target>& targets, bool bedded) {
  struct Test {
    const char* name;
    Property property;
    double from, to;
  };
  const Test test = key == "matrix.ks_over_kn"
                        ? Test{bedded ? "Poisson's ratio, best at 0 and 90 degrees" : "Poisson's ratio",
                               Property::nu, 0.0, 90.0}
                    : !bedded                 ? Test{"E", Property::E, 0.0, 90.0}
                    : key == "bedding[0].k_n" ? Test{"E at 0 or 15 degrees", Property::E, 0.0, 15.0}
                    : key == "bedding[0].k_s" ? Test{"E between 30 and 60 degrees", Property::E, 30.0, 60.0}
                                              : Test{"E at 90 degrees", Property::E, 80.0, 90.0};
  const bool has = std::any_of(targets.begin(), targets.end(), [&](const Target& t) {
    return t.property == test.property && t.theta >= test.from && t.theta <= test.to;
  });
  return has ? fmt::format("more specimens of {}", test.name) : test.name;
}

/// What the tests say about a strength parameter, by the kind and angle of the tests alone. Friction shows in
/// what no table holds, strength under confinement: it has no next test.
struct Rule {
  bool held;
  std::string tests, next_test;
};
Rule rule_without_bedding(const std::string& key, const std::vector<Target>& targets) {
  const bool pulled = !of_property(targets, Property::direct_tension).empty() ||
                      !of_property(targets, Property::brazilian).empty();
  if (key == "matrix.sigma_c") return {true, "UCS", ""};
  if (key == "tau_c/sigma_c") return {pulled, "UCS against tension", "direct tension, or Brazilian"};
  return {false, "", ""};
}
Rule rule_with_bedding(const std::string& key, const std::vector<Target>& targets) {
  bool ends = false, oblique = false, tension_0 = false, tension_90 = false;
  for (const Target& t : targets) {
    const bool pulled = t.property == Property::direct_tension, split = t.property == Property::brazilian;
    ends = ends || (t.property == Property::ucs && (t.theta <= 15.0 || t.theta >= 80.0));
    oblique = oblique || (t.property == Property::ucs && t.theta >= 30.0 && t.theta <= 75.0);
    // a disc splits along its load: planes at 90 degrees open in it, as those at 0 do in direct tension
    tension_0 = tension_0 || (pulled && t.theta <= 30.0) || (split && t.theta >= 60.0);
    tension_90 = tension_90 || (pulled && t.theta >= 60.0) || (split && t.theta <= 30.0);
  }
  if (key == "matrix.sigma_c") return {ends, "UCS near 0 or 90 degrees", "UCS at 0 and 90 degrees"};
  if (key == "C_sj/tau_c") return {oblique, "UCS between 30 and 75 degrees", "UCS at 45 and 60 degrees"};
  if (key == "sigma_n,sj/C_sj")
    return {tension_0, "tension across the bedding", "direct tension at 0 degrees, or Brazilian at 90"};
  if (key == "tau_c/sigma_c")
    return {ends && tension_90, "UCS against tension along the bedding",
            "direct tension at 90 degrees, or Brazilian at 0"};
  return {false, "", ""};
}

/// The rule in terms of what the table holds: without UCS nothing is fitted, and where the tests of a rule
/// are missing, UCS is all that the fit has.
void apply_strength_rule(ParameterEstimate& e, const std::vector<Target>& targets, bool bedded) {
  const Rule rule = bedded ? rule_with_bedding(e.key, targets) : rule_without_bedding(e.key, targets);
  const bool fitted = !of_property(targets, Property::ucs).empty();
  e.determined = fitted && rule.held;
  if (fitted) e.rests_on = rule.held ? rule.tests : "UCS";
  if (!rule.held) e.next_test = rule.next_test;
  if (!fitted && e.next_test.find("UCS") == std::string::npos)
    e.next_test = e.next_test.empty() ? "UCS" : "UCS, and " + e.next_test;
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

std::vector<ParameterEstimate> foresee(const Rock& rock) {
  const std::vector<Target> targets = targets_of(rock);
  std::vector<ParameterEstimate> estimates;
  const bool modulus = !of_property(targets, Property::E).empty(),
             has_nu = !of_property(targets, Property::nu).empty();
  Eigen::Vector4d prior;
  for (int i = 0; i < 4; ++i) {
    const Parameter& p = elastic_parameters()[static_cast<std::size_t>(i)];
    prior[i] = i == 1 ? 0.15 : 0.5 * std::log(p.high / p.low);
  }
  const Eigen::Vector4d sd = modulus ? expected_sd(targets, rock.bedded, prior) : prior;
  for (int i = 0; i < 4; ++i) {
    const Parameter& p = elastic_parameters()[static_cast<std::size_t>(i)];
    if (p.joint && !rock.bedded) continue;
    ParameterEstimate e;
    e.key = p.key, e.symbol = p.symbol, e.unit = p.unit, e.box_low = p.low, e.box_high = p.high;
    // nu against log q, q = ks/kn: the uniform-strain estimate nu = (1 - q)/(3 + q) falls by 4 q/(3 + q)^2
    const double in_log = i == 1 ? sd[i] / (4.0 * 0.3 / (3.3 * 3.3)) : sd[i];
    e.low = std::exp(-z_95 * in_log), e.high = std::exp(z_95 * in_log);  // factors on the value
    e.determined = modulus && 2.0 * z_95 * in_log < 0.5 * std::log(p.high / p.low);
    if (modulus) e.rests_on = i == 1 && has_nu ? "nu" : "E";
    if (!e.determined) e.next_test = elastic_test(p.key, targets, rock.bedded);
    estimates.push_back(e);
  }
  for (const Parameter& p : strength_parameters()) {
    if (p.joint && !rock.bedded) continue;
    ParameterEstimate e;
    e.key = p.key, e.symbol = p.symbol, e.unit = p.unit, e.box_low = p.low, e.box_high = p.high;
    apply_strength_rule(e, targets, rock.bedded);
    e.low = e.high = std::nan("");
    estimates.push_back(e);
  }
  return estimates;
}

std::vector<std::string> advice(const Rock& rock) {
  const std::vector<Target> targets = targets_of(rock);
  std::vector<std::string> lines;
  for (int i = 0; i < n_properties; ++i)
    if (std::string line = assumed_scatter(targets, static_cast<Property>(i)); !line.empty())
      lines.push_back(std::move(line));
  const auto has = [&](Property p) { return !of_property(targets, p).empty(); };
  if (!has(Property::E))
    lines.emplace_back("no E: the elastic parameters stay those of the recipe");
  else
    lines.emplace_back(
        "expected intervals count the scatter of the laboratory alone; what packings of the model differ by "
        "comes on top");
  if (!has(Property::ucs)) lines.emplace_back("no UCS: no strength is fitted, they stay those of the recipe");
  if (!rock.bedded) return lines;
  for (const std::string& line : {elastic_limit(targets), exchanged_angles(targets)})
    if (!line.empty()) lines.push_back(line);
  return lines;
}

}  // namespace phy
