// Do settled discs balance, with the forces that a hand calculation gives?
#include "genesis/settle.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "genesis/rattlers.hpp"

namespace phy::genesis {
namespace {

TEST(Settle, TwoDiscsBetweenWallsAreSpringsInSeries) {
  // wall 2, pair 1, wall 2: an overlap of 0.1 in all is a force of 0.1/(1/2 + 1 + 1/2) = 0.05.
  std::vector<Disc> discs = {{0.9, 1.0, 1.0}, {2.95, 1.0, 1.0}};
  const Equilibrium e = settle({3.9, 2.0}, discs, 1e-12, 1e-15, 10000);
  EXPECT_LE(e.unbalanced, 1e-12);
  EXPECT_NEAR(1.0 - discs[0].x, 0.025, 1e-12);
  EXPECT_NEAR(discs[1].x - discs[0].x, 1.95, 1e-12);
  EXPECT_NEAR(e.mean_overlap, 0.05, 1e-12);
  EXPECT_NEAR(e.pressure, 0.5 * 0.05 / 2.0, 1e-12);  // sigma_xx = F/height, sigma_yy = 0
  EXPECT_NEAR(e.stiffness, 2.0 + 4.0 + 2.0, 1e-12);
  EXPECT_EQ(e.n_contacts, 1);
}

TEST(Settle, Pfc5SpringDependsOnTheRadii) {
  // k = 2 r_min/(R1 + R2) = 2/3; an overlap of 0.1 is a force of 0.1/(1/2 + 3/2 + 1/2) = 0.04.
  std::vector<Disc> discs = {{1.0, 2.0, 1.0}, {3.95, 2.0, 2.0}};
  settle({5.9, 4.0, StiffnessConvention::pfc5}, discs, 1e-12, 1e-15, 10000);
  EXPECT_NEAR(3.0 - (discs[1].x - discs[0].x), 0.06, 1e-11);
}

TEST(Settle, TooFewDiscsAreLoose) {
  std::vector<Disc> discs = {{1.0, 1.0, 1.0}, {2.0, 1.2, 1.0}};
  const Equilibrium e = settle({20.0, 20.0}, discs, 0.0, 1e-9, 100000);
  EXPECT_TRUE(e.loose);
  EXPECT_LT(e.pressure, 1e-9);
}

TEST(Settle, NoIterationsOnlyMeasure) {
  std::vector<Disc> discs = {{1.0, 1.0, 1.0}, {2.9, 1.0, 1.0}};
  const Equilibrium e = settle({3.9, 2.0}, discs, 0.0, 0.0, 0);
  EXPECT_EQ(discs[1].x, 2.9);
  EXPECT_NEAR(e.mean_overlap, 0.1, 1e-15);
  EXPECT_GT(e.unbalanced, 0.5);
}

TEST(RadiusChange, IsExactForTheHexagonalLattice) {
  // Just touching, R = 1: three contacts of length 2 per disc and per area 2 sqrt 3.
  const double volume = 2.0 * std::sqrt(3.0), K = 7.0, target = 0.3;
  const double alpha = radius_change(volume, target, 3.0 * K * 4.0);
  const double overlap = 2.0 * (1.0 + alpha) - 2.0;
  const double stress = 3.0 * K * overlap * 2.0 / (2.0 * volume);  // sum(f d)/(D V)
  EXPECT_NEAR(stress, target, 1e-14);
}

/// Five by five discs of radius 1 that overlap by 2e-3, the central one replaced by a smaller one.
std::vector<Disc> lattice_with_rattler(double r) {
  std::vector<Disc> discs;
  for (int i = 0; i < 25; ++i) discs.push_back({0.999 + 1.998 * (i % 5), 0.999 + 1.998 * (i / 5), 1.0});
  discs[12].r = r;
  return discs;
}

TEST(Rattlers, AreGrownUntilTheyTouch) {
  const SettleBox box{9.99, 9.99};
  std::vector<Disc> discs = lattice_with_rattler(0.9);
  const std::vector<Disc> before = discs;
  EXPECT_EQ(find_rattlers(box, discs), std::vector<std::uint32_t>{12});
  EXPECT_EQ(grow_rattlers(box, discs, 1e-3), 1);
  EXPECT_TRUE(find_rattlers(box, discs).empty());
  EXPECT_NEAR(discs[12].r, 1.0, 5e-3);
  for (std::size_t i = 0; i < discs.size(); ++i) EXPECT_EQ(discs[i].r, i == 12 ? discs[12].r : before[i].r);
}

TEST(Rattlers, InTooLargeACageStayAsTheyWere) {
  const SettleBox box{9.99, 9.99};
  std::vector<Disc> discs = lattice_with_rattler(0.7);
  EXPECT_EQ(grow_rattlers(box, discs, 1e-3), 0);
  EXPECT_EQ(discs[12].r, 0.7);
  EXPECT_EQ(find_rattlers(box, discs).size(), 1U);
}

}  // namespace
}  // namespace phy::genesis
