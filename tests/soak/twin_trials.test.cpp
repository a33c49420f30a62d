// Twenty twin trials. PHY_TWIN_MAGNIFICATION sets the size of the grains (1: the paper's 7,481 discs, hours;
// default 2.5: 1,197 discs), PHY_TWIN_FIRST and PHY_TWIN_ROCKS choose rocks, PHY_TWIN_TABLE sets the packings
// behind a table (5, or 15 where packings are small and differ). The elastic part alone runs at full size
// (PHY_TWIN_ELASTIC_MAGNIFICATION). PHY_TWIN_EFFORT is that of the search (calibrate/effort.hpp; 0: quick; 1,
// the default: normal; 2: thorough). PHY_TWIN_STORE names a folder that keeps every finished test: a suite
// that was cut short goes on there.
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <thread>

#include "../calibration/twin_trial.hpp"
#include "report/words.hpp"
#include "setting.hpp"

namespace phy {
namespace {

/// File of finished tests of rock k, or none.
std::string store_of(std::uint32_t k) {
  const std::string folder = text_setting("PHY_TWIN_STORE");
  return folder.empty() ? "" : fmt::format("{}/rock-{}.sqlite", folder, k);
}

/// Mean over the targets of log(model on unseen packings over what the fit predicted).
double mean_offset(const Calibration& found, Property property) {
  double sum = 0.0;
  int n = 0;
  for (const Comparison& a : found.verification)
    for (const Comparison& b : found.fitted)
      if (a.target.property == property && b.target.property == property && a.target.theta == b.target.theta)
        sum += std::log(a.mean / b.mean), ++n;
  return sum / n;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

TEST(TwinTrials, TwentyRocks) {
  const auto first = static_cast<std::uint32_t>(setting("PHY_TWIN_FIRST", 0));
  const auto n = first + static_cast<std::uint32_t>(setting("PHY_TWIN_ROCKS", 20));
  const double magnification = setting("PHY_TWIN_MAGNIFICATION", 2.5);
  const Recipe model = magnified_model(magnification);
  const int n_table = static_cast<int>(setting("PHY_TWIN_TABLE", magnification > 2.0 ? 15 : 5));
  const int threads = static_cast<int>(setting("PHY_TWIN_THREADS", std::thread::hardware_concurrency()));
  const calibrate::Effort effort =
      calibrate::efforts.at(static_cast<std::size_t>(setting("PHY_TWIN_EFFORT", 1)));
  const calibrate::Budget budget(std::llround(300.0 * std::max(1.0, effort.points)), effort);
  const std::vector<double> angles = {0, 15, 30, 45, 60, 75, 90};
  std::vector<double> rmse_E, rmse_ucs;
  Coverage E, ucs, parameters;
  for (std::uint32_t k = first; k < n; ++k) {
    const auto simulator = calibrate::make_simulator({threads, store_of(k), nullptr, nullptr});
    const Trial t = run_trial(k, model, angles, budget, *simulator, n_table);
    rmse_E.push_back(rmse_against(t.found.verification, t.unseen, Property::E));
    rmse_ucs.push_back(rmse_against(t.found.verification, t.unseen, Property::ucs));
    add_response(t, Property::E, E), add_response(t, Property::ucs, ucs), add_parameters(t, parameters);
    Coverage here_E, here_ucs, here;
    add_response(t, Property::E, here_E), add_response(t, Property::ucs, here_ucs), add_parameters(t, here);
    std::printf(
        "rock %2u: RMSE E %5.2f %%, UCS %5.2f %%; inside %d/%d E, %d/%d UCS, %d/%d parameters; %lld tests, "
        "%.0f "
        "s, %s\n",
        k, 100.0 * rmse_E.back(), 100.0 * rmse_ucs.back(), here_E.inside, here_E.n, here_ucs.inside,
        here_ucs.n, here.inside, here.n, static_cast<long long>(t.found.counts.tests), t.found.seconds,
        to_string(t.found.verdict.status));
    std::printf(
        "         packings of the table against the unseen ones: E %.2f %%, UCS %.2f %%; unseen UCS against "
        "what the search predicted: %+.2f %%\n",
        100.0 * rmse_against(t.response, t.unseen, Property::E),
        100.0 * rmse_against(t.response, t.unseen, Property::ucs),
        100.0 * mean_offset(t.found, Property::ucs));
    std::printf("         mean ln(high/low) of the strengths' intervals after each batch:");
    for (const double width : t.widths) std::printf(" %.2f", width);
    std::printf("\n");
    for (const Finding& f : t.found.verdict.findings)
      std::printf("         %s\n", report::sentence(f).c_str());
    std::fflush(stdout);
    EXPECT_LE(t.found.counts.tests, budget.max_tests);
  }
  // four elastic parameters from E and nu, six strengths from UCS, 21 specimens
  std::printf("median RMSE: E %.2f %% (noise floor %.2f %%), UCS %.2f %% (noise floor %.2f %%)\n",
              100.0 * median(rmse_E), 5.0 * std::sqrt(4.0 / 42.0), 100.0 * median(rmse_ucs),
              5.0 * std::sqrt(6.0 / 21.0));
  const auto print = [](const char* what, const Coverage& c) {
    std::printf("95 %% intervals of %s: truth inside in %d of %d (%.0f %%), median width %.1f %%\n", what,
                c.inside, c.n, 100.0 * c.share(), 100.0 * c.median_width());
  };
  print("E(theta)", E), print("UCS(theta)", ucs), print("determined parameters", parameters);
  EXPECT_LE(median(rmse_E), 0.03);
  EXPECT_LE(median(rmse_ucs), 0.06);
  for (const Coverage* c : {&E, &ucs, &parameters}) EXPECT_GE(c->share(), 0.88);
}

TEST(TwinTrials, ElasticPartOfTwentyRocksAtFullSize) {
  const auto first = static_cast<std::uint32_t>(setting("PHY_TWIN_FIRST", 0));
  const auto n = first + static_cast<std::uint32_t>(setting("PHY_TWIN_ROCKS", 20));
  const Recipe model = magnified_model(setting("PHY_TWIN_ELASTIC_MAGNIFICATION", 1.0));
  const int threads = static_cast<int>(setting("PHY_TWIN_THREADS", std::thread::hardware_concurrency()));
  std::vector<double> rmse;
  Coverage E, parameters;
  const auto simulator = calibrate::make_simulator({threads, "", nullptr, nullptr});
  for (std::uint32_t k = first; k < n; ++k) {
    const Trial t = run_elastic_trial(k, model, {0, 15, 30, 45, 60, 75, 90}, *simulator,
                                      static_cast<int>(setting("PHY_TWIN_TABLE", 5)));
    rmse.push_back(rmse_against(t.found.verification, t.unseen, Property::E));
    Coverage here_E, here;
    add_response(t, Property::E, here_E), add_parameters(t, here);
    add_response(t, Property::E, E), add_parameters(t, parameters);
    std::printf(
        "rock %2u: RMSE E %5.2f %%; inside %d/%d E, %d/%d parameters; packings differ by %.1f %% at 0\n", k,
        100.0 * rmse.back(), here_E.inside, here_E.n, here.inside, here.n,
        100.0 * t.found.fitted.front().sd / t.found.fitted.front().mean);
    std::fflush(stdout);
  }
  std::printf(
      "median RMSE of E %.2f %%; E inside %d of %d (%.0f %%), median width %.1f %%; determined parameters "
      "inside %d of %d (%.0f %%), median width %.1f %%\n",
      100.0 * median(rmse), E.inside, E.n, 100.0 * E.share(), 100.0 * E.median_width(), parameters.inside,
      parameters.n, 100.0 * parameters.share(), 100.0 * parameters.median_width());
  EXPECT_LE(median(rmse), 0.03);
  for (const Coverage* c : {&E, &parameters}) EXPECT_GE(c->share(), 0.88);
}

}  // namespace
}  // namespace phy
