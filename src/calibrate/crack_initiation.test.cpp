// sigma_ci as a target: read in the tests of UCS, met by slits of flat joints, which soften the rock too.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "calibrate/calibration.hpp"
#include "calibrate/paper_press_fixture.hpp"
#include "calibrate/strength_tests.hpp"
#include "records/reading_fixture.hpp"
#include "study/experiment.hpp"

namespace phy::calibrate {
namespace {

Recipe rock_with(double slits) {
  Recipe rock;
  rock.matrix.model = MatrixModel::flat_joint;
  rock.matrix.E_c = 40e9, rock.matrix.sigma_c = 40e6, rock.matrix.tau_c = 120e6, rock.matrix.mu = 0.6;
  rock.matrix.unbonded_fraction = slits;
  return rock;
}

/// As a laboratory has it: E at half of UCS.
Rock table_of(const Recipe& truth) {
  Rock table;
  table.bedded = false, table.matrix = MatrixModel::flat_joint;
  table.E_is = ModulusReading::tangent_50;
  table.model.matrix.model = MatrixModel::flat_joint;
  PaperPress press;
  press.packing_scatter = press.run_scatter = press.coarse_bias = 0.0;
  const TestResult test = press.test({truth}).front();
  for (const auto& [property, name] : {std::pair{Property::E, "E_tangent"},
                                       {Property::nu, "nu"},
                                       {Property::ucs, "ucs"},
                                       {Property::crack_initiation, "sigma_ci_strain"}})
    for (const Number& n : test.numbers)
      if (n.name == name) table.readings.push_back(reading(property, 0.0, n.value));
  return table;
}

const Comparison& row_of(const Calibration& c, Property p) {
  return *std::find_if(c.verification.begin(), c.verification.end(),
                       [&](const Comparison& row) { return row.target.property == p; });
}

TEST(CrackInitiation, IsReadInTheVeryTestOfUcs) {
  const Evidence evidence(table_of(rock_with(0.2)));
  ASSERT_EQ(evidence.strengths.size(), 2U);
  EXPECT_EQ(evidence.n_tests(), 1);
  const StrengthTests tests(evidence.rock.model, evidence.strengths, std::vector<double>(2, 60e9));
  for (const Loading& loading : {search_of_strengths, as_measured}) {
    const Recipe ucs = tests.of(evidence.rock.model, 0, 7, loading),
                 sigma_ci = tests.of(evidence.rock.model, 1, 7, loading, 1e6);
    EXPECT_EQ(study::specimen_key(ucs), study::specimen_key(sigma_ci));
    EXPECT_EQ(ucs.test.approach_strain, 0.0) << "the first cracks come on the way that it would hurry over";
  }
}

TEST(CrackInitiation, SlitsMeetItAndEWithThem) {
  const Recipe truth = rock_with(0.2);
  PaperPress press;
  press.packing_scatter = press.run_scatter = 0.01;
  const Calibration c = calibrate(Evidence(table_of(truth)), {}, press);
  EXPECT_NEAR(row_of(c, Property::crack_initiation).error(), 0.0, 0.05);
  EXPECT_NEAR(row_of(c, Property::ucs).error(), 0.0, 0.05);
  EXPECT_NEAR(row_of(c, Property::E).error(), 0.0, 0.02) << "slits soften: 8 % here";
  const auto slits = std::find_if(c.parameters.begin(), c.parameters.end(),
                                  [](const ParameterEstimate& e) { return e.symbol == "slits"; });
  ASSERT_NE(slits, c.parameters.end());
  EXPECT_TRUE(slits->determined);
  EXPECT_TRUE(slits->low <= 0.2 && 0.2 <= slits->high) << slits->low << ' ' << slits->high;
  EXPECT_EQ(c.counts.tension, 0);
  EXPECT_LE(c.counts.tests, press.n_tests) << "counted once, though it answers twice";
}

// On this press nothing but slits lets cracks begin earlier.
TEST(CrackInitiation, WithoutSlitsTheVerdictNamesIt) {
  Rock table = table_of(rock_with(0.25));
  table.matrix = MatrixModel::parallel_bond;
  table.model.matrix.model = MatrixModel::parallel_bond;
  PaperPress press;
  press.packing_scatter = press.run_scatter = 0.01;
  const Calibration c = calibrate(Evidence(table), {}, press);
  EXPECT_GT(row_of(c, Property::crack_initiation).error(), 0.3);
  EXPECT_NEAR(row_of(c, Property::ucs).error(), 0.0, 0.06) << "not taken along";
  const Finding* cause = first_of(c.verdict.causes, FindingKind::initiation_ratio);
  ASSERT_NE(cause, nullptr);
  EXPECT_NEAR(cause->number("laboratory_low"), 0.475, 0.03);  // 0.85 - 1.5 x 0.25
  EXPECT_EQ(c.verdict.next.advice, Advice::slits);
}

}  // namespace
}  // namespace phy::calibrate
