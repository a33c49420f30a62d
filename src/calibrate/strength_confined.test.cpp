// The strength stage on tables with strengths under confinement, with and without UCS.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "base/check.hpp"
#include "calibrate/calibration.hpp"
#include "calibrate/paper_press_fixture.hpp"
#include "calibrate/search_plan.hpp"
#include "calibrate/strength_stage.hpp"
#include "records/reading_fixture.hpp"

namespace phy::calibrate {
namespace {

/// Its joints slide at 45 degrees under every stress, and nowhere at 0 and 90.
Recipe sliding_rock() {
  Recipe rock;
  rock.bedding.resize(1);
  rock.matrix.sigma_c = 60e6, rock.matrix.tau_c = 120e6, rock.matrix.mu = 0.6;
  rock.bedding[0].cohesion = 15e6, rock.bedding[0].sigma_n = 8e6, rock.bedding[0].mu = 0.5;
  return rock;
}

/// UCS at three angles, and strengths under two stresses.
Rock confined_rock(const Recipe& rock) {
  Rock table;
  table.model.bedding.resize(1);
  for (const double theta : {0.0, 45.0, 90.0}) {
    Recipe tested = rock;
    tested.bedding[0].theta = theta;
    table.readings.push_back(reading(Property::ucs, theta, PaperPress::ucs(tested)));
    for (const double sigma_3 : {5e6, 30e6}) {
      tested.test.confining_stress = sigma_3;
      table.readings.push_back(reading(Property::confined, theta, PaperPress::confined(tested)));
      table.readings.back().confining = sigma_3;
    }
  }
  return table;
}

const ParameterEstimate& estimate_of(const Calibration& c, const std::string& symbol) {
  return *std::find_if(c.parameters.begin(), c.parameters.end(),
                       [&](const ParameterEstimate& e) { return e.symbol == symbol; });
}

TEST(ConfinedStrength, StrengthsUnderConfinementAreMetAndTellFriction) {
  const Recipe rock = sliding_rock();
  CalibrationOptions options;
  options.max_tests = 1000;
  PaperPress press;
  const Calibration c = calibrate(Evidence(confined_rock(rock)), options, press);
  int n = 0;
  for (const Comparison& row : c.verification) {
    if (row.target.property != Property::confined) continue;
    EXPECT_NEAR(row.error(), 0.0, 0.1) << cell_name(row.target);
    ++n;
  }
  EXPECT_EQ(n, 6);
  EXPECT_NE(c.verdict.status, VerdictStatus::out_of_reach);
  for (const char* symbol : {"mu", "mu_sj"}) {
    const ParameterEstimate& told = estimate_of(c, symbol);
    const double value = told.number(rock);
    EXPECT_TRUE(told.low <= value && value <= told.high) << symbol << ' ' << value;
    const double of_prior = 2.0 * 1.96 * (symbol == std::string("mu") ? matrix_mu : joint_mu).range.sd;
    EXPECT_LT(std::log(told.high / told.low), 0.5 * of_prior) << symbol << ", whose prior was wider";
  }
  EXPECT_EQ(c.counts.tension, 0);
  EXPECT_EQ(c.counts.tests, 9 * (36 + 5));  // of the budget all
}

// As c and phi of envelopes are read: pressures inside the tested range, none of them 0.
TEST(ConfinedStrength, StrengthsUnderConfinementAloneAreFitted) {
  const Recipe rock = sliding_rock();
  Rock table = confined_rock(rock);
  std::erase_if(table.readings, [](const RockReading& r) { return r.property == Property::ucs; });
  PaperPress press;
  const Calibration c = calibrate(Evidence(table), {}, press);
  for (const Comparison& row : c.verification) EXPECT_NEAR(row.error(), 0.0, 0.1) << cell_name(row.target);
  EXPECT_EQ(c.verification.size(), 6U);
  const ParameterEstimate& sigma = estimate_of(c, "sigma_c");
  EXPECT_TRUE(sigma.low <= 60e6 && 60e6 <= sigma.high) << sigma.low << ' ' << sigma.high;
  EXPECT_GT(sigma.high / sigma.low, 1.05) << "nobody knows it to the last digit";
}

// A press that softens by 20 % without a stress on the sides, and by 5 % less for every 5 MPa. Every modulus
// is read in its own test; one without a strength has its test all the same.
TEST(ConfinedStrength, ModuliUnderConfinementAreReadInTheTestsOfTheirStress) {
  const Recipe rock = sliding_rock();
  PaperPress press;
  press.tangent = 0.8, press.closing = 0.1;
  Rock table = confined_rock(rock);
  table.E_is = ModulusReading::tangent_50;
  const std::vector<RockReading> strengths = table.readings;
  for (const RockReading& r : strengths) {
    if (r.confining > 10e6) continue;
    Recipe tested = rock;
    tested.bedding[0].theta = r.theta, tested.test.confining_stress = r.confining;
    table.readings.push_back(reading(Property::E, r.theta, press.tangent_modulus(tested)));
    table.readings.back().confining = r.confining;
  }
  std::erase_if(table.readings, [](const RockReading& r) {
    return r.property == Property::confined && r.confining == 5e6 && r.theta == 90.0;
  });
  CalibrationOptions options;
  options.max_tests = 1000;
  const Calibration c = calibrate(Evidence(table), options, press);
  // This press gives no derivatives: stiffnesses stay those of the first guess, 13 % high at 0 and 45
  // degrees.
  std::map<double, double> without_stress;
  int n = 0;
  for (const Comparison& row : c.verification) {
    if (row.target.property != Property::E) continue;
    if (row.target.confining == 0.0) without_stress[row.target.theta] = row.error();
    EXPECT_NEAR(row.error(), without_stress.at(row.target.theta), 0.003) << cell_name(row.target);
    ++n;
  }
  EXPECT_NEAR(without_stress.at(90.0), 0.0, 0.01);
  EXPECT_EQ(n, 6);
  EXPECT_EQ(first_of(c.notes, FindingKind::modulus_without_test), nullptr);
  const Comparison* own = row_of(c.verification, Evidence(table).read_only.front());
  EXPECT_EQ(own, nullptr) << "it is no strength of the table";
}

TEST(ConfinedStrength, ABudgetCountsStrengthsUnderConfinement) {
  PaperPress press;
  CalibrationOptions options;
  options.max_tests = 9 * (least_points + verification_packings) - 1;
  EXPECT_THROW(calibrate(Evidence(confined_rock(sliding_rock())), options, press), InputError);
  EXPECT_EQ(press.n_tests, 0);
}

}  // namespace
}  // namespace phy::calibrate
