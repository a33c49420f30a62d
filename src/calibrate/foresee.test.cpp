// What a table can determine, foretold before anything runs.
#include "calibrate/foresee.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "calibrate/reading.test.hpp"
#include "theory/goodman.hpp"

namespace phy {
namespace {

/// E and nu of a jointed rock at seven angles.
Rock layered_rock() {
  const JointedRock truth{60e9, 40e9, 12e9, 0.25};
  Rock rock;
  rock.model.bedding.resize(1);
  for (const double theta : {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0}) {
    rock.readings.push_back(reading(Property::E, theta, goodman_E(truth, theta)));
    rock.readings.push_back(reading(Property::nu, theta, goodman_nu(truth, theta)));
  }
  return rock;
}

ParameterEstimate foreseen(const Rock& rock, const std::string& key) {
  for (const ParameterEstimate& e : foresee(rock))
    if (e.key == key) return e;
  ADD_FAILURE() << key << " is not foreseen";
  return {};
}

TEST(Foresee, ModuliAtSevenAnglesDetermineTheElasticParameters) {
  for (const char* key : {"matrix.E_c", "bedding[0].k_n", "bedding[0].k_s"})
    EXPECT_TRUE(foreseen(layered_rock(), key).determined) << key;
  EXPECT_FALSE(foreseen(layered_rock(), "matrix.sigma_c").determined);
}

TEST(Foresee, ANoisierTableLeavesWiderIntervals) {
  Rock noisy = layered_rock();
  for (RockReading& r : noisy.readings) r.sd *= 4.0;
  const auto width = [](const ParameterEstimate& e) { return std::log(e.high / e.low); };
  EXPECT_GT(width(foreseen(noisy, "bedding[0].k_n")),
            2.0 * width(foreseen(layered_rock(), "bedding[0].k_n")));
}

TEST(Foresee, TensionAcrossTheBeddingPinsTheJointsAndItsAbsenceIsSaid) {
  Rock rock = layered_rock();
  rock.readings.push_back(reading(Property::ucs, 0.0, 100e6));
  EXPECT_THAT(foreseen(rock, "sigma_n,sj/C_sj").next_test, testing::HasSubstr("direct tension at 0"));
  rock.readings.push_back(reading(Property::direct_tension, 0.0, 5e6));
  EXPECT_TRUE(foreseen(rock, "sigma_n,sj/C_sj").determined);
}

TEST(Foresee, WithoutUcsNoStrengthIsDetermined) {
  Rock rock = layered_rock();
  for (const double theta : {0.0, 90.0})
    rock.readings.push_back(reading(Property::direct_tension, theta, 5e6));
  for (const ParameterEstimate& e : foresee(rock))
    if (!std::isfinite(e.low)) {
      EXPECT_FALSE(e.determined) << e.key;
      EXPECT_THAT(e.next_test, testing::HasSubstr("UCS")) << e.key;
      EXPECT_EQ(e.rests_on, "") << e.key;
    }
  EXPECT_THAT(advice(rock), testing::Contains(testing::HasSubstr("no strength is fitted")));
}

// The fit may pin a ratio that no rule says it would: its estimate then names data that are there.
TEST(Foresee, ParametersRestOnWhatTheTableHolds) {
  Rock rock = layered_rock();
  std::erase_if(rock.readings, [](const RockReading& r) { return r.property == Property::nu; });
  for (const double theta : {0.0, 45.0, 90.0}) rock.readings.push_back(reading(Property::ucs, theta, 100e6));
  for (const ParameterEstimate& e : foresee(rock))
    EXPECT_THAT(e.rests_on, testing::AnyOf("E", testing::StartsWith("UCS near"),
                                           testing::StartsWith("UCS between"), "UCS"))
        << e.key;
}

TEST(Foresee, IntervalsAreSaidToLeaveOutThePackings) {
  EXPECT_THAT(advice(layered_rock()),
              testing::Contains(testing::HasSubstr("what packings of the model differ by")));
}

TEST(Foresee, ARockWithoutBeddingIsToldOfNoAngle) {
  Rock rock;
  rock.bedded = false;
  rock.readings.push_back(reading(Property::ucs, 0.0, 150e6));
  EXPECT_EQ(foresee(rock).size(), 5U);
  for (const ParameterEstimate& e : foresee(rock))
    for (const std::string& text : {e.rests_on, e.next_test})
      EXPECT_THAT(text, testing::Not(testing::HasSubstr("degrees"))) << e.key;
  EXPECT_TRUE(foreseen(rock, "matrix.sigma_c").determined);
  EXPECT_FALSE(foreseen(rock, "tau_c/sigma_c").determined);
  rock.readings.push_back(reading(Property::brazilian, 0.0, 20e6));
  EXPECT_TRUE(foreseen(rock, "tau_c/sigma_c").determined);
}

TEST(Foresee, EAndNuOfARockWithoutBeddingDetermineItsTwoElasticParameters) {
  Rock rock;
  rock.bedded = false;
  rock.readings = {reading(Property::E, 0.0, 40e9)};
  EXPECT_TRUE(foreseen(rock, "matrix.E_c").determined);
  EXPECT_FALSE(foreseen(rock, "matrix.ks_over_kn").determined);
  // no joint shares the scatter of E: 5 % of three specimens
  EXPECT_NEAR(std::log(foreseen(rock, "matrix.E_c").high), 1.96 * 0.05 / std::sqrt(3.0), 1e-3);
  rock.readings.push_back(reading(Property::nu, 0.0, 0.25));
  EXPECT_TRUE(foreseen(rock, "matrix.ks_over_kn").determined);
}

}  // namespace
}  // namespace phy
