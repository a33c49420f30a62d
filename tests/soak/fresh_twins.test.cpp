// The program on rocks that it has not been developed with (fresh_twins.hpp). PHY_TWIN_FIRST and
// PHY_TWIN_ROCKS choose some of the forty; PHY_TWIN_STORE names a folder that keeps finished tests, so that a
// run that was cut short goes on. A line per rock with everything that the summary counts; PHY_FRESH_MAPS=0:
// without what maps tell beforehand.
//
// The yardstick of what is left out is, rock by rock, the best curve of report/baselines.hpp.
#include <gtest/gtest.h>

#include <cstdio>
#include <thread>

#include "fresh_twins.hpp"
#include "report/baselines.hpp"
#include "setting.hpp"

namespace phy {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? nan : 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

double worst_against(const std::vector<Comparison>& rows, const std::vector<Comparison>& truth, Property p) {
  double worst = 0.0;
  for (const Comparison& a : rows)
    for (const Comparison& b : truth)
      if (a.target.property == p && b.target.property == p && a.target.theta == b.target.theta)
        worst = std::max(worst, std::fabs(a.mean / b.mean - 1.0));
  return worst;
}

/// Error of UCS left out, over that of the best yardstick; NaN: none was left out.
double over_yardstick(const Calibration& found) {
  for (const report::LeftOutErrors& e : report::left_out_errors(found))
    if (e.property == Property::ucs)
      return (std::isfinite(e.with_discrepancy) ? e.with_discrepancy : e.model) / e.curve;
  return nan;
}

struct Totals {
  std::vector<double> E, worst_E, ucs, floor_E, floor_ucs, left_out;
  Coverage inside_E, inside_ucs, parameters;
  int calibrated = 0;
};

void judge(std::uint32_t k, const FreshTwin& t, const Calibration& found,
           const std::vector<Comparison>& elsewhere, Totals& totals) {
  Coverage E, ucs, parameters;
  const Trial trial = {t.truth, t.response, elsewhere, found, {}};
  add_response(trial, Property::E, E), add_response(trial, Property::ucs, ucs);
  add_parameters(trial, parameters);
  add_response(trial, Property::E, totals.inside_E), add_response(trial, Property::ucs, totals.inside_ucs);
  add_parameters(trial, totals.parameters);
  totals.E.push_back(rmse_against(found.verification, t.response, Property::E));
  totals.worst_E.push_back(worst_against(found.verification, t.response, Property::E));
  totals.ucs.push_back(rmse_against(found.verification, t.response, Property::ucs));
  totals.floor_E.push_back(rmse_against(elsewhere, t.response, Property::E));
  totals.floor_ucs.push_back(rmse_against(elsewhere, t.response, Property::ucs));
  totals.left_out.push_back(over_yardstick(found));
  totals.calibrated += found.verdict.status == VerdictStatus::calibrated ? 1 : 0;
  std::printf(
      "rock %2u (%s; n %d, CV %4.1f %%): E50 %5.2f %%, worst %5.2f %%, UCS %5.2f %% (truth elsewhere %.2f, "
      "%.2f); inside %d/%d E, %d/%d UCS, %d/%d parameters; left out/yardstick %.2f; %lld tests, %.0f s, %s\n",
      k, mistake_of(k).c_str(), t.n, 100.0 * t.cv, 100.0 * totals.E.back(), 100.0 * totals.worst_E.back(),
      100.0 * totals.ucs.back(), 100.0 * totals.floor_E.back(), 100.0 * totals.floor_ucs.back(), E.inside,
      E.n, ucs.inside, ucs.n, parameters.inside, parameters.n, totals.left_out.back(),
      static_cast<long long>(found.counts.tests), found.seconds, to_string(found.verdict.status));
  std::fflush(stdout);
}

void print(const Totals& t) {
  std::printf(
      "%zu rocks, medians: E50 %.2f %%, worst cell %.2f %%, UCS %.2f %% (truth on other packings %.2f, "
      "%.2f), left out over the best yardstick %.2f; %d calibrated\n",
      t.E.size(), 100.0 * median(t.E), 100.0 * median(t.worst_E), 100.0 * median(t.ucs),
      100.0 * median(t.floor_E), 100.0 * median(t.floor_ucs), median(t.left_out), t.calibrated);
  const auto coverage = [](const char* what, const Coverage& c) {
    std::printf("95 %% intervals of %s: truth inside in %d of %d (%.0f %%), median width %.1f %%\n", what,
                c.inside, c.n, 100.0 * c.share(), 100.0 * c.median_width());
  };
  coverage("E50(theta)", t.inside_E), coverage("UCS(theta)", t.inside_ucs);
  coverage("determined parameters", t.parameters);
}

/// Rocks first ... last - 1, of those that were asked for: each with its table, and its answers elsewhere.
template <class Look>
void for_rocks(std::uint32_t first, std::uint32_t last, const Look& look) {
  const auto from = static_cast<std::uint32_t>(setting("PHY_TWIN_FIRST", 0));
  const auto until = from + static_cast<std::uint32_t>(setting("PHY_TWIN_ROCKS", n_fresh));
  const int threads = static_cast<int>(setting("PHY_TWIN_THREADS", std::thread::hardware_concurrency()));
  const std::string folder = text_setting("PHY_TWIN_STORE");
  for (std::uint32_t k = std::max(first, from); k < std::min(last, until); ++k) {
    const std::string store = folder.empty() ? "" : fmt::format("{}/fresh-{}.sqlite", folder, k);
    const auto simulator = calibrate::make_simulator({threads, store, nullptr, nullptr});
    const FreshTwin twin = fresh_twin(k, *simulator);
    look(k, twin,
         calibrate::twin_response(twin.truth, fresh_angles, unseen_packings(), *simulator,
                                  ModulusReading::tangent_50),
         *simulator);
  }
}

Totals run(std::uint32_t first, std::uint32_t last) {
  Totals totals;
  for_rocks(first, last,
            [&](std::uint32_t k, const FreshTwin& twin, const std::vector<Comparison>& elsewhere,
                calibrate::Simulator& simulator) {
              Evidence evidence(twin.rock);
              evidence.maps = setting("PHY_FRESH_MAPS", 1.0) != 0.0;
              judge(k, twin, calibrate::calibrate(evidence, {}, simulator), elsewhere, totals);
            });
  print(totals);
  return totals;
}

/// As if nothing but the rock itself were left out: what its five other packings answer.
Calibration known_all(const FreshTwin& twin, const std::vector<Comparison>& elsewhere) {
  Calibration c;
  for (const Target& t : targets_of(twin.rock)) {
    Comparison row;
    row.target = t, row.mean = t.mean;
    c.fitted.push_back(row);
    for (const Comparison& e : elsewhere)
      if (e.target.property == t.property && e.target.theta == t.theta && is_strength(t.property))
        row.mean = e.mean, c.left_out.push_back(row);
  }
  return c;
}

// No prediction of a noisy cell from specimens that differ can be nearer than the rock's own answer on other
// packings: the least that "left out over the best yardstick" can be. A table each, no calibration.
TEST(FreshTwins, LeastThatCanBeMissed) {
  std::vector<double> all;
  for_rocks(0, n_fresh,
            [&](std::uint32_t k, const FreshTwin& twin, const std::vector<Comparison>& elsewhere,
                calibrate::Simulator&) {
              all.push_back(over_yardstick(known_all(twin, elsewhere)));
              std::printf("rock %2u (%s; n %d, CV %4.1f %%): the rock itself over the best yardstick %.2f\n",
                          k, mistake_of(k).c_str(), twin.n, 100.0 * twin.cv, all.back());
              std::fflush(stdout);
            });
  std::printf("%zu rocks, median %.2f\n", all.size(), median(all));
  EXPECT_FALSE(all.empty());
}

TEST(FreshTwins, RockLike) {
  const Totals t = run(0, n_rock_like);
  if (t.E.empty()) GTEST_SKIP() << "no rock of this kind was asked for";
  EXPECT_LE(median(t.E), 0.03);
  EXPECT_LE(median(t.worst_E), 0.08);
  EXPECT_LE(median(t.ucs), 0.06);
  EXPECT_LE(median(t.left_out), 0.6);
}

TEST(FreshTwins, Misspecified) {
  const Totals t = run(n_rock_like, n_fresh);
  if (t.E.empty()) GTEST_SKIP() << "no rock of this kind was asked for";
  EXPECT_LE(median(t.ucs), 0.08);
  for (const Coverage* c : {&t.inside_E, &t.inside_ucs}) EXPECT_GE(c->share(), 0.85);
}

}  // namespace
}  // namespace phy
