// How often the band of an ensemble holds what the rock does in tests that the calibration has not seen.
//
// A twin's laboratory has three specimens per angle, each a packing of its own; the calibration sees E, nu
// and UCS of these. Then DTS(45) and sigma_1(45, 10 MPa) of the twenty draws against the truth on six other
// packings: their mean, and each as the single specimen that the band is about. PHY_TWIN_MAGNIFICATION (6:
// 208 discs), PHY_TWIN_FIRST, PHY_TWIN_ROCKS, PHY_TWIN_STORE as in twin_trials.test.cpp.
#include <gtest/gtest.h>

#include <cstdio>
#include <thread>

#include "../calibration/twin_trial.hpp"
#include "analysis/analyse.hpp"
#include "base/stats.hpp"
#include "setting.hpp"
#include "study/band.hpp"
#include "study/experiment.hpp"

namespace phy {
namespace {

constexpr double theta = 45.0, sigma_3 = 10e6;
constexpr int n_specimens = 3, n_truth = 6;
const std::vector<double> table_angles = {0, 30, 60, 90};

/// The table: specimens with their own scatter, no other noise.
Rock laboratory(const Recipe& truth, const Recipe& model, std::uint32_t k, calibrate::Simulator& simulator) {
  Rock rock;
  rock.name = fmt::format("twin {}", k), rock.model = model;
  calibrate::TwinOptions as_it_is;
  as_it_is.noise = 0.0, as_it_is.n_specimens = 1;
  for (const std::int64_t seed : table_packings(k, n_specimens))
    for (RockReading r : calibrate::twin_readings(
             calibrate::twin_response(truth, table_angles, {seed}, simulator), as_it_is)) {
      r.line = static_cast<int>(seed);
      if (std::isfinite(r.value)) rock.readings.push_back(r);
    }
  return rock;
}

struct Question {
  const char* name;
  const char* number;
  Recipe (*of)(Recipe);
};
const Question questions[] = {{"DTS(45)", "sigma_t",
                               [](Recipe r) {
                                 r.test.kind = TestKind("direct_tension");
                                 r.test.platen_speed *= 0.2;  // it breaks at a small part of the strain
                                 return r;
                               }},
                              {"sigma_1(45, 10 MPa)", "sigma_1",
                               [](Recipe r) { return study::confined_recipe(std::move(r), sigma_3); }}};

/// The answers of recipes, each on its packing; NaN: no strength.
std::vector<double> answers(const Question& question, const std::vector<Recipe>& recipes,
                            const TestRecipe& settings, calibrate::Simulator& simulator) {
  std::vector<Recipe> singles;
  for (Recipe r : recipes) {
    r.test = settings, r.engine.precision = Precision::single_precision;
    r.test.angles = {theta}, r.test.n_snapshots = r.test.n_frames = 0;
    singles.push_back(study::single_recipes(question.of(r)).front());
  }
  std::vector<double> values;
  for (const TestResult& result : simulator.test(singles)) {
    const Number* n = analysis::find(result.numbers, question.number);
    values.push_back(has_strength(result.outcome.status) && n != nullptr ? n->value : nan);
  }
  return values;
}

study::Band band_of(const std::vector<double>& values) {
  std::vector<study::Predictions> draws;
  for (const double v : values) draws.push_back({{{}, "number", "Pa", v}});
  return study::bands_of(draws).front();
}

struct Tally {
  Coverage of_means, of_specimens;
};

/// One question to one twin.
void ask(const Question& question, const Recipe& truth, std::uint32_t k, const Calibration& found,
         calibrate::Simulator& simulator, Tally& tally) {
  const std::vector<std::int64_t> seeds = table_packings(k, 100);
  std::vector<Recipe> others(n_truth, truth);
  for (std::size_t i = 0; i < others.size(); ++i) others[i].packing.seed = seeds[50 + i];
  const study::Band band = band_of(answers(question, found.ensemble, found.recipe.test, simulator));
  std::vector<double> values = answers(question, others, found.recipe.test, simulator);
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty() || band.n < 2) return;
  const Summary s = summarise(values);
  tally.of_means.add(band.low, band.high, s.mean);
  int inside = 0;
  for (const double v : values)
    tally.of_specimens.add(band.low, band.high, v), inside += band.low <= v && v <= band.high ? 1 : 0;
  std::printf("rock %2u %-20s truth %6.2f +- %5.2f MPa, band %6.2f %6.2f %6.2f (%2zu), %s, %d of %zu\n", k,
              question.name, s.mean * 1e-6, s.sd * 1e-6, band.low * 1e-6, band.median * 1e-6,
              band.high * 1e-6, band.n, band.low <= s.mean && s.mean <= band.high ? "inside" : "OUTSIDE",
              inside, values.size());
  std::fflush(stdout);
}

TEST(EnsembleCoverage, BandsHoldTestsThatWereNotFitted) {
  const auto first = static_cast<std::uint32_t>(setting("PHY_TWIN_FIRST", 0));
  const auto n = first + static_cast<std::uint32_t>(setting("PHY_TWIN_ROCKS", 50));
  const Recipe model = magnified_model(setting("PHY_TWIN_MAGNIFICATION", 6.0));
  const int threads = static_cast<int>(setting("PHY_TWIN_THREADS", std::thread::hardware_concurrency()));
  const std::string folder = text_setting("PHY_TWIN_STORE");
  Tally tallies[std::size(questions)];
  for (std::uint32_t k = first; k < n; ++k) {
    const std::string store = folder.empty() ? "" : fmt::format("{}/twin-{}.sqlite", folder, k);
    const auto simulator = calibrate::make_simulator({threads, store, nullptr, nullptr});
    const Recipe truth = trial_rock(k, model);
    calibrate::CalibrationOptions how;
    how.max_tests = static_cast<std::int64_t>(setting("PHY_TWIN_TESTS", 72));
    const Calibration found =
        calibrate::calibrate(Evidence(laboratory(truth, model, k, *simulator)), how, *simulator);
    std::printf("rock %2u %s, %.0f s\n", k, to_string(found.verdict.status), found.seconds);
    for (std::size_t q = 0; q < std::size(questions); ++q)
      ask(questions[q], truth, k, found, *simulator, tallies[q]);
  }
  Coverage not_fitted, of_means;
  for (std::size_t q = 0; q < std::size(questions); ++q) {
    const Tally& t = tallies[q];
    std::printf(
        "%-20s specimens inside %d of %d (%.0f %%), their means %d of %d (%.0f %%), median of high/low - 1 "
        "%.0f %%\n",
        questions[q].name, t.of_specimens.inside, t.of_specimens.n, 100.0 * t.of_specimens.share(),
        t.of_means.inside, t.of_means.n, 100.0 * t.of_means.share(), 100.0 * t.of_means.median_width());
    not_fitted.inside += t.of_specimens.inside, not_fitted.n += t.of_specimens.n;
    of_means.inside += t.of_means.inside, of_means.n += t.of_means.n;
  }
  std::printf("not fitted: specimens %.1f %%, means %.1f %% of %d\n", 100.0 * not_fitted.share(),
              100.0 * of_means.share(), of_means.n);
  EXPECT_GE(not_fitted.share(), 0.80);
  EXPECT_LE(not_fitted.share(), 0.97);
}

}  // namespace
}  // namespace phy
