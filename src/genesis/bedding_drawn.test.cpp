// What of the bedding is drawn: patches, distances and tilts of planes, strengths of joints. Statistics
// follow from the description in docs/theory/bedding.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/exact_math.hpp"
#include "base/stats.hpp"
#include "genesis/bedding.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"

namespace phy::genesis {
namespace {

constexpr int n_pairs = 400;

/// Two rows of discs of radius 0.5, one at each side of the plane y = 1: pair i is discs i and n_pairs + i,
/// at x = i + 0.5.
std::shared_ptr<Packing> strip() {
  auto p = std::make_shared<Packing>();
  p->width = n_pairs, p->height = 2.0;
  for (const double y : {0.5, 1.5})
    for (int i = 0; i < n_pairs; ++i) p->discs.push_back({i + 0.5, y, 0.5});
  return p;
}

BeddingRecipe plane(double persistence, double patch_length) {
  BeddingRecipe b;
  b.rule = BeddingRule::crossing;
  b.spacing = 1000.0;
  b.persistence = persistence, b.patch_length = patch_length;
  return b;
}

Specimen make(std::shared_ptr<const Packing> packing, std::vector<BeddingRecipe> bedding, std::int64_t seed) {
  MatrixRecipe matrix;
  matrix.bond_seed = seed;
  return make_specimen(std::move(packing), matrix, std::move(bedding), "drawn");
}

/// Which pairs of the strip are joints.
std::vector<bool> jointed(const Specimen& s) {
  std::vector<bool> is(n_pairs, false);
  for (const Contact& c : s.contacts)
    if (c.b == c.a + n_pairs) is[c.a] = c.kind == ContactKind::joint;
  return is;
}

double share_of(const std::vector<bool>& is) {
  return static_cast<double>(std::count(is.begin(), is.end(), true)) / static_cast<double>(is.size());
}

double variance_of(const std::vector<double>& v) {
  const double mean = summarise(v).mean;
  double sum = 0.0;
  for (const double x : v) sum += (x - mean) * (x - mean);
  return sum / static_cast<double>(v.size() - 1);
}

TEST(Persistence, OneIsAPlaneWithoutBridges) {
  const Specimen whole = make(strip(), {plane(1.0, 0.0)}, 1), patched = make(strip(), {plane(1.0, 3.0)}, 7);
  EXPECT_EQ(share_of(jointed(whole)), 1.0);
  EXPECT_EQ(jointed(whole), jointed(patched));
}

// n independent patches of probability p: the share has mean p and variance p (1 - p)/n. Where L cuts the
// strip is random too, which adds a part of order L/n_pairs.
TEST(Persistence, ShareOfPatchesIsBinomial) {
  const auto packing = strip();
  for (const double patch : {0.0, 4.0}) {
    constexpr double p = 0.3;
    std::vector<double> shares;
    for (int seed = 1; seed <= 400; ++seed)
      shares.push_back(share_of(jointed(make(packing, {plane(p, patch)}, seed))));
    const double expected = p * (1.0 - p) / (n_pairs / std::max(1.0, patch));
    EXPECT_NEAR(summarise(shares).mean, p, 4.0 * std::sqrt(expected / 400.0)) << patch;
    // The standard error of a variance of 400 normal numbers is 7 %.
    EXPECT_NEAR(variance_of(shares) / expected, 1.0, 0.28) << patch;
  }
}

// Two points of a plane `lag` apart lie in one patch with probability 1 - lag/L, else their patches are
// independent: they differ with probability 2 p (1 - p) min(1, lag/L).
TEST(Persistence, PatchesHaveTheLengthGiven) {
  const auto packing = strip();
  constexpr double p = 0.6, L = 5.0;
  for (const std::size_t lag : {1U, 3U, 5U, 9U}) {
    double differ = 0.0, all = 0.0;
    for (int seed = 1; seed <= 200; ++seed) {
      const std::vector<bool> is = jointed(make(packing, {plane(p, L)}, seed));
      for (std::size_t i = 0; i + lag < is.size(); ++i)
        differ += is[i] != is[i + lag] ? 1.0 : 0.0, all += 1.0;
    }
    // 16,000 patches.
    EXPECT_NEAR(differ / all, 2.0 * p * (1.0 - p) * std::min(1.0, static_cast<double>(lag) / L), 0.016)
        << lag;
  }
}

TEST(Persistence, PatchesTurnWithThePlanes) {
  const auto packing = strip();
  auto upright = std::make_shared<Packing>(*packing);
  std::swap(upright->width, upright->height);
  for (Disc& d : upright->discs) d = {upright->width - d.y, d.x, d.r};
  BeddingRecipe vertical = plane(0.5, 3.0);
  vertical.theta = 90.0;
  EXPECT_EQ(jointed(make(packing, {plane(0.5, 3.0)}, 3)), jointed(make(upright, {vertical}, 3)));
}

TEST(Persistence, APatchKnowsNothingOfOtherContacts) {
  for (const double patch : {0.0, 3.0}) {
    const Specimen all = make(strip(), {plane(0.5, patch)}, 3);
    Specimen fewer = all;
    for (Contact& c : fewer.contacts) c.kind = ContactKind::bonded;
    std::erase_if(fewer.contacts, [](const Contact& c) { return c.a % 3 == 0; });
    std::reverse(fewer.contacts.begin(), fewer.contacts.end());
    lay_bedding(fewer);
    const std::vector<bool> a = jointed(all), b = jointed(fewer);
    for (std::size_t i = 0; i < a.size(); ++i)
      if (i % 3 != 0) {
        EXPECT_EQ(a[i], b[i]) << i;
      }
  }
}

TEST(Persistence, PlanesSetsAndSeedsHavePatchesOfTheirOwn) {
  const auto packing = strip();
  const std::vector<bool> one = jointed(make(packing, {plane(0.5, 3.0)}, 1));
  EXPECT_NE(one, jointed(make(packing, {plane(0.5, 3.0)}, 2)));
  BeddingRecipe other = plane(0.5, 3.0);
  other.offset = other.spacing;  // the same place is now the plane number -1
  EXPECT_NE(one, jointed(make(packing, {other}, 1)));
  BeddingRecipe elsewhere = plane(1.0, 0.0);
  elsewhere.offset = 500.0;
  EXPECT_NE(one, jointed(make(packing, {elsewhere, plane(0.5, 3.0)}, 1)));
}

TEST(Persistence, BondsOfBridgesAreThoseOfTheIntactRock) {
  const Specimen s = make(strip(), {plane(0.5, 3.0)}, 5), intact = make(strip(), {}, 5);
  const double share = share_of(jointed(s));
  EXPECT_DOUBLE_EQ(s.bedding_report[0].bridge_fraction, 1.0 - share);
  EXPECT_DOUBLE_EQ(s.bedding_report[0].overlap_ratio, share);  // joints of length 1 on a plane of length 400
  for (std::size_t k = 0; k < s.contacts.size(); ++k)
    EXPECT_EQ(s.contacts[k].sigma_c, intact.contacts[k].sigma_c);
}

TEST(JointStrength, ScattersAsGivenWithinThreeDeviations) {
  BeddingRecipe set = plane(1.0, 0.0);
  set.sigma_n = 8e6, set.sigma_n_sd = 2e6;
  std::vector<double> strengths;
  for (int seed = 1; seed <= 50; ++seed)
    for (const Contact& c : make(strip(), {set}, seed).contacts)
      if (c.kind == ContactKind::joint) strengths.push_back(8e6 * c.sigma_n);
  ASSERT_EQ(strengths.size(), 20000U);
  EXPECT_NEAR(summarise(strengths).mean, 8e6, 4.0 * 2e6 / std::sqrt(20000.0));
  EXPECT_NEAR(std::sqrt(variance_of(strengths)), 0.98658 * 2e6, 0.02 * 2e6);  // truncated at 3 deviations
  EXPECT_GE(*std::min_element(strengths.begin(), strengths.end()), 2e6);
  EXPECT_LE(*std::max_element(strengths.begin(), strengths.end()), 14e6);
  set.sigma_n_sd = 0.0;
  for (const Contact& c : make(strip(), {set}, 1).contacts) EXPECT_EQ(c.sigma_n, 1.0);
}

BeddingRecipe scattered(double spacing_sd, double theta_sd) {
  BeddingRecipe b;
  b.theta = 30.0;
  b.spacing = 0.002, b.offset = 0.0003;
  b.spacing_sd = spacing_sd, b.theta_sd = theta_sd;
  return b;
}

/// By number of the plane; all planes of the set are there.
std::vector<LaidSet> by_plane(std::vector<LaidSet> laid) {
  std::sort(laid.begin(), laid.end(), [](const auto& a, const auto& b) { return a.plane < b.plane; });
  for (std::size_t i = 1; i < laid.size(); ++i) EXPECT_EQ(laid[i].plane, laid[i - 1].plane + 1);
  return laid;
}

TEST(Scatter, DistancesAndTiltsOfPlanesAreAsGiven) {
  std::vector<double> distances, tilts;
  for (int seed = 1; seed <= 100; ++seed) {
    const std::vector<LaidSet> planes = by_plane(laid_apart({scattered(0.25, 4.0)}, 0.1, 0.1, seed));
    double before = 0.0;
    for (const LaidSet& p : planes) {
      const double tilt = p.recipe.theta - 30.0, height = p.recipe.offset / std::cos(tilt * pi / 180.0);
      if (p.plane == 0) {
        EXPECT_NEAR(height, 0.0003, 1e-15);
      }
      if (&p != &planes.front()) distances.push_back(height - before);
      tilts.push_back(tilt), before = height;
    }
  }
  ASSERT_GT(distances.size(), 7000U);
  const double n = std::sqrt(static_cast<double>(distances.size()));
  EXPECT_NEAR(summarise(distances).mean, 0.002, 4.0 * 0.0005 / n);
  EXPECT_NEAR(std::sqrt(variance_of(distances)), 0.98658 * 0.0005, 4.0 * 0.0005 / (1.4 * n));
  EXPECT_GE(*std::min_element(distances.begin(), distances.end()), 0.25 * 0.002);  // they keep their order
  EXPECT_NEAR(summarise(tilts).mean, 0.0, 4.0 * 4.0 / n);
  EXPECT_NEAR(std::sqrt(variance_of(tilts)), 0.98658 * 4.0, 4.0 * 4.0 / (1.4 * n));
  EXPECT_LE(*std::max_element(tilts.begin(), tilts.end()), 12.0);
}

TEST(Scatter, PlanesTurnTogether) {
  BeddingRecipe turned_set = scattered(0.2, 3.0);
  turned_set.theta = 100.0;
  const auto a = laid_apart({scattered(0.2, 3.0)}, 0.04, 0.08, 1),
             b = laid_apart({turned_set}, 0.04, 0.08, 1);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].plane, b[i].plane);
    EXPECT_EQ(a[i].recipe.offset, b[i].recipe.offset);
    EXPECT_NEAR(b[i].recipe.theta - a[i].recipe.theta, 70.0, 1e-12);
  }
}

TEST(Scatter, ASetWithoutItIsLaidAsOne) {
  EXPECT_TRUE(laid_apart({scattered(0.0, 0.0)}, 0.04, 0.08, 1).empty());
  const auto laid =
      laid_apart({scattered(0.0, 0.0), scattered(0.1, 0.0), scattered(0.0, 0.0)}, 0.01, 0.02, 1);
  ASSERT_GT(laid.size(), 6U);
  EXPECT_EQ(laid.front().set, 0);
  EXPECT_EQ(laid.front().recipe.spacing, 0.002);
  EXPECT_EQ(laid[1].set, 1);
  EXPECT_EQ(laid.back().set, 2);
}

class ScatterInRock : public testing::Test {
 protected:
  Recipe recipe_;
  std::shared_ptr<const Packing> packing_;
  ScatterInRock() {
    recipe_.specimen = {0.010, 0.012};
    recipe_.packing.n_grains = 320;
    packing_ = std::make_shared<Packing>(make_packing(recipe_.specimen, recipe_.packing, recipe_.matrix));
  }
  Specimen with(BeddingRecipe set) { return make(packing_, {set}, 1); }
};

// Planes that differ by a hundred millionth of spacing and angle are the same planes.
TEST_F(ScatterInRock, ALittleScatterIsNone) {
  for (const BeddingRule rule : {BeddingRule::crossing, BeddingRule::zone}) {
    BeddingRecipe even = scattered(0.0, 0.0), nearly = scattered(1e-8, 1e-8);
    even.rule = nearly.rule = rule;
    const Specimen a = with(even), b = with(nearly);
    EXPECT_GT(b.laid_sets.size(), 6U);
    for (std::size_t k = 0; k < a.contacts.size(); ++k) {
      ASSERT_EQ(a.contacts[k].kind, b.contacts[k].kind);
      EXPECT_EQ(a.contacts[k].side, b.contacts[k].side);
      if (b.contacts[k].kind == ContactKind::joint) {
        EXPECT_EQ(b.set_of(b.contacts[k].set), 0);
      }
    }
    EXPECT_NEAR(a.bedding_report[0].overlap_ratio, b.bedding_report[0].overlap_ratio, 1e-6);
    EXPECT_EQ(a.bedding_report[0].bridge_fraction, b.bedding_report[0].bridge_fraction);
  }
}

TEST_F(ScatterInRock, AJointCrossesThePlaneThatItIsNumberedBy) {
  BeddingRecipe set = scattered(0.1, 5.0);
  set.rule = BeddingRule::crossing;
  const Specimen s = with(set);
  int n_joints = 0;
  for (const Contact& c : s.contacts) {
    if (c.kind != ContactKind::joint) continue;
    ++n_joints;
    const BeddingRecipe& plane = s.bedding_of(c.set);
    const double angle = plane.theta * pi / 180.0;
    const auto height = [&](const Disc& d) {
      return -std::sin(angle) * (d.x - 0.005) + std::cos(angle) * (d.y - 0.006) - plane.offset;
    };
    const double a = height(packing_->discs[c.a]), b = height(packing_->discs[c.b]);
    EXPECT_LT(a * b, 0.0);
    EXPECT_EQ(c.side, b > a ? 1 : -1);
  }
  EXPECT_GT(n_joints, 80);
  EXPECT_EQ(s.bedding_report.size(), 1U);
  EXPECT_EQ(s.bedding_report[0].bridge_fraction, 0.0);
}

}  // namespace
}  // namespace phy::genesis
