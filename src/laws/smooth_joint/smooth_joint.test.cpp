// Hand calculations: k_n = 4e9, k_s = 1e9 N/m per m, mu = 0.5, cohesion 10 kN/m, tension 8 kN/m.
#include "laws/smooth_joint/smooth_joint.hpp"

#include <gtest/gtest.h>

namespace phy::laws {
namespace {

smooth_joint::Parameters<double> plane(double tan_phi = 0.0, double tan_psi = 0.0) {
  return {4e9, 1e9, 0.5, 10e3, tan_phi, tan_psi, 0.0};
}
Motion<double> move(double closure, double slide) { return {0.0, closure, slide, 0.0}; }

TEST(SmoothJoint, BondedIsElasticBothWays) {
  smooth_joint::State<double> s{0.0, 0.0, 8e3, 0.0};
  auto r = smooth_joint::respond(plane(), s, move(1e-6, 2e-6));
  EXPECT_DOUBLE_EQ(r.F_n, 4e3);
  EXPECT_DOUBLE_EQ(r.F_s, -2e3);
  EXPECT_EQ(r.M, 0.0);
  r = smooth_joint::respond(plane(), s, move(-2e-6, 0.0));
  EXPECT_DOUBLE_EQ(r.F_n, -4e3);
}

TEST(SmoothJoint, BreaksInTensionAndClosesAgainWhereItOpened) {
  smooth_joint::State<double> s{0.0, 0.0, 8e3, 0.0};
  EXPECT_FALSE(broke(smooth_joint::respond(plane(), s, move(-1.9e-6, 0.0))));
  const auto r = smooth_joint::respond(plane(), s, move(-0.2e-6, 0.0));  // 8.4 kN/m
  EXPECT_TRUE(r.broke_tension);
  EXPECT_EQ(r.F_n, 0.0);
  EXPECT_NEAR(r.released, 8.4e3 * 8.4e3 / (2 * 4e9), 1e-12);
  smooth_joint::respond(plane(), s, move(-7.9e-6, 0.0));  // 10 um open
  EXPECT_EQ(smooth_joint::respond(plane(), s, move(9.9e-6, 0.0)).F_n, 0.0);
  EXPECT_NEAR(smooth_joint::respond(plane(), s, move(0.6e-6, 0.0)).F_n, 4e9 * 0.5e-6, 1e-6);
}

TEST(SmoothJoint, BreaksInShearAndKeepsFriction) {
  smooth_joint::State<double> s{0.0, 1e-6, 8e3, 0.0};  // F_n = 4 kN/m
  EXPECT_FALSE(broke(smooth_joint::respond(plane(0.25), s, move(0.0, 10.9e-6))));
  const auto r = smooth_joint::respond(plane(0.25), s, move(0.0, 0.2e-6));  // 10 + 0.25 * 4 = 11 kN/m
  EXPECT_TRUE(r.broke_shear);
  EXPECT_DOUBLE_EQ(r.F_n, 4e3);
  EXPECT_DOUBLE_EQ(r.F_s, -2e3);
  EXPECT_NEAR(r.released, (11.1e3 * 11.1e3 - 2e3 * 2e3) / (2 * 1e9), 1e-9);
}

TEST(SmoothJoint, SlipWithDilationAtFixedClosure) {
  // F_n = 4 kN/m, limit 2 kN/m. Slide 4 um: trial 4 kN/m, excess 2 kN/m. With tan psi = 0.25:
  // (k_n/k_s) tan psi = 1, e = 2/(1 + 0.5 * 1) = 4/3 kN/m, F_n = 4 + 4/3, F_s = 0.5 F_n, opening e tan
  // psi/k_s
  smooth_joint::State<double> s{0.0, 1e-6, 0.0, 0.0};
  const auto r = smooth_joint::respond(plane(0.0, 0.25), s, move(0.0, 4e-6));
  EXPECT_NEAR(r.F_n, 16e3 / 3.0, 1e-9);
  EXPECT_NEAR(r.F_s, -8e3 / 3.0, 1e-9);
  EXPECT_NEAR(s.dilation, 1e-6 / 3.0, 1e-18);
}

TEST(SmoothJoint, SlidesOnlyWhileClosed) {
  // 1 um open, closes by 2 um while it slides 1 um: half of the slide counts. F_n = 4 kN/m, F_s = -0.5 kN/m
  smooth_joint::State<double> s{0.0, -1e-6, 0.0, 0.0};
  const auto r = smooth_joint::respond(plane(), s, move(2e-6, 1e-6));
  EXPECT_DOUBLE_EQ(r.F_n, 4e3);
  EXPECT_NEAR(r.F_s, -500.0, 1e-9);
}

TEST(SmoothJoint, AreaOfTheSmallerDisc) { EXPECT_DOUBLE_EQ(smooth_joint::area(0.5, 3e-3, 1e-3), 1e-3); }

}  // namespace
}  // namespace phy::laws
