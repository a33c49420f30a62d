// What a table can determine, predicted before anything runs.
#include "survey/identifiability.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/stats.hpp"
#include "records/reading_fixture.hpp"
#include "theory/goodman.hpp"

namespace phy::survey {
namespace {

using testing::Contains;
using testing::Each;
using testing::Field;

/// E and nu of a jointed rock at seven angles.
Rock layered_rock() {
  const theory::JointedRock truth{60e9, 40e9, 12e9, 0.25};
  Rock rock;
  rock.model.bedding.resize(1);
  for (const double theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
    rock.readings.push_back(reading(Property::E, theta, theory::goodman_E(truth, theta)));
    rock.readings.push_back(reading(Property::nu, theta, theory::goodman_nu(truth, theta)));
  }
  return rock;
}

ParameterEstimate expected(const Rock& rock, const std::string& key) {
  for (const ParameterEstimate& e : identifiability(Evidence(rock)))
    if (e.key == key) return e;
  ADD_FAILURE() << key << " is not in the list";
  return {};
}

TEST(Identifiability, ModuliAtSevenAnglesDetermineTheElasticParameters) {
  for (const char* key : {"matrix.E_c", "bedding[0].k_n", "bedding[0].k_s"})
    EXPECT_TRUE(expected(layered_rock(), key).determined) << key;
  EXPECT_FALSE(expected(layered_rock(), "matrix.sigma_c").determined);
}

TEST(Identifiability, ANoisierTableLeavesWiderIntervals) {
  Rock noisy = layered_rock();
  for (RockReading& r : noisy.readings) r.sd *= 4.0;
  const auto width = [](const ParameterEstimate& e) { return std::log(e.high / e.low); };
  EXPECT_GT(width(expected(noisy, "bedding[0].k_n")),
            2.0 * width(expected(layered_rock(), "bedding[0].k_n")));
}

TEST(Identifiability, TensionAcrossTheBeddingPinsTheJointsAndItsAbsenceIsSaid) {
  Rock rock = layered_rock();
  rock.readings.push_back(reading(Property::ucs, 0.0, 100e6));
  const std::vector<LabTests> across = {
      LabTests({at_angle(Property::direct_tension, 0.0), at_angle(Property::brazilian, 90.0)})};
  EXPECT_EQ(expected(rock, "sigma_n,sj/C_sj").next.tests, across);
  rock.readings.push_back(reading(Property::direct_tension, 0.0, 5e6));
  EXPECT_TRUE(expected(rock, "sigma_n,sj/C_sj").determined);
}

TEST(Identifiability, WithoutUcsNoStrengthIsDetermined) {
  Rock rock = layered_rock();
  for (const double theta : {0.0, 90.0})
    rock.readings.push_back(reading(Property::direct_tension, theta, 5e6));
  for (const ParameterEstimate& e : identifiability(Evidence(rock)))
    if (!std::isfinite(e.low)) {
      EXPECT_FALSE(e.determined) << e.key;
      EXPECT_THAT(e.next.tests,
                  Contains(Field(&LabTests::any_of, Contains(Field(&LabTest::property, Property::ucs)))))
          << e.key;
      EXPECT_EQ(e.rests_on.basis, Basis::none) << e.key;
    }
  EXPECT_NE(first_of(limits_of_table(Evidence(rock)), FindingKind::no_compression), nullptr);
}

// The fit may pin a ratio that no rule says it would: its estimate then names data that are there.
TEST(Identifiability, ParametersRestOnWhatTheTableHolds) {
  Rock rock = layered_rock();
  std::erase_if(rock.readings, [](const RockReading& r) { return r.property == Property::nu; });
  for (const double theta : {0.0, 45.0, 90.0}) rock.readings.push_back(reading(Property::ucs, theta, 100e6));
  for (const ParameterEstimate& e : identifiability(Evidence(rock)))
    for (const LabTests& tests : e.rests_on.tests)
      for (const LabTest& test : tests.any_of) {
        EXPECT_TRUE(test.property == Property::E || test.property == Property::ucs) << e.key;
        EXPECT_TRUE(holds(targets_of(rock), test)) << e.key << " rests on " << name_of(test);
      }
}

TEST(Identifiability, IntervalsLeaveOutThePackings) {
  EXPECT_NE(first_of(limits_of_table(Evidence(layered_rock())), FindingKind::packings_not_counted), nullptr);
}

TEST(Identifiability, ARockWithoutBeddingHasNoAngleInItsTests) {
  Rock rock;
  rock.bedded = false;
  rock.readings.push_back(reading(Property::ucs, 0.0, 150e6));
  EXPECT_EQ(identifiability(Evidence(rock)).size(), 5U);
  for (const ParameterEstimate& e : identifiability(Evidence(rock)))
    for (const auto& list : {e.rests_on.tests, e.next.tests})
      for (const LabTests& tests : list)
        EXPECT_THAT(tests.any_of, Each(Field(&LabTest::where, Inclination::any))) << e.key;
  EXPECT_TRUE(expected(rock, "matrix.sigma_c").determined);
  EXPECT_FALSE(expected(rock, "tau_c/sigma_c").determined);
  rock.readings.push_back(reading(Property::brazilian, 0.0, 20e6));
  EXPECT_TRUE(expected(rock, "tau_c/sigma_c").determined);
}

// Under which stress a table was not tested it need not say; that of other angles does not tell.
TEST(Identifiability, FrictionRestsOnStrengthsUnderConfinement) {
  Rock rock = layered_rock();
  const auto next = [&](const char* key) { return expected(rock, key).next.tests; };
  using Tests = std::vector<LabTests>;
  const LabTest at_ends = at_either_end(Property::confined);
  EXPECT_EQ(next("matrix.mu"), (Tests{LabTest{Property::ucs}, at_ends}));  // nothing is fitted
  rock.readings.push_back(reading(Property::ucs, 0.0, 100e6));
  EXPECT_EQ(next("matrix.mu"), Tests{at_ends});
  EXPECT_EQ(next("bedding[0].mu"), Tests{between(Property::confined, 45.0, 60.0)});
  EXPECT_EQ(next("C_sj/tau_c"), Tests{between(Property::ucs, 45.0, 60.0)});
  rock.readings.push_back(reading(Property::confined, 45.0, 120e6));
  rock.readings.back().confining = 10e6;
  EXPECT_FALSE(expected(rock, "bedding[0].mu").determined)
      << "cohesion or friction, one stress does not tell";
  const auto asked = [&](const char* key) { return next(key).at(0).any_of.at(0).stress; };
  EXPECT_EQ(asked("bedding[0].mu"), StressAsked::another);
  RockReading& ucs = *(rock.readings.end() - 2);
  ASSERT_EQ(ucs.property, Property::ucs);
  ucs.theta = 45.0;
  EXPECT_TRUE(expected(rock, "bedding[0].mu").determined);
  EXPECT_FALSE(expected(rock, "matrix.mu").determined);
  ucs.theta = rock.readings.back().theta = 90.0;
  EXPECT_EQ(asked("matrix.mu"), StressAsked::higher);  // tau_c has a share in it
  EXPECT_FALSE(expected(rock, "bedding[0].mu").determined);
  rock.bedded = false;
  EXPECT_EQ(asked("matrix.mu"), StressAsked::higher);
}

TEST(Identifiability, OfATestThatTheTableHasMoreSpecimensAreAdvised) {
  Rock rock;
  rock.model.bedding.resize(1);
  const theory::JointedRock stiff{60e9, 3000e9, 2500e9, 0.25};  // joints that E hardly feels
  for (const double theta : {0.0, 45.0, 90.0})
    rock.readings.push_back(reading(Property::E, theta, theory::goodman_E(stiff, theta)));
  const std::vector<LabTests> across = {between(Property::E, 0.0, 15.0)};
  EXPECT_EQ(expected(rock, "bedding[0].k_n").next.remedy, Remedy::more_specimens);
  EXPECT_EQ(expected(rock, "bedding[0].k_n").next.tests, across);
  EXPECT_EQ(expected(rock, "matrix.ks_over_kn").next.remedy, Remedy::test);
  EXPECT_EQ(expected(rock, "matrix.ks_over_kn").next.tests,
            std::vector<LabTests>{at_both_ends(Property::nu)});
  std::erase_if(rock.readings, [](const RockReading& r) { return r.theta == 0.0; });
  EXPECT_EQ(expected(rock, "bedding[0].k_n").next.remedy, Remedy::test);
  EXPECT_EQ(expected(rock, "bedding[0].k_n").next.tests, across);
}

TEST(Identifiability, OneTensorIsNoConflict) {
  const auto without_body = [](const Rock& rock) {
    const std::vector<Finding> limits = limits_of_table(Evidence(rock));
    return std::any_of(limits.begin(), limits.end(), [](const Finding& f) {
      return f.kind == FindingKind::no_layered_body || f.kind == FindingKind::one_cell_of_no_body;
    });
  };
  EXPECT_FALSE(without_body(layered_rock()));
  Rock exchanged = layered_rock();
  for (RockReading& r : exchanged.readings) r.theta = 90.0 - r.theta;
  EXPECT_FALSE(without_body(exchanged));
  exchanged.readings[1].value *= 0.3;
  EXPECT_TRUE(without_body(exchanged));
}

TEST(Identifiability, AssumedScatterIsReportedAsItIsTaken) {
  Rock rock;
  rock.bedded = false;
  rock.readings = {reading(Property::E, 0.0, 40e9)};
  rock.readings[0].sd = std::nan("");
  const auto assumed = [&] {
    const std::vector<Finding> limits = limits_of_table(Evidence(rock));
    return *first_of(limits, FindingKind::scatter_assumed);
  };
  EXPECT_EQ(assumed().cells.size(), 1U);
  EXPECT_NEAR(assumed().number("most"), 0.08, 1e-12);
  rock.bedded = true;
  rock.model.bedding.resize(1);
  rock.readings = {reading(Property::E, 0.0, 40e9), reading(Property::E, 0.0, 30e9),
                   reading(Property::E, 90.0, 50e9)};
  for (RockReading& r : rock.readings) r.sd = std::nan(""), r.n = 1;
  // 40 and 30 about 35 have 2/49 of squares, one degree of freedom; four of 8 %: 0.115^2
  EXPECT_EQ(assumed().cells.size(), 2U);
  EXPECT_NEAR(assumed().number("most"), 0.115, 0.005);
}

TEST(Identifiability, EAndNuOfARockWithoutBeddingDetermineItsTwoElasticParameters) {
  Rock rock;
  rock.bedded = false;
  rock.readings = {reading(Property::E, 0.0, 40e9)};
  EXPECT_TRUE(expected(rock, "matrix.E_c").determined);
  EXPECT_FALSE(expected(rock, "matrix.ks_over_kn").determined);
  // no joint shares the scatter of E: 5 % of three specimens and four degrees of freedom of 8 %; t_6 = 2.447
  const double sd = std::sqrt((2.0 * 0.05 * 0.05 + 4.0 * 0.08 * 0.08) / 6.0);
  // nor does the table tell k_s/k_n, with which E grows: log(E) by 0.22 per logarithm, nu by -0.11 of 0.15
  const double of_E = 2.447 * sd / std::sqrt(3.0), of_ratio = z_95 * 0.22 * 0.15 / 0.1102;
  EXPECT_NEAR(std::log(expected(rock, "matrix.E_c").high), std::hypot(of_E, of_ratio), 0.02);
  rock.readings.push_back(reading(Property::nu, 0.0, 0.25));
  EXPECT_LT(std::log(expected(rock, "matrix.E_c").high), 0.5 * of_ratio) << "nu tells it";
  EXPECT_TRUE(expected(rock, "matrix.ks_over_kn").determined);
}

}  // namespace
}  // namespace phy::survey
