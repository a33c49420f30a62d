// Hand calculations for a bond between discs of 1 mm and 2 mm radius, lambda = 1, E_b = 30 GPa, ks/kn = 0.5:
//   R_bar = 1 mm, A = 2e-3 m2/m, I = (2/3)e-9 m4/m, L = 3 mm, kb_n = 1e13 Pa/m
//   k_n = 2e10 N/m per m, k_s = 1e10, k_m = 1e13 * (2/3)e-9 = 6666.7 N, arm = 3/R_bar = 3000/m
//   sigma_c = 10 MPa: capacity 20 kN/m; tau_c = 15 MPa: S_0 = 30 kN/m
#include "laws/parallel_bond/parallel_bond.hpp"

#include <gtest/gtest.h>

namespace phy::laws {
namespace {

parallel_bond::Parameters<double> cement(double tan_phi = 0.0) {
  return {2e10, 1e10, 2e4 / 3.0, 3000.0, 30e3, tan_phi, 0.0};
}

TEST(ParallelBond, GeometryOfTheSmallerDisc) {
  const auto g = parallel_bond::geometry(1.0, 1e-3, 2e-3);
  EXPECT_DOUBLE_EQ(g.R_bar, 1e-3);
  EXPECT_DOUBLE_EQ(g.A, 2e-3);
  EXPECT_DOUBLE_EQ(g.I, 2e-9 / 3.0);
  EXPECT_DOUBLE_EQ(g.L, 3e-3);
  EXPECT_DOUBLE_EQ(parallel_bond::geometry(0.5, 2e-3, 1e-3).A, 1e-3);
}

TEST(ParallelBond, CarriesTensionShearAndBending) {
  parallel_bond::State<double> s{0.0, 20e3};
  const auto r = parallel_bond::respond(cement(), s, {-5e-7, -5e-7, 1e-6, 3e-4});
  EXPECT_DOUBLE_EQ(r.F_n, -10e3);
  EXPECT_DOUBLE_EQ(r.F_s, -10e3);
  EXPECT_DOUBLE_EQ(r.M, -2.0);
  EXPECT_FALSE(broke(r)) << "tension 10 kN/m and arm |M| = 6 kN/m are below 20 kN/m";
}

TEST(ParallelBond, BreaksInTensionAtItsCapacity) {
  parallel_bond::State<double> s{0.0, 20e3};
  EXPECT_FALSE(broke(parallel_bond::respond(cement(), s, {-0.99e-6, 0.0, 0.0, 0.0})));
  const auto r = parallel_bond::respond(cement(), s, {-1.01e-6, 0.0, 0.0, 0.0});
  EXPECT_TRUE(r.broke_tension);
  EXPECT_EQ(r.F_n, 0.0);
  EXPECT_EQ(s.capacity, 0.0);
  EXPECT_NEAR(r.released, 20.2e3 * 20.2e3 / (2 * 2e10), 1e-12);
}

TEST(ParallelBond, BendingAddsToTension) {
  // arm |M| = 3000 * k_m theta = 2e7 theta: 10 kN/m at 5e-4 rad; with 10 kN/m of tension that is the capacity
  parallel_bond::State<double> s{0.0, 20e3};
  EXPECT_FALSE(broke(parallel_bond::respond(cement(), s, {-5e-7, 0.0, 0.0, 4.99e-4})));
  EXPECT_TRUE(parallel_bond::respond(cement(), s, {-5e-7, 0.0, 0.0, 5.01e-4}).broke_tension);
}

TEST(ParallelBond, CompressionHoldsBendingBack) {
  parallel_bond::State<double> s{0.0, 20e3};  // 40 kN/m from bending, 30 of them pressed shut
  EXPECT_FALSE(broke(parallel_bond::respond(cement(), s, {1.5e-6, 0.0, 0.0, 2e-3})));
}

TEST(ParallelBond, BreaksInShearAtCohesionPlusFriction) {
  for (const double tan_phi : {0.0, 0.5}) {
    parallel_bond::State<double> s{0.0, 20e3};
    const double limit = 30e3 + tan_phi * 40e3;  // F_n = 2e10 * 2e-6
    EXPECT_FALSE(broke(parallel_bond::respond(cement(tan_phi), s, {2e-6, 0.0, 0.999 * limit / 1e10, 0.0})));
    EXPECT_TRUE(
        parallel_bond::respond(cement(tan_phi), s, {2e-6, 0.0, 0.002 * limit / 1e10, 0.0}).broke_shear);
    EXPECT_EQ(parallel_bond::respond(cement(tan_phi), s, {2e-6, 0.0, 1e-6, 0.0}).F_s, 0.0);
  }
}

TEST(ParallelBond, HeldBondsDoNotBreak) {
  auto p = cement();
  p.extra_strength = 1e30;
  parallel_bond::State<double> s{0.0, 20e3};
  EXPECT_FALSE(broke(parallel_bond::respond(p, s, {-1e-5, 0.0, 1e-5, 1e-2})));
}

}  // namespace
}  // namespace phy::laws
