#include "calibrate/softening.hpp"

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

constexpr double least_change = 0.01;  // of E, and to nu, that is none
constexpr double softening_step = 0.65;
// nu = 0 lies at the end of the box of k_s/k_n: a tenth is left to the direct solution.
constexpr double most_nu = 0.9;  // share of nu that an addition may take away

double number(const TestResult& result, const char* name) {
  const Number* n = analysis::find(result.numbers, name);
  return n != nullptr ? n->value : nan;
}

}  // namespace

TestRead test_of_cell(const Target& t) { return {t.confining, t.theta}; }

std::vector<Target> tests_to_read(const Evidence& evidence) {
  std::vector<Target> tests;
  for (const Target& t : evidence.strengths) {
    const auto is_read = [&](const Target& m) { return test_of_cell(m) == test_of_cell(t); };
    if (t.property == Property::ucs || (t.property == Property::confined &&
                                        std::any_of(evidence.moduli.begin(), evidence.moduli.end(), is_read)))
      tests.push_back(t);
  }
  tests.insert(tests.end(), evidence.read_only.begin(), evidence.read_only.end());
  return tests;
}

std::optional<Softening> softening_of(const TestResult& test, Property property,
                                      const ElasticResult& solution, ModulusReading reading) {
  const Softening s = {modulus_of(test, property, reading) / reading_of(solution, Property::E),
                       number(test, "nu") - reading_of(solution, Property::nu)};
  if (!(s.factor > 0.0) || !std::isfinite(s.factor) || !std::isfinite(s.addition)) return {};
  return s;
}

Recipe as_for_moduli(Recipe specimen, const Recipe& model) {
  specimen.matrix.unbonded_fraction = model.matrix.unbonded_fraction;
  return specimen;
}

Softenings softenings_of(const TestsToRead& read, Simulator& simulator) {
  const std::vector<Target>& tests = read.tests;
  const std::vector<std::int64_t>& packings = read.packings;
  const StrengthTests settings(read.recipe, tests, packings.front(), simulator);
  std::vector<Recipe> recipes, unbroken;
  for (std::size_t i = 0; i < tests.size(); ++i)
    for (const std::int64_t packing : packings) {
      recipes.push_back(settings.of(read.recipe, i, packing, as_measured));
      unbroken.push_back(as_for_moduli(recipes.back(), read.model));
    }
  const std::vector<TestResult> results = simulator.test(recipes);
  // One-sided as the press is: contacts that pull would count as softening what is none.
  const std::vector<ElasticResult> solutions = simulator.elastic(unbroken, Statics::one_sided);
  Softenings mean;  // over packings: of the factor the geometric one
  for (std::size_t i = 0; i < tests.size(); ++i) {
    double log_factor = 0.0, addition = 0.0;
    int n = 0;
    for (std::size_t k = i * packings.size(); k < (i + 1) * packings.size(); ++k)
      if (const auto s = softening_of(results[k], tests[i].property, solutions[k], read.reading))
        log_factor += std::log(s->factor), addition += s->addition, ++n;
    if (n > 0) mean[test_of_cell(tests[i])] = {std::exp(log_factor / n), addition / n};
  }
  return mean;
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
  for (auto& [test, s] : next) {
    const Softening before = softening_at(used, test);
    s.factor = before.factor * std::pow(s.factor / before.factor, softening_step);
    s.addition = std::lerp(before.addition, s.addition, softening_step);
  }
  return next;
}

Softening softening_at(const Softenings& softenings, const TestRead& test) {
  if (softenings.empty()) return {};
  const auto nearer = [&](const auto& a, const auto& b) {
    return std::fabs(a.first.confining - test.confining) < std::fabs(b.first.confining - test.confining);
  };
  const double nearest = std::min_element(softenings.begin(), softenings.end(), nearer)->first.confining;
  const auto first = softenings.lower_bound({nearest, -infinity}),
             last = softenings.upper_bound({nearest, infinity});
  const auto above = softenings.lower_bound({nearest, test.theta});
  if (above == last) return std::prev(above)->second;
  if (above == first || above->first.theta == test.theta) return above->second;
  const auto below = std::prev(above);
  const double share = (test.theta - below->first.theta) / (above->first.theta - below->first.theta);
  return {std::lerp(below->second.factor, above->second.factor, share),
          std::lerp(below->second.addition, above->second.addition, share)};
}

Evidence at_small_strain(const Evidence& evidence, const Softenings& softenings) {
  std::vector<Target> targets = evidence.targets;
  for (Target& t : targets) {
    const Softening s = softening_at(softenings, test_of_cell(t));
    if (t.property == Property::E) t.mean /= s.factor, t.sd /= s.factor;
    // The scatter of nu stays: an addition does not widen it.
    if (t.property == Property::nu) t.mean -= std::min(s.addition, most_nu * t.mean);
  }
  return Evidence(evidence.rock, std::move(targets));
}

}  // namespace phy::calibrate
