#include "jobs/time_left.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/clock.hpp"
#include "jobs/machine.hpp"
#include "report/words.hpp"
#include "study/expected.hpp"
#include "study/experiment.hpp"
#include "study/worker.hpp"

namespace phy::jobs {
namespace {

using calibrate::PlannedStage;

// Factors by which a time may be off: before anything has run, and when the speed is known. A cost is a guess
// from the strengths of the table, and weaker points of a search end sooner (measured/time.csv).
constexpr double doubt_at_first = 3.0, doubt_later = 2.0;
// The same of the whole course of one model.
constexpr double doubt_of_course = 1.3;
// Of the least that is ahead, what counts as much as the first guess of the speed.
constexpr double prior_share = 0.05;

/// Sixteen small specimens: lanes are full, and it takes a tenth of a second.
Recipe small_test() {
  Recipe recipe;
  recipe.specimen.width = 6e-3, recipe.specimen.height = 12e-3;
  recipe.packing.n_grains = 0, recipe.packing.porosity = 0.16;
  recipe.test.max_strain = 1e-3;
  // As a calibration's own tests, whose speed is asked for.
  recipe.engine.precision = Precision::single_precision;
  recipe.engine.grain_inertia = GrainInertia::equal;
  return recipe;
}

double seconds_of_small_test() {
  const Recipe recipe = small_test();
  const auto specimen = study::specimen_of(study::packing_of(recipe), recipe);
  const study::Specimens specimens(16, specimen);
  const study::MachineOptions machine = machine_of(1);
  study::Progress last;
  study::Hooks hooks;
  hooks.on_progress = [&](const study::Progress& p) { last = p; };
  const auto start = std::chrono::steady_clock::now();
  study::run_tests(specimens, recipe, machine, hooks);
  return last.work > 0.0 ? seconds_since(start) / last.work
                         : study::usual_seconds_per_cost(Precision::single_precision);
}

/// The median: what else the machine does may hold one of them up.
double measured_seconds_per_cost() {
  std::array<double, 3> seconds = {seconds_of_small_test(), seconds_of_small_test(), seconds_of_small_test()};
  std::ranges::sort(seconds);
  return seconds[1];
}

}  // namespace

double seconds_per_cost(int threads) {
  static const double of_one = measured_seconds_per_cost();
  // As if threads were alike and never idle; stages that end correct it.
  return of_one / threads;
}

Finding expected_course(const calibrate::Outlook& outlook, int threads) {
  const calibrate::Ahead& one = outlook.first;
  const double speed = seconds_per_cost(threads);
  return {FindingKind::course_expected,
          {},
          {{"least_tests", static_cast<double>(one.least_tests)},
           {"most_tests", static_cast<double>(one.most_tests)},
           {"least_seconds", speed * one.least_cost / doubt_of_course},
           {"most_seconds", speed * one.most_cost * doubt_of_course},
           {"threads", static_cast<double>(threads)},
           {"models", static_cast<double>(outlook.models)}}};
}

void TimeLeft::outlook(const calibrate::Outlook& ahead, double now) {
  end_stage(now);
  // Once: speeds that were learned with the first model hold for the next.
  if (!ahead_) of_tests_.prior = of_solutions_.prior = prior_share * ahead.ahead().least_cost;
  ahead_ = ahead, next_ = 0, begun_ = 0;
}

bool TimeLeft::begins(FindingKind stage, double now) {
  if (!ahead_) return false;
  const auto& all = ahead_->stages;
  // Only forwards: stages of one kind recur, and those that are skipped never came.
  const auto it = std::find_if(all.begin() + static_cast<std::ptrdiff_t>(next_), all.end(),
                               [&](const PlannedStage& s) { return s.kind == stage; });
  if (it == all.end()) return false;
  end_stage(now);
  next_ = static_cast<std::size_t>(it - all.begin()) + 1, ++begun_;
  return true;
}

void TimeLeft::tests(const calibrate::TestProgress& progress) { tests_ = progress; }

void TimeLeft::end_stage(double now) {
  if (ahead_ && next_ > 0) {
    const PlannedStage& ended = ahead_->stages[next_ - 1];
    // Two speeds: a direct solution factors a matrix, a test counts cycles; their costs share no unit of
    // time.
    Speed& speed = ended.tests > 0 ? of_tests_ : of_solutions_;
    // tests from a store take no time, and say nothing of the speed
    const double fresh = ended.tests == 0 ? 1.0
                         : tests_.n_total == 0
                             ? 0.0
                             : static_cast<double>(tests_.n_new) / static_cast<double>(tests_.n_total);
    // Only the share that ran counts as cost, for the same seconds.
    if (fresh > 0.0) speed.cost += fresh * ended.cost, speed.seconds += now - since_;
  }
  since_ = now, tests_ = {};
}

SecondsRange TimeLeft::range_of(const Speed& s, double least_cost, double most_cost) const {
  // The first guess weighs like a little work; with each stage the measured speed takes over.
  const double known = s.cost / (s.prior + s.cost),
               speed = std::lerp(first_speed_, s.cost > 0.0 ? s.seconds / s.cost : 0.0, known),
               doubt = std::lerp(doubt_at_first, doubt_later, known);
  return {speed * least_cost / doubt, speed * most_cost * doubt};
}

SecondsRange TimeLeft::of_stage(const PlannedStage& s) const {
  // A stage that may not come adds to the upper end alone.
  return range_of(s.tests > 0 ? of_tests_ : of_solutions_, s.certain ? s.cost : 0.0, s.cost);
}

SecondsRange TimeLeft::of_this_stage(double now) const {
  if (next_ == 0) return {};
  PlannedStage stage = ahead_->stages[next_ - 1];
  // It runs already, so that its least counts, too.
  stage.certain = true;
  const SecondsRange whole = of_stage(stage);
  const double gone = now - since_;
  // where nothing is counted the end may be here
  if (tests_.n_total == 0) return {0.0, std::max(whole.high - gone, 0.5 * gone)};
  const double left = 1.0 - static_cast<double>(tests_.n_done) / static_cast<double>(tests_.n_total);
  SecondsRange range = {left * whole.low, left * whole.high};
  // The range widens to hold both estimates: neither is better in general.
  if (tests_.n_new > 0) {  // by its own tests
    range.low = std::min(range.low, tests_.seconds_left / doubt_later);
    range.high = std::max(range.high, tests_.seconds_left * doubt_later);
  }
  return range;
}

std::optional<SecondsRange> TimeLeft::at(double now) const {
  if (!ahead_) return {};
  SecondsRange all = of_this_stage(now);
  const auto add = [&](const SecondsRange& one) { all.low += one.low, all.high += one.high; };
  for (std::size_t k = next_; k < ahead_->stages.size(); ++k) add(of_stage(ahead_->stages[k]));
  // Other models after this one are planned in less detail: a cost, no stages.
  add(range_of(of_tests_, ahead_->later.least_cost, ahead_->later.most_cost));
  return all;
}

TimeLeft::Place TimeLeft::place() const {
  if (!ahead_) return {};
  std::size_t certain = 0;
  for (std::size_t k = next_; k < ahead_->stages.size(); ++k) certain += ahead_->stages[k].certain ? 1 : 0;
  return {ahead_->model, ahead_->models, begun_, begun_ + certain, begun_ + ahead_->stages.size() - next_};
}

std::string TimeLeft::text(double now) const {
  const Place p = place();
  std::vector<std::string> parts;
  if (p.models > 1 && p.model > 0) parts.push_back(fmt::format("model {} of at most {}", p.model, p.models));
  // One stage is not counted: before models are compared nobody knows how many follow.
  if (p.most > 1)
    parts.push_back(
        fmt::format("stage {} of {}", p.stage,
                    report::range_text(static_cast<double>(p.least), static_cast<double>(p.most), "{:.0f}")));
  if (const auto left = at(now)) parts.push_back(report::duration_text(left->low, left->high) + " left");
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace phy::jobs
