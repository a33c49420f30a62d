#include "calibrate/strength_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "analysis/analyse.hpp"
#include "analysis/brazilian.hpp"
#include "base/rng.hpp"
#include "base/stats.hpp"
#include "calibrate/elastic_stage.hpp"
#include "calibrate/ensemble.hpp"
#include "calibrate/experience.hpp"
#include "calibrate/parameters.hpp"
#include "calibrate/surrogate.hpp"

namespace phy {
namespace {

using Eigen::VectorXd;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t most_points = 36;
constexpr double coarse_factor = 2.5;         // magnification of the grains
constexpr std::int64_t fewest_grains = 1000;  // of a coarse packing
constexpr int n_starts = 2048, n_walkers = 64, n_sweeps = 600, thin = 15;
constexpr double usual_ratio = 2.2;  // largest UCS over sigma_c, for the first batch only
constexpr double wave_transits = 100.0;
constexpr double search_speed = 2.0;
constexpr double jump_share = 0.35;  // of the expected peak strain
// Approach of the jaws over the diameter, in units of BTS/E: 5.5 for arcs of 10 degrees on an elastic disc
// (1 - nu + ln(1 + 4/sin^2 5 deg), Wang et al. 2004, IJRMMS 41:245-253, nu = 0.25), less for wider ones.
constexpr double disc_approach = 5.0;
constexpr std::int64_t disc_interval = 25;  // steps between rows: a disc breaks in some 2,000 steps or more
constexpr std::uint32_t sampler_seed = 20100101;

/// The posterior and everything it is made of. Coordinates: log sigma_c, then the ratios in [-1, 1].
class StrengthProblem {
 public:
  /// `recipe`: moduli of the rock.
  StrengthProblem(const Rock& rock, const Recipe& recipe, const std::vector<Target>& targets)
      : runs_(targets.size()), targets_(targets) {
    for (const Parameter& p : strength_parameters())
      if (!p.joint || rock.bedded) parameters_.push_back(&p);
    for (const Target& t : targets) {
      largest_ = std::max(largest_, t.mean);
      foretold_.push_back(foretold_strength(recipe, t.property, t.theta));
    }
  }

  Eigen::Index n_ratios() const { return static_cast<Eigen::Index>(parameters_.size()) - 1; }
  std::size_t n_targets() const { return targets_.size(); }
  std::size_t n_tension() const { return targets_.size() - of_property(targets_, Property::ucs).size(); }
  const std::vector<Target>& targets() const { return targets_; }
  const Parameter& parameter(std::size_t i) const { return *parameters_[i]; }
  double box_low(std::size_t i) const { return std::log(parameter(i).low * (i == 0 ? largest_ : 1.0)); }
  double box_high(std::size_t i) const { return std::log(parameter(i).high * (i == 0 ? largest_ : 1.0)); }
  double first_sigma() const { return std::log(largest_ / usual_ratio); }

  /// Logarithm of parameter i at a point.
  double log_value(const VectorXd& x, std::size_t i) const {
    if (i == 0) return x[0];
    return box_low(i) + 0.5 * (x[static_cast<Eigen::Index>(i)] + 1.0) * (box_high(i) - box_low(i));
  }
  Recipe recipe_at(Recipe recipe, const VectorXd& x) const {
    for (std::size_t i = 0; i < parameters_.size(); ++i) parameter(i).set(recipe, std::exp(log_value(x, i)));
    return recipe;
  }

  void add_run(std::size_t target, SurrogateRun run) { runs_[target].push_back(std::move(run)); }
  /// Every target has an answer of its own.
  bool has_runs() const {
    return std::all_of(runs_.begin(), runs_.end(), [](const auto& r) { return !r.empty(); });
  }
  void learn() {
    models_.clear();
    discrepancy_ = 0.0;
    for (std::size_t i = 0; i < runs_.size(); ++i) models_.emplace_back(runs_[i], foretold_[i]);
  }
  Surrogate::Value predict(const VectorXd& x, std::size_t target) const {
    Surrogate::Value v = models_[target].at(x.tail(n_ratios()));
    v.mean += x[0];
    return v;
  }

  /// Without target `left_out` if that is one.
  double log_posterior(const VectorXd& x, std::size_t left_out) const {
    if (x[0] < box_low(0) || x[0] > box_high(0) || x.tail(n_ratios()).cwiseAbs().maxCoeff() > 1.0)
      return -infinity;
    double sum = 0.0;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (i == left_out) continue;
      const Surrogate::Value model = predict(x, i);
      const double error = std::log(targets_[i].mean) - model.mean,
                   v = model.variance + variance(targets_[i]) + discrepancy_;
      sum -= 0.5 * (error * error / v + std::log(v));
    }
    return sum;
  }
  /// A table that no rock of the box meets: what the best known of the draws misses beyond scatter and
  /// ignorance becomes part of every variance. Else the likeliest rocks would be those of which least is
  /// known. True if there is any.
  bool find_discrepancy(const std::vector<VectorXd>& draws) {
    double least = infinity;
    for (const VectorXd& x : draws) {
      double expected = 0.0, beyond = 0.0;
      for (std::size_t i = 0; i < targets_.size(); ++i) {
        const Surrogate::Value model = predict(x, i);
        const double error = std::log(targets_[i].mean) - model.mean;
        expected += error * error + model.variance;
        beyond += error * error - model.variance - variance(targets_[i]);
      }
      if (expected < least)
        least = expected, discrepancy_ = std::max(0.0, beyond / static_cast<double>(targets_.size()));
    }
    return discrepancy_ > 0.0;
  }
  double discrepancy() const { return discrepancy_; }
  static double variance(const Target& t) {
    const double relative = t.standard_error() / t.mean;
    return relative * relative;
  }

  std::vector<VectorXd> draws(std::size_t left_out, std::uint32_t seed) const {
    return sample([&](const VectorXd& x) { return log_posterior(x, left_out); }, walkers(left_out), n_sweeps,
                  thin, seed);
  }

  /// The likeliest of many points all over the box: a walker that starts where nothing fits may not find
  /// out of there.
  std::vector<VectorXd> walkers(std::size_t left_out) const {
    std::vector<std::pair<double, VectorXd>> points;
    for (VectorXd& x : spread_points(n_starts)) {
      x[0] = best_sigma(x, left_out);
      points.emplace_back(log_posterior(x, left_out), x);
    }
    std::stable_sort(points.begin(), points.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<VectorXd> best;
    for (int i = 0; i < n_walkers; ++i) best.push_back(points[static_cast<std::size_t>(i)].second);
    return best;
  }

  /// Points that fill the box evenly: the additive recurrence of Roberts (2018) with powers of the
  /// generalised golden ratio.
  std::vector<VectorXd> spread_points(int n) const {
    const auto d = static_cast<double>(n_ratios());
    double phi = 2.0;
    for (int i = 0; i < 60; ++i) phi = std::pow(1.0 + phi, 1.0 / (d + 1.0));
    std::vector<VectorXd> points;
    for (int i = 0; i < n; ++i) {
      VectorXd x(n_ratios() + 1);
      x[0] = first_sigma();
      for (Eigen::Index j = 1; j <= n_ratios(); ++j) {
        const double u = 0.5 + (i + 1) / std::pow(phi, static_cast<double>(j));
        x[j] = 2.0 * (u - std::floor(u)) - 1.0;
      }
      points.push_back(x);
    }
    return points;
  }

  /// sigma_c that fits best with the ratios of a point.
  double best_sigma(const VectorXd& x, std::size_t left_out) const {
    double weight = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      if (i == left_out) continue;
      const Surrogate::Value f = models_[i].at(x.tail(n_ratios()));
      const double w = 1.0 / (f.variance + variance(targets_[i]) + discrepancy_);
      weight += w, sum += w * (std::log(targets_[i].mean) - f.mean);
    }
    return std::clamp(sum / weight, box_low(0) + 1e-6, box_high(0) - 1e-6);
  }

 private:
  std::vector<std::vector<SurrogateRun>> runs_;  // per target
  std::vector<Foretold> foretold_;               // per target
  std::vector<Surrogate> models_;
  std::vector<Target> targets_;
  std::vector<const Parameter*> parameters_;
  double largest_ = 0.0;
  double discrepancy_ = 0.0;  // variance of what the model cannot meet
};

constexpr std::size_t none = static_cast<std::size_t>(-1);

VectorXd mean_of(const std::vector<VectorXd>& points) {
  VectorXd mean = VectorXd::Zero(points.front().size());
  for (const VectorXd& p : points) mean += p / static_cast<double>(points.size());
  return mean;
}

/// The draw in the middle: nearest to the mean of all, in predictions and, weaker, in parameters, and to the
/// laboratory. Distances are expected ones: what the surrogate does not know of a draw puts it farther away,
/// so that of two draws that fit alike the better known is taken.
std::size_t middle(const StrengthProblem& problem, const std::vector<VectorXd>& draws) {
  std::vector<VectorXd> seen;
  std::vector<double> misfit;
  for (const VectorXd& x : draws) {
    VectorXd y(static_cast<Eigen::Index>(problem.n_targets()) + x.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < problem.n_targets(); ++i) {
      const Target& t = problem.targets()[i];
      const Surrogate::Value v = problem.predict(x, i);
      const double lab = StrengthProblem::variance(t), error = std::log(t.mean) - v.mean;
      y[static_cast<Eigen::Index>(i)] = v.mean / std::sqrt(lab);
      sum += (v.variance + error * error) / lab;
    }
    misfit.push_back(sum);
    y.tail(x.size()) = x;
    seen.push_back(y);
  }
  const VectorXd centre = mean_of(seen);
  const auto distance = [&](std::size_t i) { return (seen[i] - centre).squaredNorm() + misfit[i]; };
  std::size_t best = 0;
  for (std::size_t i = 1; i < seen.size(); ++i)
    if (distance(i) < distance(best)) best = i;
  return best;
}

/// `n` of the draws, far from each other, the one in the middle first.
std::vector<VectorXd> spread_draws(const StrengthProblem& problem, const std::vector<VectorXd>& draws,
                                   std::size_t n) {
  std::vector<VectorXd> chosen = {draws[middle(problem, draws)]};
  const auto d = problem.n_ratios();
  while (chosen.size() < n) {
    double furthest = -1.0;
    const VectorXd* next = &draws.front();
    for (const VectorXd& x : draws) {
      double nearest = infinity;
      for (const VectorXd& c : chosen) nearest = std::min(nearest, (x.tail(d) - c.tail(d)).squaredNorm());
      if (nearest > furthest) furthest = nearest, next = &x;
    }
    chosen.push_back(*next);
  }
  return chosen;
}

/// The same specimen with fewer, larger grains: planes, zone and joint stiffness in proportion, so that all
/// dimensionless numbers stay.
Recipe coarse(Recipe r) {
  r.packing.radius_min *= coarse_factor, r.packing.radius_max *= coarse_factor;
  r.packing.n_grains =
      std::llround(static_cast<double>(r.packing.n_grains) / (coarse_factor * coarse_factor));
  for (BeddingRecipe& b : r.bedding) {
    b.spacing *= coarse_factor, b.zone_thickness *= coarse_factor, b.offset *= coarse_factor;
    b.k_n /= coarse_factor, b.k_s /= coarse_factor;
  }
  return r;
}
bool has_coarse(const Recipe& r) {
  return r.packing.file.empty() && static_cast<double>(r.packing.n_grains) >=
                                       static_cast<double>(fewest_grains) * coarse_factor * coarse_factor;
}

struct Batch {
  bool coarse;
  std::size_t n_points;
};
/// A third of the points anywhere in the box, then three times two ninths among the draws; the last two
/// batches on the grains of the recipe. Every point costs `n_ucs` of the tests.
std::vector<Batch> plan(std::int64_t max_tests, std::size_t n_ucs, bool with_coarse) {
  const std::int64_t points =
      std::clamp(max_tests / static_cast<std::int64_t>(n_ucs), least_points, most_points);
  const std::int64_t last = std::max<std::int64_t>(1, points * 2 / 9);
  const auto n_last = static_cast<std::size_t>(last), n_first = static_cast<std::size_t>(points - 3 * last);
  return {{with_coarse, n_first}, {with_coarse, n_last}, {false, n_last}, {false, n_last}};
}

/// Strain at which each target is expected to peak: laboratory strength over the modulus of the recipe; of a
/// disc, the approach over the diameter.
std::vector<double> peak_strains(const Recipe& recipe, const std::vector<Target>& targets, std::int64_t seed,
                                 Simulator& simulator) {
  std::vector<Recipe> recipes;
  for (const Target& t : targets) recipes.push_back(single_at(recipe, t.theta, seed));
  const std::vector<ElasticResult> elastic = simulator.elastic(recipes, true);
  std::vector<double> strains;
  for (std::size_t i = 0; i < targets.size(); ++i)
    strains.push_back((targets[i].property == Property::brazilian ? disc_approach : 1.0) * targets[i].mean /
                      elastic[i].E_gauge);
  return strains;
}

/// Speed of platens or grips at which a wave crosses the specimen a hundred times until the earliest peak of
/// a property; infinite without targets.
double slow_speed(const Recipe& recipe, const std::vector<Target>& targets,
                  const std::vector<double>& strains, Property property) {
  double speed = infinity;
  for (std::size_t i = 0; i < targets.size(); ++i)
    if (targets[i].property == property) {
      const double factor = property == Property::brazilian ? disc_approach : 1.0;
      const double wave = std::sqrt(factor * targets[i].mean / strains[i] / recipe.matrix.density);
      speed = std::min(speed, 0.5 * strains[i] * wave / wave_transits);
    }
  return speed;
}

/// How a strength of the table is tested, and which number of the result it is.
struct Procedure {
  Property property;
  TestKind kind;
  const char* number;
};
const Procedure* procedure_of(Property property) {
  static const std::vector<Procedure> list = {{Property::ucs, TestKind::uniaxial, "ucs"},
                                              {Property::direct_tension, TestKind::direct_tension, "sigma_t"},
                                              {Property::brazilian, TestKind::brazilian, "bts"}};
  for (const Procedure& p : list)
    if (p.property == property) return &p;
  return nullptr;
}

/// The tests of a table: what the laboratory did to its specimens, for one packing each. Compression runs at
/// the recipe's speed, every kind of test in tension at its own slow_speed.
class Tests {
 public:
  Tests(const Recipe& recipe, const std::vector<Target>& targets, std::int64_t seed, Simulator& simulator)
      : targets_(targets), strains_(peak_strains(recipe, targets, seed, simulator)) {
    for (const Target& t : targets_)
      speeds_.push_back(t.property == Property::ucs ? recipe.test.platen_speed
                                                    : slow_speed(recipe, targets_, strains_, t.property));
  }
  Recipe of(const Recipe& recipe, std::size_t target, std::int64_t seed) const {
    Recipe one = single_at(recipe, targets_[target].theta, seed);
    one.test.kind = procedure_of(targets_[target].property)->kind;
    one.test.platen_speed = speeds_[target];
    if (one.test.kind == TestKind::brazilian) {
      if (targets_[target].diameter > 0.0) one.test.disc_diameter = targets_[target].diameter;
      one.test.history_interval = disc_interval;
    }
    return one;
  }
  /// For the search: jump start and twice the speed halve the steps of a compression test and move UCS by
  /// +0.7 +- 0.4 % (docs/calibration.md, "Two speeds").
  Recipe quick(const Recipe& recipe, std::size_t target, std::int64_t seed) const {
    Recipe one = of(recipe, target, seed);
    one.test.platen_speed *= search_speed;
    if (one.test.kind == TestKind::uniaxial) one.test.jump_strain = jump_share * strains_[target];
    return one;
  }

 private:
  std::vector<Target> targets_;
  std::vector<double> strains_, speeds_;
};

/// Strength of a test [Pa]; NaN if it has none.
double strength_of(const TestResult& result, Property property) {
  if (result.outcome.status != Status::peaked) return std::nan("");
  const Number* n = find(result.numbers, procedure_of(property)->number);
  return n != nullptr ? n->value : std::nan("");
}

/// Did a Brazilian disc begin to break outside the central third?
bool is_invalid(const TestResult& result) {
  for (const char* place : {"first_crack_x", "first_crack_y"})
    if (const Number* n = find(result.numbers, place); n != nullptr && std::fabs(n->value) > central_third)
      return true;
  return false;
}

/// Neighbouring points share a packing: two points of seven angles fill sixteen lanes.
std::size_t packing_of_point(std::size_t point, std::size_t n_packings) { return point / 2 % n_packings; }

std::vector<Recipe> tests_at(const StrengthProblem& problem, const Tests& tests,
                             const std::vector<VectorXd>& points, bool is_coarse, const Recipe& recipe,
                             const std::vector<std::int64_t>& seeds, std::size_t first) {
  std::vector<Recipe> recipes;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Recipe point = problem.recipe_at(is_coarse ? coarse(recipe) : recipe, points[p]);
    for (std::size_t i = 0; i < problem.n_targets(); ++i)
      recipes.push_back(tests.quick(point, i, seeds[packing_of_point(first + p, seeds.size())]));
  }
  return recipes;
}

/// Runs a batch, whose points are number `first` and on of the search, and hands its answers to the
/// surrogates. False: stopped.
bool run_batch(StrengthProblem& problem, const Tests& tests, const std::vector<VectorXd>& points,
               bool is_coarse, const std::vector<std::int64_t>& seeds, std::size_t first,
               Simulator& simulator, StrengthFit& fit) {
  const std::vector<Recipe> recipes = tests_at(problem, tests, points, is_coarse, fit.recipe, seeds, first);
  const std::vector<TestResult> results = simulator.test(recipes);
  if (simulator.stopped()) return false;
  std::size_t failed = 0;
  for (std::size_t k = 0; k < results.size(); ++k) {
    const VectorXd& x = points[k / problem.n_targets()];
    const double strength = strength_of(results[k], problem.targets()[k % problem.n_targets()].property);
    if (std::isfinite(strength))
      problem.add_run(k % problem.n_targets(),
                      {x.tail(problem.n_ratios()),
                       static_cast<int>(packing_of_point(first + k / problem.n_targets(), seeds.size())),
                       is_coarse, std::log(strength) - x[0]});
    else
      ++failed;
  }
  fit.n_tests += static_cast<std::int64_t>(results.size());
  fit.n_tension += static_cast<std::int64_t>(points.size() * problem.n_tension());
  if (is_coarse) fit.n_coarse += static_cast<std::int64_t>(results.size());
  if (failed > 0)
    fit.notes.push_back(
        fmt::format("{} of {} tests of a batch gave no peak and were left out", failed, results.size()));
  return true;
}

/// 2.5 % and 97.5 % of a set of numbers.
std::pair<double, double> interval_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double p) {
    return values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1))];
  };
  return {at(0.025), at(0.975)};
}

ParameterEstimate estimate(std::string key, std::string symbol, std::string unit, double value,
                           const std::vector<double>& logs, double low, double high) {
  const auto [from, to] = interval_of(logs);
  ParameterEstimate e;
  e.key = std::move(key), e.symbol = std::move(symbol), e.unit = std::move(unit);
  e.value = value, e.box_low = std::exp(low), e.box_high = std::exp(high);
  e.low = std::min(value, std::exp(from)), e.high = std::max(value, std::exp(to));
  e.determined = to - from < 0.5 * (high - low);
  return e;
}

void report_parameters(const StrengthProblem& problem, const std::vector<VectorXd>& draws,
                       const VectorXd& best, StrengthFit& fit) {
  const auto n = static_cast<std::size_t>(problem.n_ratios()) + 1;
  std::vector<std::vector<double>> logs(n);
  for (const VectorXd& x : draws)
    for (std::size_t i = 0; i < n; ++i) logs[i].push_back(problem.log_value(x, i));
  for (std::size_t i = 0; i < n; ++i) {
    const Parameter& p = problem.parameter(i);
    fit.parameters.push_back(estimate(p.key, p.symbol, p.unit, std::exp(problem.log_value(best, i)), logs[i],
                                      problem.box_low(i), problem.box_high(i)));
  }
  // tau_c = sigma_c r, C = tau_c c, sigma_n = C s: sums of logarithms along the chain of ratios. The sum of
  // their boxes spans a factor of 10^4; what is known of a strength is judged by the box of sigma_c.
  const double box = problem.box_high(0) - problem.box_low(0);
  const auto add = [&](const char* key, const char* symbol, const std::vector<std::size_t>& chain,
                       double value) {
    std::vector<double> sum(draws.size(), 0.0);
    double low = 0.0, high = 0.0;
    for (const std::size_t i : chain) {
      for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += logs[i][k];
      low += problem.box_low(i), high += problem.box_high(i);
    }
    ParameterEstimate e = estimate(key, symbol, "Pa", value, sum, low, high);
    e.determined = std::log(e.high / e.low) < 0.5 * box;
    fit.parameters.push_back(e);
  };
  add("matrix.tau_c", "tau_c", {0, 1}, fit.recipe.matrix.tau_c);
  if (fit.recipe.bedding.empty()) return;
  add("bedding[0].cohesion", "C_sj", {0, 1, 3}, fit.recipe.bedding[0].cohesion);
  add("bedding[0].sigma_n", "sigma_n,sj", {0, 1, 3, 4}, fit.recipe.bedding[0].sigma_n);
}

/// A target's row: `centre` and the 95 % interval of the rock's own strength over all draws. Given a draw,
/// the strength is known from two sides: surrogate and, unless it was left out, laboratory.
Comparison predicted(const StrengthProblem& problem, const std::vector<VectorXd>& draws, double centre,
                     std::size_t i, bool left_out) {
  const Target& t = problem.targets()[i];
  std::vector<double> logs;
  for (std::size_t k = 0; k < draws.size(); ++k) {
    Surrogate::Value v = problem.predict(draws[k], i);
    v.variance += problem.discrepancy();
    if (!left_out) {
      const double lab = StrengthProblem::variance(t), sum = lab + v.variance;
      v = {(v.mean * lab + std::log(t.mean) * v.variance) / sum, v.variance * lab / sum};
    }
    const double noise = normal(sampler_seed, Stream::calibration, static_cast<std::uint32_t>(k),
                                static_cast<std::uint32_t>(i), 1000U);
    logs.push_back(v.mean + std::sqrt(v.variance) * noise);
  }
  const auto [low, high] = interval_of(logs);
  Comparison c;
  c.target = t;
  c.mean = std::exp(centre), c.low = std::exp(low), c.high = std::exp(high);
  return c;
}

void report(const StrengthProblem& problem, const std::vector<VectorXd>& draws, std::size_t n_packings,
            StrengthFit& fit) {
  const VectorXd& best = draws[middle(problem, draws)];
  fit.recipe = problem.recipe_at(fit.recipe, best);
  report_parameters(problem, draws, best, fit);
  for (std::size_t i = 0; i < problem.n_targets(); ++i) {
    Comparison c = predicted(problem, draws, problem.predict(best, i).mean, i, false);
    c.n_packings = static_cast<int>(n_packings);
    fit.fitted.push_back(c);
  }
  if (problem.n_targets() < 4) return;
  for (std::size_t i = 0; i < problem.n_targets(); ++i) {
    const std::vector<VectorXd> others =
        problem.draws(i, sampler_seed + 100U + static_cast<std::uint32_t>(i));
    double mean = 0.0;
    for (const VectorXd& x : others) mean += problem.predict(x, i).mean / static_cast<double>(others.size());
    fit.left_out.push_back(predicted(problem, others, mean, i, true));
  }
}

/// All tests to come, the verification included, at the middle of the box.
void announce(const StrengthProblem& problem, const Tests& tests, const std::vector<Batch>& batches,
              const Recipe& recipe, const std::vector<std::int64_t>& seeds, Simulator& simulator) {
  std::vector<Recipe> all;
  VectorXd middle = VectorXd::Zero(problem.n_ratios() + 1);
  middle[0] = problem.first_sigma();
  for (const Batch& b : batches) {
    const std::vector<VectorXd> points(b.n_points, middle);
    const std::vector<Recipe> some = tests_at(problem, tests, points, b.coarse, recipe, seeds, 0);
    all.insert(all.end(), some.begin(), some.end());
  }
  for (std::size_t i = 0; i < problem.n_targets(); ++i)
    for (int k = 0; k < verification_packings; ++k)
      all.push_back(tests.of(problem.recipe_at(recipe, middle), i, seeds.front()));
  simulator.announce(all);
}

}  // namespace

bool can_test(Property property) { return procedure_of(property) != nullptr; }

Recipe test_settings(Recipe recipe, const std::vector<Target>& all, std::int64_t seed, Simulator& simulator) {
  const std::vector<Target> targets = of_property(all, Property::ucs);
  const std::vector<double> strains = peak_strains(recipe, targets, seed, simulator);
  const double speed = slow_speed(recipe, targets, strains, Property::ucs);
  const double largest = strains.empty() ? 0.0 : *std::max_element(strains.begin(), strains.end());
  TestRecipe& test = recipe.test;
  if (std::isfinite(speed)) test.platen_speed = speed, test.max_strain = std::max(0.01, 6.0 * largest);
  test.stop_at = 0.8, test.post_peak = 1.0;
  test.n_snapshots = 0, test.n_frames = 0;
  test.angles.clear(), test.intact = false;
  recipe.engine.precision = Precision::single_precision;
  return recipe;
}

std::vector<Comparison> strength_response(const Recipe& recipe, const std::vector<Target>& targets,
                                          const std::vector<std::int64_t>& seeds, Simulator& simulator) {
  const Tests tests(recipe, targets, seeds.front(), simulator);
  std::vector<Recipe> recipes;
  for (std::size_t i = 0; i < targets.size(); ++i)
    for (const std::int64_t seed : seeds) recipes.push_back(tests.of(recipe, i, seed));
  const std::vector<TestResult> results = simulator.test(recipes);
  std::vector<Comparison> rows;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    std::vector<double> values;
    Comparison c;
    for (std::size_t p = 0; p < seeds.size(); ++p) {
      const TestResult& result = results[i * seeds.size() + p];
      const double s = strength_of(result, targets[i].property);
      if (!std::isfinite(s)) continue;
      values.push_back(s);
      c.n_invalid += is_invalid(result) ? 1 : 0;
    }
    const Summary s = summarise(values);
    c.target = targets[i], c.mean = s.mean, c.sd = s.sd, c.n_packings = static_cast<int>(values.size());
    rows.push_back(c);
  }
  return rows;
}

StrengthFit fit_strength(const Rock& rock, const Recipe& recipe, const std::vector<Target>& all,
                         const std::vector<std::int64_t>& seeds, std::int64_t max_tests, Simulator& simulator,
                         const std::function<void(const std::string&)>& say) {
  StrengthFit fit;
  std::vector<Target> targets;
  for (const Target& t : all)
    if (can_test(t.property)) targets.push_back(t);
  fit.recipe = test_settings(recipe, targets, seeds.front(), simulator);
  StrengthProblem problem(rock, recipe, targets);
  const Tests tests(fit.recipe, targets, seeds.front(), simulator);
  const std::size_t n_ucs = targets.size() - problem.n_tension();
  const std::vector<Batch> batches = plan(max_tests, n_ucs, has_coarse(fit.recipe));
  fit.short_search = max_tests < most_points * static_cast<std::int64_t>(n_ucs);
  announce(problem, tests, batches, fit.recipe, seeds, simulator);
  std::vector<VectorXd> draws;
  const auto draw = [&](std::size_t n_batches) {
    problem.learn();
    const std::uint32_t seed = sampler_seed + static_cast<std::uint32_t>(n_batches);
    draws = problem.draws(none, seed);
    if (problem.find_discrepancy(draws)) draws = problem.draws(none, seed);
  };
  draw(0);  // from experience alone
  std::size_t n_points = 0;
  for (std::size_t b = 0; b < batches.size(); ++b) {
    const Batch& batch = batches[b];
    const std::vector<VectorXd> points = spread_draws(problem, draws, batch.n_points);
    say(fmt::format("strength, batch {} of {}: {} points x {} tests{}", b + 1, batches.size(), batch.n_points,
                    targets.size(), batch.coarse ? " on coarse grains" : ""));
    if (!run_batch(problem, tests, points, batch.coarse, seeds, n_points, simulator, fit) ||
        !problem.has_runs()) {
      fit.interrupted = simulator.stopped();
      if (!fit.interrupted)
        fit.findings.emplace_back("no test of some angle gave a peak: strengths were not fitted");
      return fit;
    }
    n_points += points.size();
    draw(b + 1);
  }
  report(problem, draws, seeds.size(), fit);
  return fit;
}

}  // namespace phy
