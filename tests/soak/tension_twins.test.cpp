// Rocks whose UCS is some 8 and 10 times their Brazilian strength at every inclination, as a laboratory would
// hand them in. They were written down before the first of them was run: of two families, the mapped specimen
// whose three ratios lie nearest to the goal (that of one packing; those of the table have less). The
// calibration is told neither what holds the grains nor what makes the layers; E is the tangent at half of
// the strength; three specimens of 5 % scatter per cell.
//
// What is asked of them is the goal; how many of the four meet it stands in docs/theory/calibration.md,
// "Which matrix".
//
// PHY_TWIN_FIRST and PHY_TWIN_ROCKS choose some of the four, PHY_TWIN_EFFORT the effort
// (calibrate/effort.hpp; 0: quick; 1, unless given: normal; 2: thorough), PHY_TWIN_STORE names a folder that
// keeps finished tests. A rock takes some 20 minutes of CPU.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

#include "../calibration/twin_trial.hpp"
#include "calibrate/strength_tests.hpp"
#include "maps/response_map.hpp"
#include "report/words.hpp"
#include "setting.hpp"

namespace phy {
namespace {

constexpr struct {
  const char* family;
  double ratio;
} rocks[] = {{"parallel-bond-directions", 8.0},
             {"parallel-bond-directions", 10.0},
             {"flat-joint-crossing", 8.0},
             {"flat-joint-crossing", 10.0}};
constexpr int n_table_packings = 10;
const std::vector<double> angles = {0, 15, 30, 45, 60, 75, 90};

/// Largest |log| of UCS/BTS over the goal at the mapped angles; infinite where one is not known.
double distance(const maps::ResponseMap& map, std::size_t row, double goal) {
  double worst = 0.0;
  for (const double theta : maps::mapped_disc_angles) {
    const auto at = [&](const char* stem) { return map.at(row, maps::column_at(map.model(), stem, theta)); };
    const double off = std::fabs(std::log(at("UCS/sigma_c") / at("BTS/sigma_c") / goal));
    if (!std::isfinite(off)) return INFINITY;
    worst = std::max(worst, off);
  }
  return worst;
}

Recipe nearest_specimen(const char* name, double goal) {
  const maps::MappedModel& of = family(name);
  const maps::ResponseMap& map = maps::map_of(of);
  std::size_t best = 0;
  double least = INFINITY;
  for (std::size_t row = 0; row < map.n_rows(); ++row)
    if (const double d = distance(map, row, goal); map.is_dense(row) && map.is_plausible(row) && d < least)
      best = row, least = d;
  Recipe r = of.base;
  for (std::size_t i = 0; i < of.variables.size(); ++i)
    of.variables[i].set(r, of.variables[i].from_normalised(map.places(best)[i]));
  std::printf("%s, row %zu: within a factor of %.2f of UCS/BTS = %g\n", name, best, std::exp(least), goal);
  return r;
}

std::vector<Comparison> response(const Recipe& truth, std::uint32_t k, calibrate::Simulator& simulator) {
  const std::vector<std::int64_t> seeds = table_packings(k, n_table_packings);
  std::vector<Comparison> rows =
      calibrate::twin_response(truth, angles, seeds, simulator, ModulusReading::tangent_50);
  std::vector<Target> discs;
  for (const Comparison& c : rows)
    if (c.target.property == Property::ucs) {
      Target t = c.target;
      t.property = Property::brazilian, t.mean = c.mean / rocks[k].ratio;
      discs.push_back(t);
    }
  const Recipe settings = calibrate::test_settings(truth, discs, seeds.front(), simulator);
  for (const Comparison& c :
       calibrate::strength_response(settings, discs, seeds, calibrate::from_rest, simulator))
    rows.push_back(c);
  return rows;
}

/// What a user hands in: a specimen, a spacing of the foliation, the table.
Rock rock_of(const Recipe& truth, const std::vector<Comparison>& table, std::uint32_t k) {
  Rock rock;
  rock.name = fmt::format("tension twin {}", k);
  rock.model = family("parallel-bond-crossing").base;
  if (!truth.bedding.empty()) rock.model.bedding[0].spacing = truth.bedding[0].spacing;
  rock.layers = LayerModel::choose, rock.matrix = std::nullopt, rock.E_is = ModulusReading::tangent_50;
  calibrate::TwinOptions options;
  options.noise_seed = k;
  rock.readings = calibrate::twin_readings(table, options);
  return rock;
}

/// Of the model on unseen packings against the rock without noise; prints the error.
bool holds(const Calibration& found, const std::vector<Comparison>& table, Property p, double tolerance) {
  const double error = rmse_against(found.verification, table, p);
  std::printf(" %s %.1f %%", to_string(p), 100.0 * error);
  return error <= tolerance;
}

TEST(TensionTwins, AreMetInCompressionAndTension) {
  const auto first = static_cast<std::uint32_t>(setting("PHY_TWIN_FIRST", 0));
  const auto end = std::min(first + static_cast<std::uint32_t>(setting("PHY_TWIN_ROCKS", std::size(rocks))),
                            static_cast<std::uint32_t>(std::size(rocks)));
  const int threads = static_cast<int>(setting("PHY_TWIN_THREADS", std::thread::hardware_concurrency()));
  const std::string folder = text_setting("PHY_TWIN_STORE");
  for (std::uint32_t k = first; k < end; ++k) {
    const std::string store = folder.empty() ? "" : fmt::format("{}/tension-{}.sqlite", folder, k);
    const auto simulator = calibrate::make_simulator({threads, store, nullptr, nullptr});
    const Recipe truth = nearest_specimen(rocks[k].family, rocks[k].ratio);
    const std::vector<Comparison> table = response(truth, k, *simulator);
    for (const Comparison& c : table)
      std::printf("%s(%g) %.4g (SD %.2g)\n", to_string(c.target.property), c.target.theta, c.mean, c.sd);
    std::fflush(stdout);
    calibrate::CalibrationOptions how;
    how.effort = calibrate::efforts.at(static_cast<std::size_t>(setting("PHY_TWIN_EFFORT", 1)));
    const Calibration found = calibrate::calibrate(Evidence(rock_of(truth, table, k)), how, *simulator);
    std::printf("rock %u:", k);
    EXPECT_TRUE(holds(found, table, Property::ucs, 0.06)) << "rock " << k;
    EXPECT_TRUE(holds(found, table, Property::brazilian, 0.10)) << "rock " << k;
    holds(found, table, Property::E, 0.03);
    std::printf("; %s; %lld tests, %.0f s\n", to_string(found.verdict.status),
                static_cast<long long>(found.counts.tests), found.seconds);
    std::printf("%s\n", report::verdict_words(found).c_str());
    for (const Finding& note : found.notes) std::printf("- %s\n", report::sentence(note).c_str());
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace phy
