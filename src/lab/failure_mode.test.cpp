// Specimens whose failure plane is known: bedding that is far weaker than the rock, steep under compression
// and across the pull; and the rock alone, which has none along bedding.
#include <gtest/gtest.h>

#include <cmath>

#include "lab/procedure_fixture.hpp"

namespace phy::lab {
namespace {

TestResult weak_bedding(const char* kind, double theta, double speed) {
  Recipe r = small_rock(TestKind(kind));
  r.specimen = {0.012, 0.024};
  r.packing.n_grains = 744;
  r.test.platen_speed = speed, r.test.stop_at = 0.8;
  BeddingRecipe planes;
  planes.theta = theta, planes.rule = BeddingRule::crossing, planes.spacing = 0.004;
  planes.cohesion = 8e6, planes.sigma_n = 4e6, planes.mu = 0.3;
  r.bedding = {planes};
  return run_alone(r);
}

// Joints lie within half a grain of their plane, in a specimen of twenty grains: within a degree.
TEST(FailureMode, WeakBeddingFailsAlongItself) {
  for (const double theta : {30.0, 60.0, 75.0}) {
    const TestResult r = weak_bedding("uniaxial", theta, 0.05);
    EXPECT_NEAR(number(r, "failure_angle").value, theta, 1.0);
    EXPECT_LT(number(r, "failure_angle_error").value, 1.0) << theta;
    EXPECT_GT(number(r, "bedding_share").value, 0.9) << theta;
  }
}

TEST(FailureMode, TensionAcrossBeddingFailsAlongIt) {
  const TestResult r = weak_bedding("direct_tension", 0.0, 0.01);
  EXPECT_NEAR(number(r, "failure_angle").value, 0.0, 2.0) << "one or two planes of eighteen grains";
  EXPECT_EQ(number(r, "bedding_share").value, 1.0);
}

TEST(FailureMode, TensionAlongBeddingFailsAcrossIt) {
  const TestResult r = weak_bedding("direct_tension", 90.0, 0.01);
  EXPECT_LT(number(r, "bedding_share").value, 0.5);
  EXPECT_LT(std::fabs(number(r, "failure_angle").value), 45.0) << "nearer to across the pull than along it";
}

TEST(FailureMode, RockWithoutBeddingHasNoShareOfIt) {
  const TestResult r = run_alone(small_rock(TestKind("uniaxial")));
  EXPECT_TRUE(std::isnan(number(r, "bedding_share").value));
  EXPECT_EQ(number(r, "bedding_share").note, "no bedding planes");
}

}  // namespace
}  // namespace phy::lab
