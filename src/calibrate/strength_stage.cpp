#include "calibrate/strength_stage.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "base/rng.hpp"
#include "base/stats.hpp"
#include "calibrate/best_estimate.hpp"
#include "calibrate/discrepancy.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/posterior_ensemble.hpp"
#include "calibrate/search_plan.hpp"
#include "calibrate/strength_posterior.hpp"
#include "calibrate/strength_tests.hpp"
#include "verdict/cells.hpp"

namespace phy::calibrate {
namespace {

using verdict::tolerance;

constexpr std::uint32_t sampler_seed = 20100101;
// Of the chains behind the intervals, in those of the search: as long as their draws are worth too little.
constexpr int final_length = 4, longest_final = 16;
constexpr double least_effective = 200.0, most_r_hat = 1.05;  // of draws that pass
constexpr std::size_t fewest_to_leave_out = 4;                // targets

// More rounds, as many as the effort allows, while tests at the estimate are off what was predicted for it by
// more than chance makes them (packings that differ by 5 % make the mean of four differ by 0.4 tolerances of
// UCS), or while the estimate moves on to where less is known than where it was tried, or to where too little
// is known: the nearest of several valleys may change with every round, and one that was hardly tried is no
// answer. They end with the first that comes no nearer to the table.
constexpr double most_surprise = 0.6;   // tolerances
constexpr double most_growth = 1.2;     // of the uncertainty
constexpr double most_uncertain = 0.4;  // tolerances
/// Points of a batch and the packing of each, by its place among the seeds.
struct Design {
  Grains grains;
  std::vector<Point> points;
  std::vector<std::size_t> packings;
};

/// How far tests are off what was predicted for their points: mean per target, in tolerances, root mean
/// square over the targets.
class Surprise {
 public:
  explicit Surprise(std::size_t n_targets) : sums_(n_targets), counts_(n_targets) {}
  /// `ratio`: of a test's answer to what was predicted for the mean.
  void add(std::size_t target, double ratio, Property property) {
    sums_[target] += (ratio - 1.0) / tolerance(property), ++counts_[target];
  }
  double rms() const {
    double squares = 0.0;
    for (std::size_t i = 0; i < sums_.size(); ++i)  // of a target without an answer nothing was right
      squares += counts_[i] > 0 ? std::pow(sums_[i] / counts_[i], 2) : 1.0;
    return std::sqrt(squares / static_cast<double>(sums_.size()));
  }

 private:
  std::vector<double> sums_;
  std::vector<int> counts_;
};

/// How badly the surrogates know the strengths of a point: standard errors in tolerances, root mean square.
double uncertainty_at(const StrengthPosterior& posterior, const Point& x) {
  double sum = 0.0;
  for (std::size_t i = 0; i < posterior.n_targets(); ++i)
    sum += posterior.predict(x, i).variance / std::pow(tolerance(posterior.targets()[i].property), 2);
  return std::sqrt(sum / static_cast<double>(posterior.n_targets()));
}

/// What is expected to be missed at a point, what is not known of it included: tolerances, root mean square.
double expected_miss(const StrengthPosterior& posterior, const Point& x) {
  double sum = 0.0;
  const std::vector<StrengthPosterior::Miss> misses = posterior.misses(x);
  for (std::size_t i = 0; i < posterior.n_targets(); ++i)
    sum +=
        (misses[i].error * misses[i].error + misses[i].variance) / std::pow(tolerance(misses[i].property), 2);
  return std::sqrt(sum / static_cast<double>(posterior.n_targets()));
}

/// Is the last of the points that rounds have tried nearer to the table than all before it, by more than what
/// is unknown of its strengths moves the root mean square? All by the same posterior, so that what a packing
/// does to one does not decide.
bool came_nearer(const StrengthPosterior& posterior, const std::vector<Point>& tried) {
  const double noise = uncertainty_at(posterior, tried.back()) /
                       std::sqrt(static_cast<double>(posterior.n_targets())),
               last = expected_miss(posterior, tried.back());
  return std::none_of(tried.begin(), tried.end() - 1,
                      [&](const Point& x) { return expected_miss(posterior, x) <= last + noise; });
}

/// Why the search should continue after a round at `tried`; nothing: the estimate has settled.
std::optional<Finding> unsettled(const StrengthPosterior& posterior, const Point& estimate,
                                 const Point& tried, double surprise) {
  const double unknown = uncertainty_at(posterior, estimate);
  if (surprise > most_surprise) return Finding{FindingKind::unsettled_tests, {}, {{"tolerances", surprise}}};
  if (unknown > most_uncertain) return Finding{FindingKind::unsettled_known, {}, {{"tolerances", unknown}}};
  if (unknown > most_growth * uncertainty_at(posterior, tried)) return Finding{FindingKind::unsettled_moved};
  return {};
}

/// 2.5 % and 97.5 % of a set of numbers.
std::pair<double, double> interval_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double p) {
    return values[static_cast<std::size_t>(p * static_cast<double>(values.size() - 1))];
  };
  return {at(0.025), at(0.975)};
}

/// `logs`: of the draws.
Estimate with_interval(Estimate e, double value, const std::vector<double>& logs, const LogBox& box) {
  const auto [from, to] = interval_of(logs);
  e.value = value, e.box_low = std::exp(box.low), e.box_high = std::exp(box.high);
  // The estimate comes from least squares and not from the draws: it may lie beyond 97.5 % of them.
  e.low = std::min(value, std::exp(from)), e.high = std::max(value, std::exp(to));
  e.determined = box.narrowed_to(to - from);
  return e;
}

std::vector<double> logs_of(const StrengthPosterior& posterior, const std::vector<Point>& draws,
                            const Parameter& p) {
  std::vector<double> logs;
  for (const Point& x : draws) logs.push_back(posterior.log_value(x, p));
  return logs;
}

/// A strength that is sought as a ratio, by the sums of logarithms along its chain: sigma_n = sigma_c r c s.
/// The sum of the boxes spans a factor of 10^4; what is known of a strength is judged by the box of sigma_c.
Estimate strength_behind(const Parameter& ratio, const StrengthPosterior& posterior,
                         const std::vector<Point>& draws, const Recipe& recipe) {
  std::vector<const Parameter*> chain;
  for (const Parameter* p = &ratio; p != nullptr; p = p->over) chain.insert(chain.begin(), p);
  std::vector<double> sum(draws.size(), 0.0);
  LogBox box;
  for (const Parameter* p : chain) {
    const std::vector<double> logs = logs_of(posterior, draws, *p);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += logs[k];
    box.low += posterior.box(*p).low, box.high += posterior.box(*p).high;
  }
  Estimate e = with_interval(number_of_recipe(ratio), ratio.number(recipe), sum, box);
  e.determined = posterior.box(*chain.front()).narrowed_to(std::log(e.high / e.low));
  return e;
}

/// What is sought, with its intervals.
std::vector<Estimate> estimates_of(const StrengthPosterior& posterior, const std::vector<Point>& draws,
                                   const Point& best) {
  std::vector<Estimate> all;
  for (const Parameter* p : posterior.parameters())
    all.push_back(with_interval(sought(*p), std::exp(posterior.log_value(best, *p)),
                                logs_of(posterior, draws, *p), posterior.box(*p)));
  return all;
}

/// The strengths of the table against the model at the estimate, and at draws.
std::vector<StrengthResidual> residuals_of(const StrengthPosterior& posterior, const Point& estimate,
                                           const std::vector<Point>& draws) {
  const std::vector<StrengthPosterior::Miss> misses = posterior.misses(estimate);
  std::vector<StrengthResidual> all;
  for (std::size_t i = 0; i < posterior.n_targets(); ++i)
    all.push_back({posterior.targets()[i], misses[i].error, misses[i].scatter, misses[i].variance});
  for (const Point& x : draws) {
    const std::vector<StrengthPosterior::Miss> of_draw = posterior.misses(x);
    for (std::size_t i = 0; i < all.size(); ++i) all[i].of_draws.push_back(of_draw[i].error);
  }
  return all;
}

/// What predictions rest on: residuals at the estimate and at the draws, and what the model misses.
struct Predictor {
  std::vector<StrengthResidual> residuals;
  Discrepancy discrepancy;

  Predictor(const StrengthPosterior& posterior, const std::vector<Point>& draws, const Point& estimate,
            std::size_t left_out = Discrepancy::none)
      : residuals(residuals_of(posterior, estimate, draws)), discrepancy(residuals, left_out) {}
  /// A target's row. The interval over all draws is the rock's own strength, which model and laboratory know
  /// together; of a target left out it is the laboratory's mean, which is yet to be seen.
  Comparison row(const Target& t, std::size_t i, bool left_out) const {
    const Discrepancy::Term term = discrepancy.of(i);
    const StrengthResidual& own = residuals[i];
    // Draws differ by what is unknown of the parameters. About each, the rock lies by what the model misses.
    const double sd = std::sqrt(term.variance + (left_out ? own.noise : 0.0));
    std::vector<double> logs;
    for (std::size_t k = 0; k < own.of_draws.size(); ++k)
      logs.push_back(std::log(t.mean) - own.of_draws[k] + discrepancy.of_draw(term, k) +
                     sd * normal(sampler_seed, Stream::calibration, static_cast<std::uint32_t>(k),
                                 // Apart from the numbers that move the walkers, which count from 0.
                                 static_cast<std::uint32_t>(i), 1000U));
    const auto [low, high] = interval_of(logs);
    const double model = std::log(t.mean) - own.value, centre = model + term.mean;
    Comparison c;
    c.target = t, c.mean = std::exp(model);
    c.with_discrepancy = std::exp(model + discrepancy.at(t).mean);
    c.low = std::exp(std::min(low, centre)), c.high = std::exp(std::max(high, centre));
    return c;
  }
  /// Of every kind of test, at every fifth degree, once.
  std::vector<AngleFactor> factors(const std::vector<Target>& targets) const {
    std::vector<AngleFactor> all;
    for (std::size_t i = 0; i < targets.size(); ++i) {
      const auto before = targets.begin() + static_cast<std::ptrdiff_t>(i);
      if (std::any_of(targets.begin(), before, [&](const Target& t) { return same_test(t, targets[i]); }))
        continue;
      const double steepest = measured(targets[i].property).along_bedding ? 0.0 : 90.0;
      for (double theta = 0.0; theta <= steepest; theta += 5.0) {
        Target test = targets[i];
        test.theta = theta;
        const Discrepancy::Term term = discrepancy.at(test);
        const double half = z_95 * std::sqrt(term.variance);
        all.push_back(
            {targets[i], theta, std::exp(term.mean), std::exp(term.mean - half), std::exp(term.mean + half)});
      }
    }
    return all;
  }
};

/// Those behind the intervals.
std::vector<Point> final_draws(StrengthPosterior& posterior, std::uint32_t seed) {
  std::vector<Point> draws = posterior.draws_with_discrepancy(seed, final_length);
  for (int length = 2 * final_length; length <= longest_final; length *= 2) {
    if (StrengthPosterior::mixing_of(draws).effective >= least_effective) break;
    draws = posterior.draws(StrengthPosterior::none, seed, length);
  }
  return draws;
}

class StrengthSearch {
 public:
  StrengthSearch(const SearchTask& task, StrengthFit& fit)
      : task_(task),
        targets_(task.evidence.strengths),
        fit_(fit),
        first_test_(task.simulator.count().compression()),
        settings_(test_settings(task.recipe, targets_, task.seeds.front(), task.simulator)),
        read_(task.evidence),
        posterior_(task.evidence, task.recipe, task.refit ? &read_ : nullptr),
        tests_(settings_, targets_, task.seeds.front(), task.simulator),
        course_(course_of(settings_, targets_)),
        plan_(plan_search(task.budget, posterior_.parameters().size() - 1,  // sigma_c costs no run
                          task.evidence.n_compressive(), course_)),
        dealer_(task.seeds.size()) {
    fit_.recipe = settings_, fit_.shortage = plan_.shortage;
    if (plan_.cut) fit_.notes.push_back(*plan_.cut);
  }

  void run() {
    const std::size_t n_planned = plan_.batches.size();
    // The first batch is not spread over the box, most of which the maps exclude already.
    learn(0);  // from the prior mean alone
    for (std::size_t b = 0; b < plan_.batches.size(); ++b) {
      const Point at = estimate_;
      // Against what was predicted before: the surrogates learn the batch only afterwards.
      const double surprise = run_batch(b);
      // Without one answer a target's surrogate is the map's expectation, and a fit to it would only look
      // like one.
      if (!posterior_.without_runs().empty()) return report_silent();
      if (task_.refit) refit_moduli();
      learn(b + 1);
      if (plan_.batches[b].at_estimate) tried_.push_back(at);
      if (b + 1 < plan_.batches.size()) continue;
      // The first tests on the recipe's own grains surprise by what coarse ones are off, whatever the
      // estimate.
      const bool none_follow = course_ != Course::own && plan_.most_batches == n_planned;
      const auto why = unsettled(posterior_, estimate_, at, none_follow ? 0.0 : surprise);
      fit_.shortage.settled = !why;
      if (why && !none_follow) go_on(*why);
    }
    report();
  }

  /// Says once how many tests of all batches came to nothing.
  void report_without_peak() {
    if (fit_.n_without_peak > 0)
      fit_.notes.push_back(
          {FindingKind::peaks_left_out,
           {},
           {{"tests", static_cast<double>(fit_.n_without_peak)}, {"of", static_cast<double>(n_tests_)}}});
  }

 private:
  const SearchTask& task_;
  const std::vector<Target>& targets_;
  StrengthFit& fit_;
  std::int64_t first_test_;  ///< in compression
  Recipe settings_;
  ReadModuli read_;
  StrengthPosterior posterior_;
  StrengthTests tests_;
  Course course_;
  SearchPlan plan_;
  PackingDealer dealer_;
  std::vector<Point> draws_;
  Point estimate_;
  std::vector<Point> tried_;  // by rounds
  std::int64_t n_tests_ = 0;

  void learn(std::size_t n_batches) {
    posterior_.learn();
    // Other numbers after every batch, and the same in every run.
    draws_ = posterior_.draws_with_discrepancy(sampler_seed + static_cast<std::uint32_t>(n_batches));
    estimate_ = best_estimate(posterior_, draws_);
    const std::vector<Estimate> known = estimates_of(posterior_, draws_, estimate_);
    task_.listener.estimates({known.begin(), known.end()});
  }

  const Loading& loading() const { return task_.refit ? search_with_moduli : search_of_strengths; }

  std::vector<Recipe> recipes_of(const Design& design) const {
    std::vector<Recipe> recipes;
    for (std::size_t p = 0; p < design.points.size(); ++p) {
      const Recipe point = posterior_.recipe_at(
          design.grains == Grains::coarse ? coarse(fit_.recipe) : fit_.recipe, design.points[p]);
      for (std::size_t i = 0; i < targets_.size(); ++i)
        recipes.push_back(tests_.of(point, i, task_.seeds[design.packings[p]], loading(),
                                    // A specimen that is weaker than the table would break within the fast
                                    // approach.
                                    std::exp(posterior_.predict(design.points[p], i).mean)));
    }
    return recipes;
  }

  /// Runs a batch and hands its answers to the surrogates; by how much they surprise.
  double run_batch(std::size_t b) {
    const Batch& batch = plan_.batches[b];
    const Design design = {batch.grains,
                           batch.at_estimate ? std::vector<Point>(batch.n_points, estimate_)
                                             : spread_draws(estimate_, draws_, batch.n_points),
                           dealer_.deal(batch)};
    task_.listener.begins({FindingKind::course_batch,
                           {},
                           {{"batch", static_cast<double>(b + 1)},
                            {"of", static_cast<double>(plan_.batches.size())},
                            {"points", static_cast<double>(batch.n_points)},
                            {"tests", static_cast<double>(targets_.size())},
                            {"at_estimate", batch.at_estimate ? 1.0 : 0.0},
                            {"coarse", batch.grains == Grains::coarse ? 1.0 : 0.0}}});
    const std::vector<Recipe> recipes = recipes_of(design);
    const std::vector<TestResult> results = task_.simulator.test(recipes, batch.grains);
    if (task_.refit) learn_softening(design, recipes, results);
    return learn_strengths(design, results);
  }

  /// Solutions of the specimens behind tests that moduli are read from, one of those that lie on the same
  /// packing at the same inclination: they differ in strengths alone.
  void learn_softening(const Design& design, const std::vector<Recipe>& recipes,
                       const std::vector<TestResult>& results) {
    std::map<std::pair<std::int64_t, double>, std::size_t> solved;
    std::vector<Recipe> specimens;
    const auto target_of = [&](std::size_t k) -> const Target& { return targets_[k % targets_.size()]; };
    const auto name_of = [&](std::size_t k) {
      return std::pair{recipes[k].packing.seed, target_of(k).theta};
    };
    for (std::size_t k = 0; k < recipes.size(); ++k)
      if (read_.reads(target_of(k)) && solved.emplace(name_of(k), specimens.size()).second)
        specimens.push_back(as_for_moduli(recipes[k], task_.recipe));
    const std::vector<ElasticResult> solutions = task_.simulator.elastic(specimens, Statics::one_sided);
    for (std::size_t k = 0; k < recipes.size(); ++k) {
      if (!read_.reads(target_of(k))) continue;
      const std::size_t p = k / targets_.size();
      // coarse grains soften alike, on packings of their own
      const std::size_t packing = design.packings[p] + (design.grains == Grains::coarse ? 1000 : 0);
      read_.add(target_of(k),
                {posterior_.inputs(design.points[p], k % targets_.size()), static_cast<int>(packing)},
                results[k], solutions[solved.at(name_of(k))]);
    }
    read_.learn();
  }

  double learn_strengths(const Design& design, const std::vector<TestResult>& results) {
    Surprise surprise(targets_.size());
    const bool on_coarse = design.grains == Grains::coarse;
    for (std::size_t k = 0; k < results.size(); ++k) {
      const std::size_t p = k / targets_.size(), i = k % targets_.size();
      const Property property = targets_[i].property;
      const Point& point = design.points[p];
      const bool own = !measured(property).read_in;  // a test of its own
      n_tests_ += own ? 1 : 0;
      const double strength = strength_of(results[k], property) / (on_coarse ? coarse_growth(property) : 1.0);
      if (!std::isfinite(strength)) {
        fit_.n_without_peak += own ? 1 : 0;
        continue;
      }
      surprise.add(i, strength / std::exp(posterior_.predict(point, i).mean), property);
      posterior_.add_run(i, {posterior_.inputs(point, i), static_cast<int>(design.packings[p]), on_coarse,
                             std::log(strength) - StrengthPosterior::log_sigma_c(point)});
    }
    return surprise.rms();
  }

  /// For where the new tests put the estimate among the previous draws.
  void refit_moduli() {
    posterior_.learn();
    estimate_ = best_estimate(posterior_, draws_);
    fit_.softenings = read_.at(posterior_.places(estimate_));
    const RefittedModuli anew = task_.refit(fit_.softenings);
    fit_.recipe = with_moduli(fit_.recipe, anew.recipe);
    read_.take_solution(anew.solution);
    posterior_.take_moduli(task_.evidence, fit_.recipe);
  }

  /// Another round, where rounds and budget allow it and the last one came nearer; else the reason is noted.
  void go_on(const Finding& why) {
    const std::int64_t spent = task_.simulator.count().compression() - first_test_,
                       round = task_.evidence.n_compressive() * static_cast<std::int64_t>(packings_per_round);
    if (plan_.batches.size() >= plan_.most_batches || spent + round > task_.budget.max_tests)
      fit_.notes.push_back(why);
    else if (came_nearer(posterior_, tried_))
      plan_.batches.push_back({Grains::own, true, packings_per_round});
    else {
      fit_.shortage.settled = true;
      fit_.notes.push_back(
          {FindingKind::rounds_no_nearer, {}, {{"rounds", static_cast<double>(tried_.size())}}});
    }
  }

  /// Targets that no test has answered.
  void report_silent() {
    for (const Target& t : posterior_.without_runs()) {
      Comparison silent;
      silent.target = t;
      fit_.fitted.push_back(silent);
      fit_.findings.push_back({FindingKind::search_unanswered, {cell_of(t)}});
    }
  }

  void report() {
    // From here on only intervals are asked for: the estimate stays the one that was tried.
    posterior_.use_full_errors();
    draws_ = final_draws(posterior_, sampler_seed + static_cast<std::uint32_t>(plan_.batches.size()));
    fit_.recipe = posterior_.recipe_at(fit_.recipe, estimate_);
    fit_.parameters = estimates_of(posterior_, draws_, estimate_);
    for (const Parameter* p : posterior_.parameters())
      if (p->over != nullptr) fit_.parameters.push_back(strength_behind(*p, posterior_, draws_, fit_.recipe));
    const std::vector<Point> ensemble = evenly_taken(draws_, ensemble_size);
    for (const Point& x : ensemble) fit_.draws.push_back(posterior_.recipe_at(fit_.recipe, x));
    fit_.residuals = residuals_of(posterior_, estimate_, ensemble);
    const Predictor predictor(posterior_, draws_, estimate_);
    fit_.discrepancy = predictor.factors(targets_);
    for (std::size_t i = 0; i < targets_.size(); ++i) {
      Comparison c = predictor.row(targets_[i], i, false);
      c.n_packings = static_cast<int>(dealer_.dealt());
      fit_.fitted.push_back(c);
    }
    if (targets_.size() >= fewest_to_leave_out) leave_out();
    report_mixing();
  }

  /// Each target by the estimate that the calibration would have ended with without it, and by what that
  /// misses of the others.
  void leave_out() {
    fit_.left_out.resize(targets_.size());
    for_all(targets_.size(), task_.simulator.threads(), [&] {
      return [&](std::size_t i) {
        const std::vector<Point> others =
            posterior_.draws(i, sampler_seed + 100U + static_cast<std::uint32_t>(i));
        // By least squares as the estimate itself: predicting by the mean of draws would test another method.
        const Point without = best_estimate(posterior_, others, i);
        fit_.left_out[i] = Predictor(posterior_, others, without, i).row(targets_[i], i, true);
      };
    });
  }

  /// How far the draws behind the intervals can be trusted; said where it is not far.
  void report_mixing() {
    fit_.mixing = StrengthPosterior::mixing_of(draws_);
    if (fit_.mixing.effective < least_effective || fit_.mixing.r_hat > most_r_hat)
      fit_.notes.push_back({FindingKind::draws_rough,
                            {},
                            {{"draws", static_cast<double>(draws_.size())},
                             {"effective", fit_.mixing.effective},
                             {"r_hat", fit_.mixing.r_hat}}});
  }
};

}  // namespace

void fit_strength(const SearchTask& task, StrengthFit& fit) {
  StrengthSearch search(task, fit);
  try {
    search.run();
  } catch (const Stopped&) {
    search.report_without_peak();
    throw;
  }
  search.report_without_peak();
}

}  // namespace phy::calibrate
