// What a fast approach, the search's speed, one speed for all angles, grains of equal mass without and with a
// longer time step, and an early end do to UCS and E beside loading from rest at a speed of its own:
// the same specimens loaded in all these ways, and with another draw of strengths as the yardstick. Rocks of
// 1,197 discs, both rules, joints that are stiff and soft, bonds with directions, flat joints.
// PHY_LOADING_PACKINGS: on how many packings (4); PHY_LOADING_THREADS: on how many threads (all).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "../calibration/twin_trial.hpp"
#include "base/stats.hpp"
#include "calibrate/strength_tests.hpp"
#include "setting.hpp"

namespace phy {
namespace {

using calibrate::Loading;
using calibrate::StrengthTests;

const std::vector<double> angles = {0, 15, 30, 45, 60, 75, 90};

int threads() {
  return static_cast<int>(setting("PHY_LOADING_THREADS", std::thread::hardware_concurrency()));
}
int n_packings() { return static_cast<int>(setting("PHY_LOADING_PACKINGS", 4)); }

struct NamedRock {
  std::string name;
  Recipe recipe;
};

Recipe rock(BeddingRule rule, double stiffness) {
  Recipe r = magnified_model(2.5);
  BeddingRecipe& b = r.bedding[0];
  b.rule = rule;
  b.k_n *= stiffness, b.k_s *= stiffness;
  return r;
}

std::vector<NamedRock> rocks() {
  std::vector<NamedRock> all = {{"zone, joints of the paper", rock(BeddingRule::zone, 1.0)},
                                {"zone, soft joints", rock(BeddingRule::zone, 0.3)},
                                {"crossing, joints of the paper", rock(BeddingRule::crossing, 1.0)},
                                {"crossing, soft joints", rock(BeddingRule::crossing, 0.3)}};
  NamedRock uneven = {"crossing, bonds with directions", rock(BeddingRule::crossing, 1.0)};
  uneven.recipe.matrix.stiffness_ratio = 0.6, uneven.recipe.matrix.tension_ratio = 0.6;
  NamedRock flat = {"crossing, flat joints", rock(BeddingRule::crossing, 1.0)};
  flat.recipe.matrix.model = MatrixModel::flat_joint;
  all.push_back(uneven), all.push_back(flat);
  return all;
}

/// UCS as targets, at the strengths that the rock itself has.
std::vector<Target> own_strengths(const Recipe& recipe, calibrate::Simulator& simulator) {
  std::vector<Target> targets;
  for (const Comparison& c : calibrate::twin_response(recipe, angles, {1}, simulator))
    if (c.target.property == Property::ucs) {
      targets.push_back(c.target);
      targets.back().mean = c.mean;
    }
  return targets;
}

/// Logarithms of ratios, in %.
struct Pairs {
  std::vector<double> percent;
  void add(double a, double b) {
    if (std::isfinite(a) && std::isfinite(b)) percent.push_back(100.0 * std::log(a / b));
  }
  void add(const Pairs& other) { percent.insert(percent.end(), other.percent.begin(), other.percent.end()); }
  double error() const { return summarise(percent).sd / std::sqrt(static_cast<double>(percent.size())); }
  std::string text() const {
    const Summary s = summarise(percent);
    return fmt::format("{:+.2f} +- {:.2f} % (single {:.1f})", s.mean, error(), s.sd);
  }
};

struct Effect {
  Pairs ucs, E;
  double steps = 0.0, steps_from_rest = 0.0;
  void add(const std::vector<TestResult>& tests, const std::vector<TestResult>& from_rest) {
    for (std::size_t k = 0; k < tests.size(); ++k) {
      ucs.add(calibrate::strength_of(tests[k], Property::ucs),
              calibrate::strength_of(from_rest[k], Property::ucs));
      E.add(calibrate::modulus_of(tests[k], Property::ucs, ModulusReading::tangent_50),
            calibrate::modulus_of(from_rest[k], Property::ucs, ModulusReading::tangent_50));
      steps += static_cast<double>(tests[k].n_steps);
      steps_from_rest += static_cast<double>(from_rest[k].n_steps);
    }
  }
  void add(const Effect& other) {
    ucs.add(other.ucs), E.add(other.E);
    steps += other.steps, steps_from_rest += other.steps_from_rest;
  }
  void print(const char* what) const {
    std::printf("  %-13s UCS %s, E %s, %zu pairs, steps x %.2f\n", what, ucs.text().c_str(), E.text().c_str(),
                ucs.percent.size(), steps / steps_from_rest);
  }
};

/// The same specimens loaded in several ways, all of them held against loading from rest with discs.
class Ways {
 public:
  void run(const std::vector<std::pair<const char*, Loading>>& loadings,
           const std::vector<std::pair<const char*, std::function<void(Recipe&)>>>& changes) {
    for (const NamedRock& r : rocks()) {
      const auto simulator = calibrate::make_simulator({threads(), "", nullptr, nullptr});
      const std::vector<Target> targets = own_strengths(r.recipe, *simulator);
      Recipe settings = calibrate::test_settings(r.recipe, targets, 1, *simulator);
      one_speed_ = settings.test.platen_speed, of_calibrations_ = settings.engine;
      settings.engine.grain_inertia = GrainInertia::disc;
      settings.engine.step_safety = EngineRecipe{}.step_safety;
      const StrengthTests tests(settings, targets, 1, *simulator);
      const auto tested = [&](const Loading& loading, const std::function<void(Recipe&)>& change) {
        std::vector<Recipe> recipes;
        for (std::size_t i = 0; i < targets.size(); ++i)
          for (const std::int64_t seed : packings_from(2, n_packings())) {
            recipes.push_back(tests.of(settings, i, seed, loading));
            change(recipes.back());
          }
        return simulator->test(recipes);
      };
      const std::vector<TestResult> from_rest = tested(calibrate::from_rest, [](Recipe&) {});
      std::printf("%s\n", r.name.c_str());
      for (const auto& [name, loading] : loadings) add(name, tested(loading, [](Recipe&) {}), from_rest);
      for (const auto& [name, change] : changes) add(name, tested(calibrate::from_rest, change), from_rest);
      std::fflush(stdout);
    }
    std::printf("all\n");
    for (const auto& [name, effect] : effects_) effect.print(name.c_str());
  }
  const Effect& of(const std::string& name) const { return effects_.at(name); }
  double one_speed() const { return one_speed_; }  // of all angles of the present rock
  const EngineRecipe& of_calibrations() const { return of_calibrations_; }

 private:
  std::map<std::string, Effect> effects_;
  double one_speed_ = 0.0;
  EngineRecipe of_calibrations_;

  void add(const std::string& name, const std::vector<TestResult>& tests,
           const std::vector<TestResult>& from_rest) {
    Effect e;
    e.add(tests, from_rest), e.print(name.c_str());
    effects_[name].add(e);
  }
};

void expect_little(const Pairs& moved) {
  EXPECT_GE(moved.percent.size(), 100U);
  EXPECT_LE(std::fabs(summarise(moved.percent).mean), 1.0);
}

TEST(Loading, ApproachAndSpeedMoveStrengthsAndModuliLittle) {
  Ways ways;
  ways.run({{"as measured", calibrate::as_measured},
            {"strengths", calibrate::strengths_as_measured},
            {"search", calibrate::search_of_strengths},
            {"with moduli", calibrate::search_with_moduli}},
           {{"other draw", [](Recipe& t) { ++t.matrix.bond_seed; }}});
  expect_little(ways.of("as measured").ucs), expect_little(ways.of("as measured").E);
  expect_little(ways.of("strengths").ucs);
  expect_little(ways.of("with moduli").E);
}

TEST(Loading, SpeedOfOneAndMassesMoveStrengthsAndModuliLittle) {
  Ways ways;
  ways.run({}, {// all angles at one speed: a hundred transits until the earliest of their peaks
                {"one speed", [&](Recipe& t) { t.test.platen_speed = ways.one_speed(); }},
                {"equal mass", [](Recipe& t) { t.engine.grain_inertia = GrainInertia::equal; }},
                {"and long step", [&](Recipe& t) { t.engine = ways.of_calibrations(); }},
                {"ends at 90 %", [](Recipe& t) { t.test.stop_at = 0.9; }}});
  for (const char* name : {"one speed", "equal mass", "and long step"}) expect_little(ways.of(name).ucs);
  for (const char* name : {"equal mass", "and long step"}) expect_little(ways.of(name).E);
}

/// Tests of a rock other than UCS, at the strengths that it has itself.
std::vector<Target> other_strengths(const Recipe& recipe, calibrate::Simulator& simulator) {
  std::vector<Target> targets;
  for (const double theta : {0.0, 45.0, 90.0}) {
    targets.push_back({Property::brazilian, theta, 0.3 * recipe.matrix.sigma_c, 1.0, 1, true});
    targets.push_back({Property::direct_tension, theta, 0.2 * recipe.matrix.sigma_c, 1.0, 1, true});
    targets.push_back({Property::confined, theta, 3.0 * recipe.matrix.sigma_c, 1.0, 1, true});
    targets.back().confining = 10e6;
  }
  for (int pass = 0; pass < 2; ++pass) {  // at the speed that suits what was found
    const Recipe settings = calibrate::test_settings(recipe, targets, 1, simulator);
    const auto rows =
        calibrate::strength_response(settings, targets, {1, 2}, calibrate::from_rest, simulator);
    for (std::size_t i = 0; i < targets.size(); ++i)
      if (std::isfinite(rows[i].mean)) targets[i].mean = rows[i].mean;
  }
  return targets;
}

TEST(Loading, ApproachMovesOtherStrengthsLittle) {
  const int n = n_packings();
  std::map<std::string, Pairs> all;
  for (const NamedRock& r : rocks()) {
    const auto simulator = calibrate::make_simulator({threads(), "", nullptr, nullptr});
    const std::vector<Target> targets = other_strengths(r.recipe, *simulator);
    const Recipe settings = calibrate::test_settings(r.recipe, targets, 1, *simulator);
    const StrengthTests tests(settings, targets, 1, *simulator);
    const auto tested = [&](const Loading& loading) {
      std::vector<Recipe> recipes;
      for (std::size_t i = 0; i < targets.size(); ++i)
        for (const std::int64_t seed : packings_from(2, n))
          recipes.push_back(tests.of(settings, i, seed, loading));
      return simulator->test(recipes);
    };
    const std::vector<TestResult> from_rest = tested(calibrate::from_rest);
    std::printf("%s\n", r.name.c_str());
    for (const auto& [name, loading] : {std::pair{"as measured", calibrate::as_measured},
                                        {"strengths", calibrate::strengths_as_measured},
                                        {"search", calibrate::search_of_strengths}}) {
      const std::vector<TestResult> hurried = tested(loading);
      for (std::size_t i = 0; i < targets.size(); ++i)
        for (std::size_t k = i * static_cast<std::size_t>(n); k < (i + 1) * static_cast<std::size_t>(n);
             ++k) {
          const Property p = targets[i].property;
          const std::string key = std::string(to_string(p)) + ", " + name;
          if (!has_strength(hurried[k].outcome.status) && has_strength(from_rest[k].outcome.status))
            std::printf("  %s(%g), %s: %s\n", to_string(p), targets[i].theta, name,
                        hurried[k].outcome.reason.c_str());
          all[key].add(calibrate::strength_of(hurried[k], p), calibrate::strength_of(from_rest[k], p));
          all[key + ", steps - 1"].add(static_cast<double>(hurried[k].n_steps),
                                       static_cast<double>(from_rest[k].n_steps));
        }
    }
    for (const auto& [key, pairs] : all)
      std::printf("  %s: %s, %zu pairs so far\n", key.c_str(), pairs.text().c_str(), pairs.percent.size());
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace phy
