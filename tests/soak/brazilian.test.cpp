// A twin whose discs split at low load only where the bedding opens: the joints are weak in tension alone.
// The calibration sees UCS and Brazilian strengths with noise, on 1,197 discs, and must accept the table.
// Beside it the same rock with the ratio 15 at every angle, which must be refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <thread>

#include "../calibration/twin_trial.hpp"
#include "calibrate/elastic_response.hpp"
#include "calibrate/strength_tests.hpp"
#include "report/words.hpp"
#include "setting.hpp"

namespace phy {
namespace {

constexpr double ratio_out_of_reach = 15.0;
const std::vector<double> moduli_at = {0, 15, 30, 45, 60, 75, 90}, ucs_at = {0, 30, 60, 90},
                          bts_at = {0, 45, 90};

int threads() { return static_cast<int>(setting("PHY_TWIN_THREADS", std::thread::hardware_concurrency())); }

Recipe opening_rock(const Recipe& model) {
  Recipe r = model;
  r.matrix.tau_c = 1.5 * r.matrix.sigma_c, r.matrix.tau_c_sd = 1.5 * r.matrix.sigma_c_sd;
  r.bedding[0].cohesion = 0.4 * r.matrix.tau_c, r.bedding[0].sigma_n = 0.12 * r.bedding[0].cohesion;
  return r;
}

std::vector<Comparison> response(const Recipe& truth, calibrate::Simulator& simulator) {
  const std::vector<std::int64_t> seeds = packings_from(1001, 15);  // discs of so few grains scatter widely
  std::vector<Target> moduli, strengths;
  for (const Property p : {Property::E, Property::nu})
    for (const double theta : moduli_at) moduli.push_back({p, theta, 1.0, 1.0, 1, true});
  for (const double theta : ucs_at)
    strengths.push_back({Property::ucs, theta, 1.2 * truth.matrix.sigma_c, 1.0, 1, true});
  for (const double theta : bts_at)
    strengths.push_back({Property::brazilian, theta, 0.3 * truth.matrix.sigma_c, 1.0, 1, true});
  std::vector<Comparison> rows = calibrate::elastic_response(truth, moduli, seeds, simulator);
  const Recipe settings = calibrate::test_settings(truth, strengths, seeds.front(), simulator);
  for (const Comparison& c :
       calibrate::strength_response(settings, strengths, seeds, calibrate::from_rest, simulator))
    rows.push_back(c);
  return rows;
}

Calibration calibrated(const Recipe& model, const std::vector<Comparison>& table,
                       calibrate::Simulator& simulator) {
  Rock rock;
  rock.model = model, rock.name = "opening twin";
  rock.readings = calibrate::twin_readings(table, calibrate::TwinOptions{});
  const Calibration c = calibrate::calibrate(Evidence(rock), {}, simulator);
  for (const Comparison& row : c.verification)
    if (is_strength(row.target.property))
      std::printf("%s(%2.0f): table %.2f MPa, unseen %.2f, %d of %d discs not from the centre\n",
                  to_string(row.target.property), row.target.theta, row.target.mean * 1e-6, row.mean * 1e-6,
                  row.n_invalid, row.n_packings);
  std::printf("%s; %lld tests, %lld of them in tension\n", to_string(c.verdict.status),
              static_cast<long long>(c.counts.tests), static_cast<long long>(c.counts.tension));
  for (const Finding& f : c.verdict.findings) std::printf("- %s\n", report::sentence(f).c_str());
  return c;
}

TEST(BrazilianTwin, LowWhereBeddingOpensIsAcceptedLowEverywhereIsNot) {
  const auto simulator = calibrate::make_simulator({threads(), "", nullptr, nullptr});
  const Recipe model = magnified_model(2.5), truth = opening_rock(model);
  std::vector<Comparison> table = response(truth, *simulator);
  const Calibration accepted = calibrated(model, table, *simulator);
  EXPECT_NE(accepted.verdict.status, VerdictStatus::out_of_reach);
  for (const ParameterEstimate& e : accepted.parameters) {
    if (e.symbol != "sigma_n,sj") continue;
    EXPECT_LE(e.low, truth.bedding[0].sigma_n);
    EXPECT_GE(e.high, truth.bedding[0].sigma_n);
  }
  const std::vector<Comparison> before = table;
  for (Comparison& row : table)
    for (const Comparison& u : before)
      if (row.target.property == Property::brazilian && u.target.property == Property::ucs &&
          (u.target.theta == row.target.theta || (row.target.theta == 45.0 && u.target.theta == 60.0)))
        row.mean = u.mean / ratio_out_of_reach;
  const Calibration refused = calibrated(model, table, *simulator);
  EXPECT_EQ(refused.verdict.status, VerdictStatus::out_of_reach);
  EXPECT_NE(first_of(refused.verdict.findings, FindingKind::ratio_missed), nullptr);
}

}  // namespace
}  // namespace phy
