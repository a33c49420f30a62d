// The same budget of UCS tests spent three ways on synthetic rocks: by this calibration, by the paper's
// sequence (`--method sequence`, calibrate/sequence.hpp), by a global optimiser (NLopt, controlled random
// search). What counts is the error of UCS(theta) on five packings that none has used.
// PHY_TWIN_MAGNIFICATION, PHY_TWIN_FIRST and PHY_TWIN_ROCKS as in twin_trials.test.cpp; docs/calibration.md,
// "Compared".
//
// The optimiser gets the moduli of our elastic stage for nothing, and works on one packing: its objective
// must not change between calls.
#ifdef PHY_NLOPT
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <nlopt.hpp>
#include <thread>

#include "../calibration/twin_trial.hpp"
#include "analysis/analyse.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/parameters.hpp"
#include "calibrate/strength_stage.hpp"
#include "setting.hpp"

namespace phy {
namespace {

const std::vector<double> angles = {0, 15, 30, 45, 60, 75, 90};

const std::vector<std::int64_t> budgets = {100, 280};

/// UCS on packing 1 of whatever recipe, until the largest budget is spent; keeps what a method held for its
/// best when each budget was reached.
class Laboratory {
 public:
  explicit Laboratory(calibrate::Simulator& simulator) : simulator_(simulator), best_(budgets.size()) {}
  bool can_pay(std::size_t tests) const {
    return spent_ + static_cast<std::int64_t>(tests) <= budgets.back();
  }
  void note(const Recipe& best) {
    for (std::size_t i = 0; i < budgets.size(); ++i)
      if (spent_ <= budgets[i]) best_[i] = best;
  }
  /// The last one noted within each budget.
  const std::vector<Recipe>& best() const { return best_; }
  std::vector<double> ucs(const Recipe& recipe, const std::vector<double>& at) {
    spent_ += static_cast<std::int64_t>(at.size());
    std::vector<Recipe> recipes;
    for (const double theta : at) recipes.push_back(calibrate::single_at(recipe, theta, 1));
    std::vector<double> values;
    for (const TestResult& r : simulator_.test(recipes)) {
      const Number* n = analysis::find(r.numbers, "ucs");
      values.push_back(n != nullptr && r.outcome.status == Status::peaked ? n->value : 1e3);
    }
    return values;
  }

 private:
  calibrate::Simulator& simulator_;
  std::int64_t spent_ = 0;
  std::vector<Recipe> best_;
};

/// Those that a table of UCS is asked for.
std::vector<const calibrate::StrengthParameter*> sought_by_ucs() {
  Recipe bedded;
  bedded.bedding.resize(1);
  std::vector<const calibrate::StrengthParameter*> list = calibrate::strength_parameters(bedded);
  std::erase_if(list, [](const calibrate::StrengthParameter* p) { return p->if_held; });
  return list;
}

/// Strengths from numbers in [0, 1] across the box.
Recipe strengths_at(Recipe recipe, const std::vector<double>& x, double largest) {
  calibrate::Scales scales;
  scales.strength = largest;
  std::size_t i = 0;
  for (const calibrate::StrengthParameter* p : sought_by_ucs()) {
    const calibrate::LogBox box = p->box(scales);
    p->set(recipe, std::exp(box.low + x[i++] * (box.high - box.low)));
  }
  return recipe;
}

double largest_of(const std::vector<Target>& ucs) {
  double largest = 0.0;
  for (const Target& t : ucs) largest = std::max(largest, t.mean);
  return largest;
}

/// Where a user without knowledge would begin.
std::vector<double> usual_start() {
  std::vector<double> x;
  for (const calibrate::StrengthParameter* p : sought_by_ucs())
    x.push_back(0.5 * (p->place_of(p->range.usual) + 1.0));
  return x;
}

std::vector<Recipe> by_optimiser(const Recipe& elastic, const std::vector<Target>& ucs,
                                 calibrate::Simulator& simulator) {
  Laboratory laboratory(simulator);
  const double largest = largest_of(ucs);
  std::vector<double> best = usual_start();
  double least = 1e300;
  struct Problem {
    const std::function<double(const std::vector<double>&)> value;
  } problem{[&](const std::vector<double>& x) {
    if (!laboratory.can_pay(angles.size())) throw nlopt::forced_stop();
    const std::vector<double> model = laboratory.ucs(strengths_at(elastic, x, largest), angles);
    double sum = 0.0;
    for (std::size_t i = 0; i < model.size(); ++i) sum += std::pow(std::log(model[i] / ucs[i].mean), 2);
    if (sum < least) least = sum, best = x;
    laboratory.note(strengths_at(elastic, best, largest));
    return sum;
  }};
  nlopt::opt optimiser(nlopt::GN_CRS2_LM, static_cast<unsigned>(best.size()));
  optimiser.set_lower_bounds(0.0), optimiser.set_upper_bounds(1.0);
  optimiser.set_population(14);  // twice the parameters, for a small budget
  optimiser.set_min_objective([](const std::vector<double>& x, std::vector<double>&,
                                 void* p) { return static_cast<Problem*>(p)->value(x); },
                              &problem);
  nlopt::srand(1);
  std::vector<double> x = best;
  double value = 0.0;
  try {
    optimiser.optimize(x, value);
  } catch (const nlopt::forced_stop&) {       // the budget is spent
  } catch (const nlopt::roundoff_limited&) {  // it has come as far as it can
  }
  return laboratory.best();
}

Recipe by_sequence(const Rock& rock, std::int64_t budget, calibrate::Simulator& simulator) {
  calibrate::CalibrationOptions how;
  how.method = CalibrationMethod::sequence, how.max_tests = budget;
  return calibrate::calibrate(calibrate::Evidence(rock), how, simulator).recipe;
}

TEST(Comparison, MisfitOverBudgetOfThreeMethods) {
  const auto first = static_cast<std::uint32_t>(setting("PHY_TWIN_FIRST", 0));
  const auto last = first + static_cast<std::uint32_t>(setting("PHY_TWIN_ROCKS", 10));
  const Recipe model = magnified_model(setting("PHY_TWIN_MAGNIFICATION", 5.0));
  const int threads = static_cast<int>(setting("PHY_TWIN_THREADS", std::thread::hardware_concurrency()));
  double ours_sum = 0.0, others_sum = 0.0;
  for (std::uint32_t k = first; k < last; ++k) {
    const auto simulator = calibrate::make_simulator({threads, "", nullptr, nullptr});
    std::vector<Recipe> global;
    for (std::size_t b = 0; b < budgets.size(); ++b) {
      const Trial t = run_trial(k, model, angles, budgets[b], *simulator, 15);
      const Rock rock = rock_of(t, k, model, angles);
      const std::vector<Target> targets = targets_of(rock), ucs = of_property(targets, Property::ucs);
      if (b == 0) {
        const Recipe settings = calibrate::test_settings(t.found.recipe, ucs, 1, *simulator);
        global = by_optimiser(settings, ucs, *simulator);
      }
      const auto error = [&](const Recipe& r) {
        return rmse_against(calibrate::strength_response(r, ucs, unseen_packings(),
                                                         calibrate::Loading::from_rest, *simulator),
                            t.unseen, Property::ucs);
      };
      const double ours = rmse_against(t.found.verification, t.unseen, Property::ucs),
                   sequential = error(by_sequence(rock, budgets[b], *simulator)), crs2 = error(global[b]);
      std::printf("rock %2u, %3lld tests: RMSE of UCS ours %5.1f %%, sequential %5.1f %%, CRS2 %5.1f %%\n", k,
                  static_cast<long long>(budgets[b]), 100.0 * ours, 100.0 * sequential, 100.0 * crs2);
      std::fflush(stdout);
      ours_sum += ours, others_sum += std::min(sequential, crs2);
    }
  }
  EXPECT_LT(ours_sum, others_sum);  // better on the whole than the better of the others, rock by rock
}

}  // namespace
}  // namespace phy
#endif
