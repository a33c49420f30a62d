#include "calibrate/strength_stage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "base/lines.hpp"
#include "base/parallel.hpp"
#include "base/rng.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/margin.hpp"
#include "calibrate/nearest.hpp"
#include "calibrate/posterior_ensemble.hpp"
#include "calibrate/strength_posterior.hpp"

namespace phy::calibrate {
namespace {

/// What lies on which grains.
enum class Grains : std::uint8_t {
  own,               ///< the recipe's
  coarse_then_own,   ///< and a batch over the draws on the recipe's
  coarse_then_there  ///< and then the estimate: half of the rounds
};

/// What coarse grains leave to be learnt is by how much the recipe's own differ. For UCS alone that counts at
/// the estimate; strengths of other tests tell parameters that UCS leaves open (friction, slits), and how
/// they change beside the estimate is best asked of the recipe's own grains (docs/decisions/0006).
Grains grains_of(const Recipe& recipe, const std::vector<Target>& targets) {
  if (!has_coarse(recipe)) return Grains::own;
  const bool ucs_alone = std::all_of(targets.begin(), targets.end(),
                                     [](const Target& t) { return t.property == Property::ucs; });
  return ucs_alone ? Grains::coarse_then_there : Grains::coarse_then_own;
}

/// Points of a whole search: the more is sought, the more of them.
std::int64_t most_points(std::size_t n_ratios, const Effort& effort, Grains grains) {
  constexpr double usual = 36.0, per_ratio = 6.0, without_a_batch = 7.0 / 9.0;
  return std::llround(effort.points * std::max(usual, per_ratio * static_cast<double>(n_ratios)) *
                      (grains == Grains::coarse_then_there ? without_a_batch : 1.0));
}
/// What would have allowed all points of a usual search, `usual`; empty: it had them.
std::string lengthened_by(const Budget& budget, std::int64_t usual, std::int64_t n_compressive) {
  const bool too_quick = budget.effort.points < normal_effort.points,
             too_few = budget.max_tests < usual * n_compressive;
  std::vector<std::string> options;
  if (too_quick) options.push_back(fmt::format("--effort {}", normal_effort.name));
  if (too_few) options.emplace_back("a larger --max-tests");
  return fmt::format("{}", fmt::join(options, " and "));
}
/// Of a search that was to be longer than usual.
void report_cut(const Budget& budget, std::int64_t most, std::int64_t n_compressive, StrengthFit& fit) {
  const std::int64_t paid = budget.max_tests / n_compressive;
  if (budget.effort.points > normal_effort.points && paid < most && fit.longer_by.empty())
    fit.notes.push_back(fmt::format("of the {} points of a {} search --max-tests paid for {}", most,
                                    budget.effort.name, paid));
}
constexpr std::uint32_t sampler_seed = 20100101;
// Of the chains behind the intervals, in those of the search: as long as their draws are worth too little.
constexpr int final_length = 4, longest_final = 16;
constexpr double least_effective = 200.0, most_r_hat = 1.05;  // of draws that pass without a word

struct Batch {
  bool coarse;
  bool at_estimate;  ///< all at one point, on as many packings; else spread over the draws
  std::size_t n_points;
};
constexpr std::size_t per_round = 4;  // packings on which an estimate is tried
// More rounds, as many as the effort allows, while tests at the estimate are off what was predicted for it by
// more than chance makes them (packings that differ by 5 % make the mean of four differ by 0.4 tolerances of
// UCS), or while the estimate moves on to where less is known than where it was tried, or to where too little
// is known: the nearest of several valleys may change with every round, and one that was hardly tried is no
// answer. Of specimens so large that coarse grains are taken a third as many where the plan was short, else
// none: a round of them costs more than all tests on coarse grains.
constexpr double most_surprise = 0.6;   // tolerances
constexpr double most_growth = 1.2;     // of the uncertainty
constexpr double most_uncertain = 0.4;  // tolerances
/// A third of the points and two ninths over the draws, on coarse grains where there are any, and the rest in
/// rounds at the estimate, which each of them moves; of 36: 12, 8 and 16. With a batch on the recipe's own
/// grains 12, 8, 8 and 8; from coarse grains to the estimate at once, of 28: 12, 8 and 8. Every point costs
/// `n_compressive` of the tests.
std::vector<Batch> plan(std::int64_t max_tests, std::int64_t n_compressive, std::int64_t most,
                        Grains grains) {
  const std::int64_t points = std::clamp(max_tests / n_compressive, least_points, most);
  const bool coarse = grains != Grains::own;
  const std::int64_t n_alike = grains == Grains::coarse_then_there ? 2 : 3,  // parts behind the first
      last = std::max<std::int64_t>(1, points * 2 / (2 * n_alike + 3));
  const auto n_last = static_cast<std::size_t>(last),
             n_first = static_cast<std::size_t>(points - n_alike * last);
  std::vector<Batch> batches = {{coarse, false, n_first}, {coarse, false, n_last}};
  if (grains == Grains::coarse_then_own) batches.push_back({false, false, n_last});
  for (std::size_t left = coarse ? n_last : 2 * n_last; left > 0;) {
    const std::size_t n = left < 2 * per_round ? left : per_round;
    batches.push_back({false, true, n}), left -= n;
  }
  return batches;
}

std::size_t further_rounds(const Effort& effort, Grains grains) {
  if (grains == Grains::own) return effort.further;
  return grains == Grains::coarse_then_there ? effort.further / 3 : 0;
}

/// Deals the packings out. Neighbouring points of a spread batch share one: two points of seven angles fill
/// sixteen lanes. At one point every test has a packing of its own.
class Packings {
 public:
  explicit Packings(std::size_t n) : n_(n) {}
  std::vector<std::size_t> of(const Batch& batch) {
    constexpr std::size_t points_per_packing = 2;
    std::vector<std::size_t> dealt;
    for (std::size_t p = 0; p < batch.n_points; ++p) {
      if (p > 0 && (batch.at_estimate || p % points_per_packing == 0)) ++next_;
      dealt.push_back(next_ % n_);
    }
    ++next_;
    return dealt;
  }
  /// Of how many the answers are.
  std::size_t behind() const { return std::min(n_, next_); }

 private:
  std::size_t n_, next_ = 0;
};

/// Points of a batch and the packing of each, by its place among the seeds.
struct Design {
  bool coarse;
  std::vector<Point> points;
  std::vector<std::size_t> packings;
};

const Loading& loading_of(bool learns_moduli) {
  return learns_moduli ? search_with_moduli : search_of_strengths;
}

std::vector<Recipe> tests_at(const StrengthPosterior& posterior, const StrengthTests& tests,
                             const Design& design, const Recipe& recipe,
                             const std::vector<std::int64_t>& seeds, const Loading& loading) {
  std::vector<Recipe> recipes;
  for (std::size_t p = 0; p < design.points.size(); ++p) {
    const Recipe point = posterior.recipe_at(design.coarse ? coarse(recipe) : recipe, design.points[p]);
    for (std::size_t i = 0; i < posterior.n_targets(); ++i)
      recipes.push_back(tests.of(point, i, seeds[design.packings[p]], loading,
                                 std::exp(posterior.predict(design.points[p], i).mean)));
  }
  return recipes;
}

/// Solutions of the specimens behind tests that moduli are read from, one of those that lie on the same
/// packing at the same inclination: they differ in strengths alone. `model`: of the elastic stage.
void learn_softening(ReadModuli& read, const StrengthPosterior& posterior, const Design& design,
                     const Recipe& model, const std::vector<Recipe>& recipes,
                     const std::vector<TestResult>& results, Simulator& simulator,
                     std::int64_t& n_solutions) {
  std::map<std::pair<std::int64_t, double>, std::size_t> solved;
  std::vector<Recipe> specimens;
  const auto target_of = [&](std::size_t k) -> const Target& {
    return posterior.targets()[k % posterior.n_targets()];
  };
  const auto name_of = [&](std::size_t k) { return std::pair{recipes[k].packing.seed, target_of(k).theta}; };
  for (std::size_t k = 0; k < recipes.size(); ++k)
    if (read.reads(target_of(k)) && solved.emplace(name_of(k), specimens.size()).second)
      specimens.push_back(as_for_moduli(recipes[k], model));
  const std::vector<ElasticResult> solutions = simulator.elastic(specimens, Statics::one_sided);
  n_solutions += static_cast<std::int64_t>(specimens.size());
  for (std::size_t k = 0; k < recipes.size(); ++k) {
    if (!read.reads(target_of(k))) continue;
    const std::size_t p = k / posterior.n_targets();
    // coarse grains soften alike, on packings of their own
    const std::size_t packing = design.packings[p] + (design.coarse ? 1000 : 0);
    read.add(target_of(k),
             {posterior.inputs(design.points[p], k % posterior.n_targets()), static_cast<int>(packing)},
             results[k], solutions[solved.at(name_of(k))]);
  }
  read.learn();
}

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

/// Runs a batch and hands its answers to the surrogates; tells by how much they surprise. Nothing: stopped.
std::optional<double> run_batch(StrengthPosterior& posterior, const StrengthTests& tests,
                                const Design& design, const std::vector<std::int64_t>& seeds,
                                const Recipe& model, Simulator& simulator, StrengthFit& fit,
                                ReadModuli* read) {
  const std::vector<Point>& points = design.points;
  const std::vector<Recipe> recipes =
      tests_at(posterior, tests, design, fit.recipe, seeds, loading_of(read != nullptr));
  const std::vector<TestResult> results = simulator.test(recipes);
  if (simulator.stopped()) return {};
  Surprise surprise(posterior.n_targets());
  if (read != nullptr)
    learn_softening(*read, posterior, design, model, recipes, results, simulator, fit.n_solutions);
  for (std::size_t k = 0; k < results.size(); ++k) {
    const std::size_t p = k / posterior.n_targets(), i = k % posterior.n_targets();
    const Property property = posterior.targets()[i].property;
    const double strength =
        strength_of(results[k], property) / (design.coarse ? coarse_growth(property) : 1.0);
    const bool own = !is_read_before_ucs(property);  // a test of its own
    if (std::isfinite(strength)) {
      surprise.add(i, strength / std::exp(posterior.predict(points[p], i).mean), property);
      posterior.add_run(i, {posterior.inputs(points[p], i), static_cast<int>(design.packings[p]),
                            design.coarse, std::log(strength) - StrengthPosterior::log_sigma_c(points[p])});
    } else if (own) {
      ++fit.n_without_peak;
    }
    if (!own) continue;
    ++fit.n_tests;
    fit.n_tension += is_compressive(property) ? 0 : 1;
    fit.n_coarse += design.coarse ? 1 : 0;
  }
  return surprise.rms();
}

/// What speaks for another round after one at `tried`; empty: nothing.
std::string unsettled(const StrengthPosterior& posterior, const Point& estimate, const Point& tried,
                      double surprise) {
  const double unknown = uncertainty_at(posterior, estimate);
  if (surprise > most_surprise)
    return fmt::format("tests there were {:.1f} tolerances off what was predicted", surprise);
  if (unknown > most_uncertain)
    return fmt::format("its strengths are known to {:.1f} tolerances, no better", unknown);
  if (unknown > most_growth * uncertainty_at(posterior, tried))
    return "it moved on to where less is known than where it was tried";
  return "";
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
  e.low = std::min(value, std::exp(from)), e.high = std::max(value, std::exp(to));
  e.determined = to - from < 0.5 * (box.high - box.low);
  return e;
}

std::vector<double> logs_of(const StrengthPosterior& posterior, const std::vector<Point>& draws,
                            const CalibratedParameter& p) {
  std::vector<double> logs;
  for (const Point& x : draws) logs.push_back(posterior.log_value(x, p));
  return logs;
}

/// A strength that is sought as a ratio, by the sums of logarithms along its chain: sigma_n = sigma_c r c s.
/// The sum of the boxes spans a factor of 10^4; what is known of a strength is judged by the box of sigma_c.
Estimate strength_behind(const CalibratedParameter& ratio, const StrengthPosterior& posterior,
                         const std::vector<Point>& draws, const Recipe& recipe) {
  std::vector<const CalibratedParameter*> chain;
  for (const CalibratedParameter* p = &ratio; p != nullptr; p = p->over) chain.insert(chain.begin(), p);
  std::vector<double> sum(draws.size(), 0.0);
  LogBox box;
  for (const CalibratedParameter* p : chain) {
    const std::vector<double> logs = logs_of(posterior, draws, *p);
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += logs[k];
    box.low += posterior.box(*p).low, box.high += posterior.box(*p).high;
  }
  Estimate e = with_interval(number_of_recipe(ratio), ratio.number(recipe), sum, box);
  const LogBox& known = posterior.box(*chain.front());
  e.determined = std::log(e.high / e.low) < 0.5 * (known.high - known.low);
  return e;
}

/// What is sought, with its intervals.
std::vector<Estimate> estimates_of(const StrengthPosterior& posterior, const std::vector<Point>& draws,
                                   const Point& best) {
  std::vector<Estimate> all;
  for (const StrengthParameter* p : posterior.parameters())
    all.push_back(with_interval(sought(*p), std::exp(posterior.log_value(best, *p)),
                                logs_of(posterior, draws, *p), posterior.box(*p)));
  return all;
}

void report_parameters(const StrengthPosterior& posterior, const std::vector<Point>& draws, const Point& best,
                       StrengthFit& fit) {
  fit.parameters = estimates_of(posterior, draws, best);
  for (const StrengthParameter* p : posterior.parameters())
    if (p->over != nullptr) fit.parameters.push_back(strength_behind(*p, posterior, draws, fit.recipe));
}

/// A target's row: `centre` and the 95 % interval of the rock's own strength over all draws. Given a draw,
/// the strength is known from two sides: surrogate and, unless it was left out, laboratory.
Comparison predicted(const StrengthPosterior& posterior, const std::vector<Point>& draws, double centre,
                     std::size_t i, bool left_out) {
  const Target& t = posterior.targets()[i];
  std::vector<double> logs;
  for (std::size_t k = 0; k < draws.size(); ++k) {
    Surrogate::Value v = posterior.predict(draws[k], i);
    v.variance += posterior.discrepancy(i);
    if (!left_out) {
      const double lab = StrengthPosterior::variance(t), sum = lab + v.variance;
      v = {(v.mean * lab + std::log(t.mean) * v.variance) / sum, v.variance * lab / sum};
    }
    const double noise = normal(sampler_seed, Stream::calibration, static_cast<std::uint32_t>(k),
                                static_cast<std::uint32_t>(i), 1000U);
    logs.push_back(v.mean + std::sqrt(v.variance) * noise);
  }
  const auto [low, high] = interval_of(logs);
  Comparison c;
  c.target = t;
  c.mean = std::exp(centre), c.low = std::exp(std::min(low, centre)),
  c.high = std::exp(std::max(high, centre));
  return c;
}

/// `best`: the estimate.
void report(const StrengthPosterior& posterior, const std::vector<Point>& draws, const Point& best,
            std::size_t n_packings, int threads, StrengthFit& fit) {
  fit.recipe = posterior.recipe_at(fit.recipe, best);
  report_parameters(posterior, draws, best, fit);
  for (const Point& x : evenly_taken(draws, ensemble_size))
    fit.draws.push_back(posterior.recipe_at(fit.recipe, x));
  for (std::size_t i = 0; i < posterior.n_targets(); ++i) {
    Comparison c = predicted(posterior, draws, posterior.predict(best, i).mean, i, false);
    c.n_packings = static_cast<int>(n_packings);
    fit.fitted.push_back(c);
  }
  if (posterior.n_targets() < 4) return;
  fit.left_out.resize(posterior.n_targets());
  for_all(posterior.n_targets(), threads, [&] {
    return [&](std::size_t i) {
      const std::vector<Point> others =
          posterior.draws(i, sampler_seed + 100U + static_cast<std::uint32_t>(i));
      // the estimate that the calibration would have ended with
      const Point without = nearest_point(posterior, others, i);
      fit.left_out[i] = predicted(posterior, others, posterior.predict(without, i).mean, i, true);
    };
  });
}

/// Those behind the intervals.
std::vector<Point> final_draws(StrengthPosterior& posterior, std::uint32_t seed) {
  std::vector<Point> draws = posterior.settled_draws(seed, final_length);
  for (int length = 2 * final_length; length <= longest_final; length *= 2) {
    if (StrengthPosterior::mixing_of(draws).effective >= least_effective) break;
    draws = posterior.draws(StrengthPosterior::none, seed, length);
  }
  return draws;
}

/// How far the draws behind the intervals can be trusted; said where it is not far.
void report_mixing(const std::vector<Point>& draws, StrengthFit& fit) {
  fit.mixing = StrengthPosterior::mixing_of(draws);
  if (fit.mixing.effective < least_effective || fit.mixing.r_hat > most_r_hat)
    fit.notes.push_back(
        fmt::format("the {} draws behind the intervals of the strengths are worth {:.0f} independent ones "
                    "(R-hat {:.2f}): "
                    "their ends are rough",
                    draws.size(), fit.mixing.effective, fit.mixing.r_hat));
}

/// Targets that no test has answered.
void report_silent(const StrengthPosterior& posterior, StrengthFit& fit) {
  for (const Target& t : posterior.without_runs()) {
    Comparison silent;
    silent.target = t;
    fit.fitted.push_back(silent);
    add_line(fit.findings, cell_name(t), "no test gave a usable peak: strengths were not fitted");
  }
}

/// Says once how many tests of all batches came to nothing.
void report_without_peak(StrengthFit& fit) {
  if (fit.n_without_peak > 0)
    fit.notes.push_back(fmt::format("{} of {} tests of the search gave no usable peak and were left out",
                                    fit.n_without_peak, fit.n_tests));
}

/// All tests to come, the verification included, at the middle of the box.
void announce(const StrengthPosterior& posterior, const StrengthTests& tests,
              const std::vector<Batch>& batches, const Recipe& recipe, const std::vector<std::int64_t>& seeds,
              bool learns_moduli, Simulator& simulator) {
  std::vector<Recipe> all;
  const Point middle = posterior.middle_of_box();
  Packings packings(seeds.size());
  for (const Batch& b : batches) {
    const Design design = {b.coarse, std::vector<Point>(b.n_points, middle), packings.of(b)};
    const std::vector<Recipe> some =
        tests_at(posterior, tests, design, recipe, seeds, loading_of(learns_moduli));
    all.insert(all.end(), some.begin(), some.end());
  }
  const Loadings verification = of_verification(learns_moduli, {});
  for (std::size_t i = 0; i < posterior.n_targets(); ++i)
    for (int k = 0; k < verification_packings; ++k)
      all.push_back(tests.of(posterior.recipe_at(recipe, middle), i, seeds.front(),
                             k == 0 ? verification.first : verification.others));
  simulator.announce(all);
}

}  // namespace

Recipe with_moduli(Recipe recipe, const Recipe& moduli) {
  for (const ElasticParameter* p : elastic_parameters(recipe)) p->set(recipe, p->get(moduli));
  return recipe;
}

StrengthFit fit_strength(const Evidence& evidence, const Recipe& recipe,
                         const std::vector<std::int64_t>& seeds, const Budget& budget, Simulator& simulator,
                         const Listener& listener, const Remodel& remodel) {
  StrengthFit fit;
  const std::vector<Target>& targets = evidence.strengths;
  fit.recipe = test_settings(recipe, targets, seeds.front(), simulator);
  ReadModuli read(evidence);
  StrengthPosterior posterior(evidence, recipe, remodel ? &read : nullptr);
  const StrengthTests tests(fit.recipe, targets, seeds.front(), simulator);
  const std::int64_t n_compressive = evidence.n_compressive();
  const std::size_t n_ratios = posterior.parameters().size() - 1;  // sigma_c costs no run
  const Grains grains = grains_of(fit.recipe, targets);
  const std::int64_t most = most_points(n_ratios, budget.effort, grains);
  std::vector<Batch> batches = plan(budget.max_tests, n_compressive, most, grains);
  const std::size_t n_planned = batches.size(), n_further = further_rounds(budget.effort, grains);
  fit.longer_by = lengthened_by(budget, most_points(n_ratios, normal_effort, grains), n_compressive);
  report_cut(budget, most, n_compressive, fit);
  std::vector<Point> draws;
  Point estimate;
  const auto learn = [&](std::size_t n_batches) {
    posterior.learn();
    draws = posterior.settled_draws(sampler_seed + static_cast<std::uint32_t>(n_batches));
    estimate = nearest_point(posterior, draws);
    const std::vector<Estimate> known = estimates_of(posterior, draws, estimate);
    listener.estimates({known.begin(), known.end()});
  };
  learn(0);  // from the prior mean alone
  announce(posterior, tests, batches, fit.recipe, seeds, remodel != nullptr, simulator);
  Packings packings(seeds.size());
  for (std::size_t b = 0; b < batches.size(); ++b) {
    const Batch batch = batches[b];
    const Point tried = estimate;
    const Design design = {batch.coarse,
                           batch.at_estimate ? std::vector<Point>(batch.n_points, tried)
                                             : spread_draws(tried, draws, batch.n_points),
                           packings.of(batch)};
    listener.say(fmt::format("strength, batch {} of {}: {} {} x {} tests{}", b + 1, batches.size(),
                             batch.n_points, batch.at_estimate ? "packings at the estimate" : "points",
                             targets.size(), batch.coarse ? " on coarse grains" : ""));
    const auto surprise =
        run_batch(posterior, tests, design, seeds, recipe, simulator, fit, remodel ? &read : nullptr);
    if (!surprise || !posterior.without_runs().empty()) {
      fit.interrupted = !surprise;
      if (surprise) report_silent(posterior, fit);
      report_without_peak(fit);
      return fit;
    }
    if (remodel) {  // for where the new tests put the estimate among the draws of before
      posterior.learn();
      estimate = nearest_point(posterior, draws);
      fit.softenings = read.at(posterior.places(estimate));
      const Remodelled anew = remodel(fit.softenings);
      fit.recipe = with_moduli(fit.recipe, anew.recipe);
      read.take_solution(anew.solution);
      posterior.take_moduli(evidence, fit.recipe);
    }
    learn(b + 1);
    // The first tests on the recipe's own grains surprise by what coarse ones are off, whatever the estimate.
    if (b + 1 < batches.size() || (grains != Grains::own && n_further == 0)) continue;
    const std::string why = unsettled(posterior, estimate, tried, *surprise);
    if (why.empty()) continue;
    const std::int64_t paid =
        fit.n_tests - fit.n_tension + n_compressive * static_cast<std::int64_t>(per_round);
    if (b + 1 < n_planned + n_further && paid <= budget.max_tests)
      batches.push_back({false, true, per_round});
    else
      fit.notes.push_back("the estimate of the strengths had not settled when the search ended: " + why);
  }
  posterior.count_errors();
  draws = final_draws(posterior, sampler_seed + static_cast<std::uint32_t>(batches.size()));
  report(posterior, draws, estimate, packings.behind(), simulator.threads(), fit);
  report_mixing(draws, fit);
  report_without_peak(fit);
  return fit;
}

}  // namespace phy::calibrate
