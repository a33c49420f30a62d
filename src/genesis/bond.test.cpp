// Are the right pairs bonded, and do their strengths have the stated distribution, whatever the order?
#include "genesis/bond.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace phy::genesis {
namespace {

constexpr std::uint32_t n_draws = 20000;

struct Moments {
  double mean = 0.0, sd = 0.0;
};

Moments sample(double mean, double sd, Stream stream) {
  double sum = 0.0, sum2 = 0.0;
  for (std::uint32_t i = 0; i < n_draws; ++i) {
    const double s = draw_strength(mean, sd, {11, stream, i, i + 1 + i % 7});
    EXPECT_LE(std::abs(s - mean), 3.0 * sd);
    sum += s;
    sum2 += (s - mean) * (s - mean);
  }
  const double m = sum / n_draws;
  return {m, std::sqrt(sum2 / n_draws - (m - mean) * (m - mean))};
}

TEST(Strength, HasMeanAndDeviationOfTheTruncatedNormal) {
  // SD of a normal cut at 3 SD: sqrt(1 - 2 * 3 * phi(3)/(2 Phi(3) - 1)) = 0.98658.
  const double bound = 3.0 * 6.5e6 / std::sqrt(static_cast<double>(n_draws));
  for (const Stream stream : {Stream::bond_tension, Stream::bond_shear}) {
    const Moments m = sample(65e6, 6.5e6, stream);
    EXPECT_NEAR(m.mean, 65e6, bound);
    EXPECT_NEAR(m.sd, 0.98658 * 6.5e6, bound / std::sqrt(2.0));
  }
}

TEST(Strength, WithoutScatterIsTheMeanExactly) {
  EXPECT_EQ(draw_strength(0.1, 0.0, {1, Stream::bond_shear, 3, 4}), 0.1);
}

TEST(Strength, IsNeverZeroOrNegative) {
  for (std::uint32_t i = 0; i < n_draws; ++i)
    EXPECT_GT(draw_strength(1.0, 1.0, {5, Stream::bond_tension, i, i + 1}), 0.0);
}

TEST(Strength, IsKeyedByThePairAloneAndTheSeed) {
  const auto draw = [](std::int64_t seed, Stream s, std::uint32_t a, std::uint32_t b) {
    return draw_strength(65e6, 6.5e6, {seed, s, a, b});
  };
  const double s = draw(1, Stream::bond_tension, 3, 9);
  EXPECT_EQ(s, draw(1, Stream::bond_tension, 9, 3));
  EXPECT_NE(s, draw(2, Stream::bond_tension, 3, 9));
  EXPECT_NE(s, draw(1, Stream::bond_shear, 3, 9));
  EXPECT_NE(s, draw(1, Stream::bond_tension, 3, 10));
}

TEST(Strength, TensionAndShearAreUncorrelated) {
  double sum = 0.0;
  for (std::uint32_t i = 0; i < n_draws; ++i)
    sum += (draw_strength(65.0, 6.5, {1, Stream::bond_tension, i, i + 1}) - 65.0) *
           (draw_strength(65.0, 6.5, {1, Stream::bond_shear, i, i + 1}) - 65.0);
  EXPECT_LT(std::abs(sum / n_draws / (6.5 * 6.5)), 3.0 / std::sqrt(static_cast<double>(n_draws)));
}

/// A row of discs of radius 1 with the given gaps.
Packing row(const std::vector<double>& gaps) {
  Packing p;
  p.width = 100.0;
  p.height = 2.0;
  double x = 1.0;
  p.discs.push_back({x, 1.0, 1.0});
  for (const double g : gaps) p.discs.push_back({x += 2.0 + g, 1.0, 1.0});
  return p;
}

TEST(Bond, JoinsPairsUpToTheGap) {
  const std::vector<Contact> contacts = bond(row({0.9e-6, 1.1e-6, -0.01, 0.5}), MatrixRecipe{});
  ASSERT_EQ(contacts.size(), 2U);
  EXPECT_EQ(contacts[0].a, 0U);
  EXPECT_EQ(contacts[0].b, 1U);
  EXPECT_EQ(contacts[1].a, 2U);
  EXPECT_EQ(contacts[1].b, 3U);
  EXPECT_EQ(contacts[0].kind, ContactKind::bonded);
}

// The gap is a length, whatever the size of the discs.
TEST(Bond, GapIsALength) {
  MatrixRecipe m;
  m.bond_gap = 0.4;
  EXPECT_EQ(bond(row({0.39, 0.41, 0.0}), m).size(), 2U);
  Packing large = row({0.0039, 0.0041, 0.0});
  for (Disc& d : large.discs) d.x *= 100.0, d.y *= 100.0, d.r *= 100.0;
  EXPECT_EQ(bond(large, m).size(), 2U);
}

// Rounding of a relaxed packing grows with the discs: what touches does so at any size.
TEST(Bond, TouchingGrowsWithTheDiscs) {
  for (const double size : {1e-4, 1.0, 50.0}) {
    Packing p = row({0.9e-6, 1.1e-6});
    for (Disc& d : p.discs) d.x *= size, d.y *= size, d.r *= size;
    EXPECT_EQ(bond(p, MatrixRecipe{}).size(), 1U) << size;
  }
}

TEST(Bond, StrengthsDoNotDependOnOtherBonds) {
  const std::vector<Contact> all = bond(row({0.0, 0.0, 0.0, 0.0}), MatrixRecipe{});
  const std::vector<Contact> few = bond(row({0.5, 0.0, 0.5, 0.0}), MatrixRecipe{});
  ASSERT_EQ(all.size(), 4U);
  ASSERT_EQ(few.size(), 2U);
  EXPECT_EQ(few[0].sigma_c, all[1].sigma_c);
  EXPECT_EQ(few[1].tau_c, all[3].tau_c);
}

// Two discs of which the branch turns through all directions, the foliation lying at 20 degrees.
TEST(Bond, StrengthsFollowTheAngleToTheFoliation) {
  MatrixRecipe m;
  m.foliation = 20.0, m.sigma_c_sd = m.tau_c_sd = 0.0;
  m.tension_ratio = 3.0, m.cohesion_ratio = 0.5, m.cohesion_oblique = 2.0;
  const auto at = [&](double degrees) {
    const double a = degrees * std::numbers::pi / 180.0;
    Packing p;
    p.discs = {{5.0, 5.0, 1.0}, {5.0 + 2.0 * std::cos(a), 5.0 + 2.0 * std::sin(a), 1.0}};
    return bond(p, m).at(0);
  };
  // Along, across and oblique, and the means over all directions.
  EXPECT_NEAR(at(20.0).sigma_c / at(110.0).sigma_c, 3.0, 1e-9);
  EXPECT_NEAR(at(200.0).tau_c / at(-70.0).tau_c, 0.5, 1e-9);
  EXPECT_NEAR(0.5 * (at(65.0).tau_c + at(155.0).tau_c) / (0.5 * (at(20.0).tau_c + at(110.0).tau_c)), 2.0,
              1e-9);
  double tension = 0.0, shear = 0.0;
  for (int i = 0; i < 36; ++i) tension += at(10.0 * i).sigma_c / 36.0, shear += at(10.0 * i).tau_c / 36.0;
  EXPECT_NEAR(tension, m.sigma_c, 1e-9 * m.sigma_c);
  EXPECT_NEAR(shear, m.tau_c, 1e-9 * m.tau_c);
  m = MatrixRecipe{};
  EXPECT_EQ(at(33.0).cos_2a, 0.0) << "without directions there is no angle";
}

// A binomial share, and the bonds that are left keep their strengths.
TEST(Bond, AFractionIsLeftUnbonded) {
  constexpr std::size_t n = 4000;
  const Packing p = row(std::vector<double>(n, 0.0));
  MatrixRecipe m;
  const std::vector<Contact> all = bond(p, m);
  m.unbonded_fraction = 0.3;
  const std::vector<Contact> some = bond(p, m);
  ASSERT_EQ(all.size(), some.size());
  double left = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    left += some[i].kind == ContactKind::touching ? 1.0 / n : 0.0;
    if (some[i].kind == ContactKind::bonded) {
      EXPECT_EQ(some[i].sigma_c, all[i].sigma_c);
    }
  }
  EXPECT_NEAR(left, 0.3, 3.0 * std::sqrt(0.3 * 0.7 / n));
}

// Flat joints: an interface at every contact, bonded, a slit or open, in shares that do not overlap.
TEST(Bond, TypesOfFlatJoints) {
  constexpr std::size_t n = 4000;
  const Packing p = row(std::vector<double>(n, 0.0));
  MatrixRecipe m;
  const std::vector<Contact> all = bond(p, m);
  m.model = MatrixModel::flat_joint;
  m.unbonded_fraction = 0.3, m.gapped_fraction = 0.2, m.initial_gap = 1e-6;
  double slits = 0.0, open = 0.0;
  const std::vector<Contact> some = bond(p, m);
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_EQ(some[i].kind, ContactKind::bonded);
    if (some[i].gap > 0.0)
      open += 1.0 / n;
    else if (some[i].sigma_c == 0.0)
      slits += 1.0 / n;
    else
      EXPECT_EQ(some[i].sigma_c, all[i].sigma_c);
  }
  EXPECT_NEAR(slits, 0.3, 3.0 * std::sqrt(0.3 * 0.7 / n));
  EXPECT_NEAR(open, 0.2, 3.0 * std::sqrt(0.2 * 0.8 / n));
}

}  // namespace
}  // namespace phy::genesis
