#include <algorithm>
#include <cmath>
#include <optional>

#include "calibrate/search_plan.hpp"
#include "calibrate/sequence.hpp"
#include "calibrate/strength_tests.hpp"

namespace phy::calibrate {
namespace {

constexpr double met = 0.02;            // of a UCS: a third of what the verdict tolerates
constexpr double first_stride = 0.7;    // of the logarithm: a factor of two
constexpr double least_bracket = 0.01;  // of the logarithm

/// A strength and the UCS that is to tell it, by its place among the strengths of the table.
struct Step {
  const Parameter* parameter;
  std::size_t target;
};

std::vector<std::size_t> places_of_ucs(const std::vector<Target>& strengths) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < strengths.size(); ++i)
    if (strengths[i].property == Property::ucs) places.push_back(i);
  return places;
}

/// Takes the first by `before` of those with an inclination in between out of the list.
template <class Before>
std::optional<std::size_t> take(std::vector<std::size_t>& places, const std::vector<Target>& all, double from,
                                double to, const Before& before) {
  auto best = places.end();
  for (auto it = places.begin(); it != places.end(); ++it)
    if (const double theta = all[*it].theta; theta >= from && theta <= to)
      if (best == places.end() || before(all[*it], all[*best])) best = it;
  if (best == places.end()) return {};
  const std::size_t place = *best;
  // One UCS tells one strength: used twice, it would pull at both.
  places.erase(best);
  return place;
}

/// Who is told by what, in their order; see the head of sequence.hpp.
std::vector<Step> steps_of(const Evidence& evidence) {
  const std::vector<Target>& all = evidence.strengths;
  std::vector<std::size_t> left = places_of_ucs(all);
  const auto steeper = [](const Target& a, const Target& b) { return a.theta > b.theta; };
  const auto weaker = [](const Target& a, const Target& b) { return a.mean < b.mean; };
  auto matrix = take(left, all, 80.0, 90.0, steeper);
  if (!matrix)
    matrix = take(left, all, 0.0, 15.0, [&](const Target& a, const Target& b) { return steeper(b, a); });
  if (!matrix)
    matrix = take(left, all, 0.0, 90.0, [&](const Target& a, const Target& b) { return weaker(b, a); });
  std::vector<Step> steps = {{&matrix_sigma_c, matrix.value()}};
  if (!evidence.rock.bedded) return steps;
  if (const auto at = take(left, all, 0.0, 90.0, weaker)) steps.push_back({&joint_cohesion, *at});
  // at 0 and 90 degrees nothing slides nor opens
  if (const auto at = take(left, all, 20.0, 80.0, steeper)) steps.push_back({&joint_sigma_n, *at});
  return steps;
}

class Sequence {
 public:
  Sequence(const SearchTask& task, StrengthFit& fit)
      : evidence_(task.evidence),
        refit_(task.refit),
        seed_(task.seeds.front()),
        simulator_(task.simulator),
        begins_(task.listener.begins),
        fit_(fit),
        steps_(steps_of(evidence_)),
        left_(task.budget.max_tests - evidence_.n_compressive()),
        settings_(test_settings(task.recipe, evidence_.strengths, seed_, simulator_)),
        tests_(settings_, evidence_.strengths, seed_, simulator_) {
    fit_.recipe = settings_;
  }

  void run() {
    bool settled = false;
    for (int round = 1; round <= most_sequence_rounds && !settled && left_ > 0; ++round) {
      settled = !moved_in(round);
      if (!settled && refit_) read_moduli_anew();
    }
    fit_.shortage.settled = settled, fit_.shortage.of_tests = !settled && left_ <= 0;
    if (!settled && left_ > 0)
      fit_.notes.push_back({FindingKind::sequence_unsettled, {}, {{"rounds", most_sequence_rounds}}});
    conclude();
  }

 private:
  const Evidence& evidence_;
  const RefitModuli& refit_;
  std::int64_t seed_;
  Simulator& simulator_;
  const std::function<void(const Finding&)>& begins_;
  StrengthFit& fit_;
  std::vector<Step> steps_;
  std::int64_t left_;  ///< tests in compression, those of all strengths at the end put aside
  Recipe settings_;
  StrengthTests tests_;
  std::int64_t n_tests_ = 0;

  /// One strength after the other. False: none had to move.
  bool moved_in(int round) {
    bool moved = false;
    for (const Step& step : steps_) {
      // Not settled: the budget has ended it, and not the answer.
      if (left_ <= 0) return true;
      begins_({FindingKind::course_step,
               {cell_of(evidence_.strengths[step.target])},
               {{"round", static_cast<double>(round)}},
               {step.parameter->symbol}});
      // seek() first: the other way round the steps behind the first that moves would be skipped.
      moved = seek(step) || moved;
    }
    return moved;
  }

  /// log(UCS of the model/UCS of the table) with the strength at exp(x), one test; NaN without a peak.
  double miss_at(const Step& step, double x) {
    Recipe recipe = fit_.recipe;
    step.parameter->set(recipe, std::exp(x));
    const std::vector<TestResult> results =
        simulator_.test({tests_.of(recipe, step.target, seed_, as_measured)});
    --left_, ++n_tests_;
    const Target& t = evidence_.strengths[step.target];
    const double ucs = strength_of(results.front(), t.property);
    if (!std::isfinite(ucs)) ++fit_.n_without_peak;
    return std::log(ucs / t.mean);
  }

  /// Strides towards the target until it lies between two trials, then halves. True: the strength has moved.
  bool seek(const Step& step) {
    const LogBox box = step.parameter->box(evidence_.scales);
    const double start = std::log(step.parameter->get(fit_.recipe));
    double x = std::clamp(start, box.low, box.high), miss = miss_at(step, x), best = x,
           least = std::fabs(miss);
    double low = box.low, high = box.high;  // UCS grows with every strength
    bool low_tried = false, high_tried = false;
    while (least > met && high - low > least_bracket && left_ > 0 && std::isfinite(miss)) {
      (miss < 0.0 ? low : high) = x;
      (miss < 0.0 ? low_tried : high_tried) = true;
      const double next = low_tried && high_tried ? 0.5 * (low + high)
                          : miss < 0.0            ? std::min(x + first_stride, high)
                                                  : std::max(x - first_stride, low);
      if (next == x) break;  // at the end of the box
      x = next, miss = miss_at(step, x);
      if (std::fabs(miss) < least) best = x, least = std::fabs(miss);
    }
    step.parameter->set(fit_.recipe, std::exp(best));
    return best != start;
  }

  /// What tests have made of the moduli by where the table reads them, at the present strengths.
  void read_moduli_anew() {
    const std::vector<Target> tests = tests_to_read(evidence_);
    const auto n = static_cast<std::int64_t>(tests.size());
    if (left_ < n) return;
    // Softening takes tests from the same budget as the strengths.
    left_ -= n, n_tests_ += n;
    fit_.softenings =
        softenings_of({fit_.recipe, fit_.recipe, tests, {seed_}, evidence_.rock.E_is}, simulator_);
    fit_.recipe = with_moduli(fit_.recipe, refit_(fit_.softenings).recipe);
  }

  void add_estimate(const Parameter& p, Support rests_on) {
    const LogBox box = p.box(evidence_.scales);
    const double unit = p.over == nullptr ? 1.0 : p.over->number(fit_.recipe);
    Estimate e = number_of_recipe(p);
    e.value = p.number(fit_.recipe), e.low = e.high = nan, e.rests_on = std::move(rests_on);
    e.box_low = unit * std::exp(box.low), e.box_high = unit * std::exp(box.high);
    fit_.parameters.push_back(e);
  }

  /// All strengths of the table at the estimate, and what is said of it.
  void conclude() {
    for (const Step& step : steps_) {
      const Target& t = evidence_.strengths[step.target];
      add_estimate(*step.parameter, {Basis::tests, {at_angle(t.property, t.theta)}});
      if (step.parameter == &matrix_sigma_c)
        add_estimate(matrix_tau_c, {Basis::ratio_of_recipe, {}, matrix_sigma_c.symbol});
    }
    const auto is_step = [&](const Parameter& p) {
      return std::any_of(steps_.begin(), steps_.end(), [&](const Step& s) { return s.parameter == &p; });
    };
    if (evidence_.rock.bedded && !is_step(joint_cohesion))
      add_estimate(joint_cohesion, {Basis::ratio_of_recipe, {}, matrix_sigma_c.symbol});
    if (evidence_.rock.bedded && !is_step(joint_sigma_n))
      add_estimate(joint_sigma_n, {Basis::ratio_of_recipe,
                                   {},
                                   is_step(joint_cohesion) ? joint_cohesion.symbol : matrix_sigma_c.symbol});
    fit_.fitted = strength_response(fit_.recipe, evidence_.strengths, {seed_}, as_measured, simulator_);
    n_tests_ += evidence_.n_tests();
    report_unused();
    if (fit_.n_without_peak > 0)
      fit_.notes.push_back(
          {FindingKind::peaks_skipped,
           {},
           {{"tests", static_cast<double>(fit_.n_without_peak)}, {"of", static_cast<double>(n_tests_)}}});
    for (const Step& step : steps_)  // of this packing, at the end
      if (const Comparison& c = fit_.fitted[step.target];
          !(std::fabs(std::log(c.mean / c.target.mean)) <= met))
        fit_.notes.push_back(
            {FindingKind::step_missed, {cell_of(c.target)}, {{"limit", met}}, {step.parameter->symbol}});
  }

  /// What the table has and a sequence does not ask.
  void report_unused() {
    std::vector<Cell> unused;
    for (std::size_t i = 0; i < evidence_.strengths.size(); ++i)
      if (std::none_of(steps_.begin(), steps_.end(), [&](const Step& s) { return s.target == i; }))
        unused.push_back(cell_of(evidence_.strengths[i]));
    if (!unused.empty()) fit_.notes.push_back({FindingKind::values_unused, std::move(unused)});
  }
};

}  // namespace

void strengths_by_sequence(const SearchTask& task, StrengthFit& fit) { Sequence(task, fit).run(); }

}  // namespace phy::calibrate
