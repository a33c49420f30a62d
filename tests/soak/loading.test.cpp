// What an affine pre-strain, the search's speed, one speed for all angles, grains of equal mass without and
// with a longer time step, and an early end do to UCS and E beside loading from rest at a speed of its own:
// the same specimens loaded in all these ways, and with another draw of strengths as the yardstick. Rocks of
// 1,197 discs, both rules, joints that are stiff and soft, bonds with directions, flat joints.
// PHY_LOADING_PACKINGS: on how many packings (4).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <thread>

#include "../calibration/twin_trial.hpp"
#include "base/stats.hpp"
#include "calibrate/strength_tests.hpp"
#include "setting.hpp"

namespace phy {
namespace {

using calibrate::Loading;
using calibrate::StrengthTests;

constexpr double search_speed = 1.4;
const std::vector<double> angles = {0, 15, 30, 45, 60, 75, 90};

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
      E.add(calibrate::modulus_of(tests[k], ModulusReading::tangent_50),
            calibrate::modulus_of(from_rest[k], ModulusReading::tangent_50));
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

TEST(Loading, PreStrainAndSpeedMoveStrengthsAndModuliLittle) {
  const auto threads = static_cast<int>(std::thread::hardware_concurrency());
  const auto n = static_cast<int>(setting("PHY_LOADING_PACKINGS", 4));
  Effect pre_strained, search, other_draw, one_speed, equal_mass, long_step, early_end;
  for (const NamedRock& r : rocks()) {
    const auto simulator = calibrate::make_simulator({threads, "", nullptr, nullptr});
    const std::vector<Target> targets = own_strengths(r.recipe, *simulator);
    Recipe settings = calibrate::test_settings(r.recipe, targets, 1, *simulator);
    const EngineRecipe of_calibrations = settings.engine;
    settings.engine.grain_inertia = GrainInertia::disc;
    settings.engine.step_safety = EngineRecipe{}.step_safety;
    const StrengthTests tests(settings, targets, 1, *simulator);
    const auto tested = [&](Loading loading, const std::function<void(Recipe&)>& change) {
      std::vector<Recipe> recipes;
      for (std::size_t i = 0; i < targets.size(); ++i)
        for (const std::int64_t seed : packings_from(2, n)) {
          recipes.push_back(tests.of(settings, i, seed, loading));
          change(recipes.back());
        }
      return simulator->test(recipes);
    };
    const std::vector<TestResult> from_rest = tested(Loading::from_rest, [](Recipe&) {});
    Effect a, b, c, d, e, f, g;
    a.add(tested(Loading::search, [](Recipe& t) { t.test.platen_speed /= search_speed; }), from_rest);
    b.add(tested(Loading::search, [](Recipe&) {}), from_rest);
    c.add(tested(Loading::from_rest, [](Recipe& t) { ++t.matrix.bond_seed; }), from_rest);
    // all angles at one speed: a hundred transits until the earliest of their peaks
    d.add(tested(Loading::from_rest, [&](Recipe& t) { t.test.platen_speed = settings.test.platen_speed; }),
          from_rest);
    e.add(tested(Loading::from_rest, [](Recipe& t) { t.engine.grain_inertia = GrainInertia::equal; }),
          from_rest);
    f.add(tested(Loading::from_rest, [&](Recipe& t) { t.engine = of_calibrations; }), from_rest);
    g.add(tested(Loading::from_rest, [](Recipe& t) { t.test.stop_at = 0.9; }), from_rest);
    std::printf("%s\n", r.name.c_str());
    a.print("pre-strained"), b.print("search"), d.print("one speed"), e.print("equal mass");
    f.print("and long step"), g.print("ends at 90 %"), c.print("other draw");
    std::fflush(stdout);
    pre_strained.add(a), search.add(b), other_draw.add(c), one_speed.add(d), equal_mass.add(e);
    long_step.add(f), early_end.add(g);
  }
  std::printf("all\n");
  pre_strained.print("pre-strained"), search.print("search"), one_speed.print("one speed");
  equal_mass.print("equal mass"), long_step.print("and long step"), early_end.print("ends at 90 %");
  other_draw.print("other draw");
  EXPECT_GE(pre_strained.ucs.percent.size(), 100U);
  for (const Pairs* moved :
       {&one_speed.ucs, &search.ucs, &search.E, &equal_mass.ucs, &equal_mass.E, &long_step.ucs, &long_step.E})
    EXPECT_LE(std::fabs(summarise(moved->percent).mean), 1.0);
}

}  // namespace
}  // namespace phy
