#include "calibrate/calibration.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numeric>
#include <set>

#include "calibrate/elastic_stage.hpp"
#include "calibrate/foresee.hpp"

namespace phy {
namespace {

constexpr int n_fit = 5;     // packings of the fit
constexpr int n_unseen = 5;  // packings of the verification

/// Seeds from `first` on.
std::vector<std::int64_t> seeds_from(std::int64_t first, int n) {
  std::vector<std::int64_t> seeds(static_cast<std::size_t>(n));
  std::iota(seeds.begin(), seeds.end(), first);
  return seeds;
}

std::size_t n_angles(const std::vector<Comparison>& rows) {
  std::set<double> angles;
  for (const Comparison& c : rows) angles.insert(c.target.theta);
  return angles.size();
}

/// Which data speak about each parameter, and what would pin the others.
void add_identifiability(Calibration& result, const Rock& rock) {
  const std::vector<ParameterEstimate> foreseen = foresee(rock);
  for (ParameterEstimate& e : result.parameters)
    for (const ParameterEstimate& f : foreseen) {
      if (f.key != e.key) continue;
      e.rests_on = e.determined ? f.rests_on : "";
      if (!e.determined) e.next_test = f.next_test.empty() ? "more specimens of: " + f.rests_on : f.next_test;
    }
}

void judge(Calibration& result, const ElasticFit& elastic) {
  Verdict& v = result.verdict;
  v.findings.insert(v.findings.begin(), elastic.findings.begin(), elastic.findings.end());
  if (elastic.out_of_reach) v.status = VerdictStatus::out_of_reach;
  if (v.status == VerdictStatus::calibrated && !v.findings.empty())
    v.status = VerdictStatus::calibrated_except;
}

}  // namespace

double rmse(const std::vector<Comparison>& rows, Property property) {
  double squares = 0.0;
  int n = 0;
  for (const Comparison& c : rows) {
    if (c.target.property != property) continue;
    const double error = property == Property::nu ? c.mean - c.target.mean : c.error();
    squares += error * error, ++n;
  }
  return n > 0 ? std::sqrt(squares / n) : std::nan("");
}

Calibration calibrate(const Rock& rock, const CalibrationOptions& options, Simulator& simulator) {
  const auto start = std::chrono::steady_clock::now();
  Calibration result;
  result.rock = rock.name;
  const std::vector<Target> targets = targets_of(rock);
  const std::int64_t first_seed = rock.model.packing.seed;
  const std::vector<std::int64_t> fit_seeds = seeds_from(first_seed, n_fit);
  const std::vector<std::int64_t> unseen = seeds_from(first_seed + n_fit, n_unseen);
  const ElasticFit elastic = fit_elastic(rock, targets, fit_seeds, simulator, options.say);
  result.recipe = elastic.recipe;
  result.recipe.name = rock.name + ", calibrated";
  result.parameters = elastic.parameters;
  result.fitted = elastic.comparisons;
  result.n_elastic = elastic.n_solutions;
  options.say("verification of the moduli on unseen packings");
  result.verification = elastic_response(result.recipe, targets, unseen, simulator);
  result.n_elastic += static_cast<std::int64_t>(n_angles(result.verification) * unseen.size());
  add_identifiability(result, rock);
  judge(result, elastic);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace phy
