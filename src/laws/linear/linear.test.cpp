// Hand calculations: k_n = 40 GN/m per m, k_s = 10 GN/m per m, mu = 0.5.
#include "laws/linear/linear.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "laws/linear/dashpot.hpp"

namespace phy::laws {
namespace {

linear::Parameters<double> springs() { return {40e9, 10e9, 1.0 / 10e9, 0.5}; }

TEST(Linear, PushesAndNeverPulls) {
  linear::State<double> s{0.0};
  EXPECT_DOUBLE_EQ(linear::respond(springs(), s, {2e-6, 2e-6, 0.0, 0.0}).F_n, 80e3);  // 40e9 * 2e-6
  EXPECT_EQ(linear::respond(springs(), s, {-1e-6, -3e-6, 0.0, 0.0}).F_n, 0.0);
}

TEST(Linear, SticksThenSlipsAtMuTimesTheNormalForce) {
  linear::State<double> s{0.0};
  const double closure = 2e-6;  // F_n = 80 kN/m, so the limit is 40 kN/m, reached after 4 um
  auto r = linear::respond(springs(), s, {closure, closure, 3e-6, 0.0});
  EXPECT_DOUBLE_EQ(r.F_s, -30e3);  // against the slide of grain 2
  EXPECT_NEAR(r.dissipated, 0.0, 1e-18);
  r = linear::respond(springs(), s, {closure, 0.0, 3e-6, 0.0});
  EXPECT_DOUBLE_EQ(r.F_s, -40e3);
  // 1 um sticks, 2 um slip. The law charges the slip at the mean force of the step: 35 kN/m * 2 um.
  EXPECT_NEAR(r.dissipated, 0.07, 1e-15);
  r = linear::respond(springs(), s, {closure, 0.0, -1e-6, 0.0});
  EXPECT_DOUBLE_EQ(r.F_s, -30e3);  // unloads along the spring
}

TEST(Linear, ForgetsItsShearForceWhenItOpens) {
  linear::State<double> s{0.0};
  linear::respond(springs(), s, {2e-6, 2e-6, 3e-6, 0.0});
  linear::respond(springs(), s, {-1e-6, -3e-6, 0.0, 0.0});
  EXPECT_EQ(linear::respond(springs(), s, {2e-6, 3e-6, 0.0, 0.0}).F_s, 0.0);
}

TEST(Linear, HoldsHalfForceSquaredOverStiffness) {
  // (80e3)^2 / (2 * 40e9) + (30e3)^2 / (2 * 10e9) = 0.08 + 0.045
  EXPECT_NEAR(linear::strain_energy(springs(), 80e3, -30e3), 0.125, 1e-15);
}

TEST(Linear, StiffnessConventionsAgreeForEqualRadii) {
  EXPECT_EQ(linear::stiffness_factor(false, 1.0, 3.0), 1.0);
  EXPECT_EQ(linear::stiffness_factor(true, 2.0, 2.0), 1.0);
  EXPECT_EQ(linear::stiffness_factor(true, 1.0, 3.0), 0.5);
}

dashpot::Parameters<double> with_dashpots(int mode) { return {springs(), 2e3, 1e3, 1e6, mode}; }

// Speed = increment * 1e6 steps per second: closing 1e-7 m per step is 0.1 m/s, so 2e3 * 0.1 = 200 N/m.
TEST(Dashpot, AddsItsForceToTheSpring) {
  dashpot::State<double> s{0.0};
  const auto r = dashpot::respond(with_dashpots(0), s, {1e-6, 1e-7, 2e-7, 0.0});
  EXPECT_DOUBLE_EQ(r.F_n, 40e3 + 200.0);
  EXPECT_DOUBLE_EQ(r.F_s, -(2e3 + 200.0));                // 10e9 * 2e-7 and 1e3 * 0.2
  EXPECT_NEAR(r.dissipated, 200e-7 + 200 * 2e-7, 1e-18);  // force * way
  EXPECT_EQ(s.F_s, -2e3) << "the spring must not remember the dashpot";
}

TEST(Dashpot, DoesNothingWithoutContact) {
  dashpot::State<double> s{0.0};
  const auto r = dashpot::respond(with_dashpots(0), s, {-1e-6, 1e-7, 2e-7, 0.0});
  EXPECT_EQ(r.F_n, 0.0);
  EXPECT_EQ(r.F_s, 0.0);
}

TEST(Dashpot, PullsOnlyInTheFullMode) {
  for (const int mode : {0, 1, 2, 3}) {  // spring 40 N/m, dashpot -200 N/m
    dashpot::State<double> s{0.0};
    const auto r = dashpot::respond(with_dashpots(mode), s, {1e-9, -1e-7, 0.0, 0.0});
    EXPECT_NEAR(r.F_n, mode == 0 || mode == 2 ? -160.0 : 0.0, 1e-10) << mode;
  }
}

TEST(Dashpot, ShearPartIsCutWhileSlipping) {
  for (const int mode : {0, 1, 2, 3}) {  // spring limit 0.5 * 40 N/m = 20 N/m, trial 2 kN/m
    dashpot::State<double> s{0.0};
    const auto r = dashpot::respond(with_dashpots(mode), s, {1e-9, 0.0, 2e-7, 0.0});
    EXPECT_NEAR(r.F_s, mode < 2 ? -220.0 : -20.0, 1e-9) << mode;
  }
}

TEST(Dashpot, CriticalDampingOfTwoGrains) {
  // two discs of 2 kg/m: m_c = 1 kg/m; k = 4e6: c = 2 sqrt(4e6) = 4000
  EXPECT_DOUBLE_EQ(dashpot::coefficient(1.0, 1.0, 4e6), 4000.0);
  EXPECT_DOUBLE_EQ(dashpot::coefficient(0.25, 1.0, 4e6), 1000.0);
}

}  // namespace
}  // namespace phy::laws
