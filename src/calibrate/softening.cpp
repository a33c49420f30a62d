#include "calibrate/softening.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "analysis/analyse.hpp"
#include "base/nan.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/strength_tests.hpp"

namespace phy::calibrate {
namespace {

// Of one run, and how far the place in the box is believed to matter, in units of log E and of nu.
constexpr double run_scatter = 0.03, slope = 0.1;
constexpr double least_change = 0.01;  // of E, and to nu, that is none
constexpr double step = 0.65;
constexpr double most_nu = 0.9;  // share of nu that an addition may take away

double number(const TestResult& result, const char* name) {
  const Number* n = analysis::find(result.numbers, name);
  return n != nullptr ? n->value : nan;
}

/// Value at z of a ridge regression linear in z.
template <class Pairs, class Value>
double regressed(const Pairs& pairs, const std::vector<double>& z, const Value& value) {
  const auto n = static_cast<Eigen::Index>(z.size() + 1);
  const auto features = [&](const std::vector<double>& at) {
    Eigen::VectorXd f(n);
    f[0] = 1.0;
    for (Eigen::Index i = 1; i < n; ++i) f[i] = at[static_cast<std::size_t>(i - 1)];
    return f;
  };
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n) * (run_scatter * run_scatter / (slope * slope));
  A(0, 0) = 1e-6;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  for (const auto& p : pairs) A += features(p.z) * features(p.z).transpose(), b += features(p.z) * value(p);
  return features(z).dot(A.ldlt().solve(b));
}

}  // namespace

void SofteningRecord::add(double theta, std::vector<double> z, const TestResult& test,
                          const ElasticResult& solution) {
  const Pair pair{std::move(z), std::log(modulus_of(test, reading_) / reading_of(solution, Property::E)),
                  number(test, "nu") - reading_of(solution, Property::nu)};
  if (std::isfinite(pair.log_factor) && std::isfinite(pair.addition)) pairs_[theta].push_back(pair);
}

Softenings SofteningRecord::at(const std::vector<double>& z) const {
  Softenings all;
  for (const auto& [theta, pairs] : pairs_)
    all[theta] = {std::exp(regressed(pairs, z, [](const Pair& p) { return p.log_factor; })),
                  regressed(pairs, z, [](const Pair& p) { return p.addition; })};
  return all;
}

Softenings softenings_of(const Recipe& recipe, const std::vector<Target>& strengths,
                         const std::vector<std::int64_t>& seeds, ModulusReading reading,
                         Simulator& simulator) {
  const std::vector<Target> ucs = of_property(strengths, Property::ucs);
  const StrengthTests tests(recipe, ucs, seeds.front(), simulator);
  std::vector<Recipe> recipes;
  for (std::size_t i = 0; i < ucs.size(); ++i)
    for (const std::int64_t seed : seeds) recipes.push_back(tests.of(recipe, i, seed, Loading::from_rest));
  const std::vector<TestResult> results = simulator.test(recipes);
  const std::vector<ElasticResult> solutions = simulator.elastic(recipes, false);
  SofteningRecord record(reading);
  for (std::size_t k = 0; k < recipes.size(); ++k)
    record.add(ucs[k / seeds.size()].theta, {}, results[k], solutions[k]);
  return record.at({});
}

bool settled(const Softenings& used, const Softenings& measured) {
  return std::all_of(measured.begin(), measured.end(), [&](const auto& at) {
    const Softening before = softening_at(used, at.first);
    return std::fabs(at.second.factor / before.factor - 1.0) < least_change &&
           std::fabs(at.second.addition - before.addition) < least_change;
  });
}

Softenings stepped(const Softenings& used, const Softenings& measured) {
  Softenings next = measured;
  for (auto& [theta, s] : next) {
    const Softening before = softening_at(used, theta);
    s.factor = before.factor * std::pow(s.factor / before.factor, step);
    s.addition = std::lerp(before.addition, s.addition, step);
  }
  return next;
}

Softening softening_at(const Softenings& softenings, double theta) {
  if (softenings.empty()) return {};
  const auto above = softenings.lower_bound(theta);
  if (above == softenings.end()) return std::prev(above)->second;
  if (above == softenings.begin() || above->first == theta) return above->second;
  const auto below = std::prev(above);
  const double share = (theta - below->first) / (above->first - below->first);
  return {std::lerp(below->second.factor, above->second.factor, share),
          std::lerp(below->second.addition, above->second.addition, share)};
}

Evidence at_small_strain(const Evidence& evidence, const Softenings& softenings) {
  std::vector<Target> targets = evidence.targets;
  for (Target& t : targets) {
    const Softening s = softening_at(softenings, t.theta);
    if (t.property == Property::E) t.mean /= s.factor, t.sd /= s.factor;
    if (t.property == Property::nu) t.mean -= std::min(s.addition, most_nu * t.mean);
  }
  return Evidence(evidence.rock, std::move(targets));
}

}  // namespace phy::calibrate
