// Is a packing what its recipe says: size, grading, balance, stress, the same bits every time?
#include "genesis/packing.hpp"
#include "base/recorded_fixture.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "genesis/near_pairs.hpp"

namespace phy::genesis {
namespace {

Recipe small(std::int64_t seed) {
  Recipe r;
  r.specimen = {0.010, 0.012};
  r.packing.n_grains = 320;
  r.packing.seed = seed;
  return r;
}

Packing make(const Recipe& r) { return make_packing(r.specimen, r.packing, r.matrix); }

struct Balance {
  double unbalanced = 0.0;   // mean over discs / mean over contacts
  double wall_stress = 0.0;  // mean of sigma_xx and sigma_yy, from the forces on the walls / E_c
};

/// Forces summed again by a double loop, springs of stiffness 1, walls 2.
Balance balance(const Packing& p) {
  std::vector<Vec2> force(p.discs.size());
  double sum = 0.0, side = 0.0, ends = 0.0;
  int n = 0;
  const auto add = [&](double overlap, double k, double& total) {
    if (overlap <= 0.0) return 0.0;
    ++n;
    sum += k * overlap;
    total += k * overlap;
    return k * overlap;
  };
  double inside = 0.0;
  for (std::size_t i = 0; i < p.discs.size(); ++i) {
    const Disc& d = p.discs[i];
    force[i].x += add(d.r - d.x, 2.0, side) - add(d.x + d.r - p.width, 2.0, side);
    force[i].y += add(d.r - d.y, 2.0, ends) - add(d.y + d.r - p.height, 2.0, ends);
    for (std::size_t j = i + 1; j < p.discs.size(); ++j) {
      const Vec2 branch{p.discs[j].x - d.x, p.discs[j].y - d.y};
      const double f = add(-gap(d, p.discs[j]), 1.0, inside);
      force[i] = force[i] - (f / norm(branch)) * branch;
      force[j] = force[j] + (f / norm(branch)) * branch;
    }
  }
  double residual = 0.0;
  for (const Vec2& f : force) residual += norm(f);
  return {residual / static_cast<double>(force.size()) / (sum / n),
          0.25 * (side / p.height + ends / p.width)};
}

TEST(Packing, SameSeedSameBitsOtherSeedOthers) {
  const Packing a = make(small(1)), b = make(small(1)), c = make(small(2));
  EXPECT_EQ(a.hash, b.hash);
  EXPECT_NE(a.hash, c.hash);
  EXPECT_EQ(a.hash, packing_hash(a.discs));
}

TEST(Packing, BitsDoNotDependOnTheMachine) {
  expect_recorded("packing/small", make(small(1)).hash);  // g++ and clang++, with and without optimisation
}

TEST(Packing, IsInEquilibriumInsideItsBox) {
  const Packing p = make(small(3));
  const Balance b = balance(p);
  EXPECT_LE(p.report.unbalanced, 1e-6);
  EXPECT_NEAR(b.unbalanced, p.report.unbalanced, 1e-3 * p.report.unbalanced);
  EXPECT_TRUE(p.stress_free);
  EXPECT_EQ(p.report.stress_left, 0.0);
  for (const Disc& d : p.discs) {
    EXPECT_TRUE(d.x > 0.75 * d.r && d.x < p.width - 0.75 * d.r);
    EXPECT_TRUE(d.y > 0.75 * d.r && d.y < p.height - 0.75 * d.r);
  }
}

TEST(Packing, RadiiFollowTheirDistribution) {
  Recipe r = small(4);
  r.specimen = {0.016, 0.018};
  r.packing.n_grains = 800;
  const auto share_below_middle = [&](RadiusDistribution distribution) {
    r.packing.distribution = distribution;
    int below = 0;
    for (const Disc& d : make(r).discs) {
      EXPECT_GE(d.r, 0.00025);
      EXPECT_LE(d.r, 0.000415);
      if (d.r < 0.0003325) ++below;
    }
    return below / 800.0;
  };
  // F(middle) = 0.5 by number, (1/min - 1/mid)/(1/min - 1/max) = 0.6241 by area; 3 standard errors.
  EXPECT_NEAR(share_below_middle(RadiusDistribution::by_number), 0.5, 0.053);
  EXPECT_NEAR(share_below_middle(RadiusDistribution::by_area), 0.6241, 0.052);
}

TEST(Packing, NumberFollowsFromPorosity) {
  Recipe r = small(5);
  r.packing.n_grains = 0;
  r.packing.porosity = 0.09;
  const Packing p = make(r);
  // Half of the largest disc is the most that the porosity can miss.
  EXPECT_NEAR(p.report.porosity, 0.09, 0.5 * pi * 0.000415 * 0.000415 / (0.010 * 0.012) + 1e-12);
}

TEST(Packing, IsotropicStressIsReached) {
  Recipe r = small(6);
  r.packing.distribution = RadiusDistribution::by_area;
  r.packing.n_grains = 0;
  r.packing.porosity = 0.156;
  r.packing.initial_stress = InitialStress::isotropic;
  r.packing.isotropic_stress = 2e6;
  const Packing p = make(r);
  EXPECT_FALSE(p.stress_free);
  EXPECT_NEAR(p.report.stress_left, 2e6, 0.0101 * 2e6);
  const Balance b = balance(p);
  EXPECT_LE(b.unbalanced, 1.01e-6);
  EXPECT_NEAR(b.wall_stress * r.matrix.E_c, p.report.stress_left, 1e-4 * 2e6);
  EXPECT_GT(p.report.coordination, 3.5);
  EXPECT_LT(p.report.coordination, 4.1);
}

TEST(Packing, PaperSpecimen) {
  const Recipe r;
  const Packing p = make(r);
  EXPECT_EQ(p.discs.size(), 7481U);
  EXPECT_NEAR(p.report.porosity, 0.082, 0.006);
  EXPECT_NEAR(p.report.coordination, 4.96, 0.05);
  EXPECT_LE(p.report.unbalanced, 1e-6);
  EXPECT_LE(p.report.n_rattlers, 5);
  EXPECT_NEAR(p.report.fabric, 0.0, 0.01);
  EXPECT_NEAR(p.report.mean_overlap, 0.06, 0.01);
}

TEST(Packing, RefusesWhatCannotBeMade) {
  Recipe r = small(1);
  r.packing.radius_max = 0.0051;  // larger than half the specimen
  EXPECT_THROW(make(r), InputError);
  r = small(1);
  r.packing.n_grains = 0;
  EXPECT_THROW(make(r), InputError);
  r.packing.porosity = 0.9999;  // no room for two discs
  EXPECT_THROW(make(r), InputError);
  r = small(1);
  r.packing.initial_stress = InitialStress::isotropic;
  try {
    make(r);
    FAIL() << "an isotropic packing without a stress";
  } catch (const InputError& e) {
    ASSERT_EQ(e.problems().size(), 1U);
    EXPECT_EQ(e.problems()[0].key, "packing.isotropic_stress");
  }
}

TEST(Packing, AdoptsDiscsAsTheyAre) {
  const Packing made = make(small(7));
  const Recipe r = small(7);
  const Packing adopted = adopt_packing(r.specimen, r.packing, r.matrix, made.discs);
  EXPECT_EQ(adopted.hash, made.hash);
  EXPECT_DOUBLE_EQ(adopted.report.coordination, made.report.coordination);
  EXPECT_THROW(adopt_packing(r.specimen, r.packing, r.matrix, {}), InputError);
  EXPECT_THROW(adopt_packing(r.specimen, r.packing, r.matrix, {{0.001, 0.001, 0.0003}, {1.0, 1.0, 0.3}}),
               InputError);  // millimetres read as metres
  for (const double radius : {0.0, 1e-12, 1e-150, 0.5 * r.specimen.width, 1e300})
    EXPECT_THROW(
        adopt_packing(r.specimen, r.packing, r.matrix, {{0.001, 0.001, 0.0003}, {0.002, 0.001, radius}}),
        InputError);
}

}  // namespace
}  // namespace phy::genesis
