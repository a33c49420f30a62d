// The measures of a specimen on assemblies that can be counted by hand.
#include "analysis/specimen_checks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/histories_fixture.hpp"

namespace phy::analysis {
namespace {

/// Discs of radius 1 in a box of 10 x 20, bonded as listed.
Specimen assembly(const std::vector<Vec2>& centres, const std::vector<std::pair<int, int>>& bonds) {
  auto p = std::make_shared<Packing>();
  p->width = 10.0, p->height = 20.0;
  p->report.porosity = 0.17;
  for (const Vec2 c : centres) p->discs.push_back({c.x, c.y, 1.0});
  Specimen s;
  s.packing = p;
  for (const auto& [a, b] : bonds)
    s.contacts.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
  return s;
}

double of(const Specimen& s, const char* name) { return value(specimen_checks(s), name); }

const std::vector<Vec2> row_of_six = {{1, 1}, {3, 1}, {2, 2.7}, {5, 1}, {7, 1}, {9, 9}};

TEST(SpecimenChecks, AChainThatEndsNowhereAndALonelyGrainCarryNothing) {
  // 0 1 2 form a triangle, 3 and 4 hang on it one behind the other, 5 touches nothing.
  const Specimen s = assembly(row_of_six, {{0, 1}, {0, 2}, {1, 2}, {1, 3}, {3, 4}});
  EXPECT_DOUBLE_EQ(of(s, "rattlers"), 0.5);
}

TEST(SpecimenChecks, APartCutOffFromTheLargestCarriesNothing) {
  const Specimen s = assembly({{1, 1}, {3, 1}, {3, 3}, {1, 3}, {6, 6}, {8, 6}, {7, 7.7}},
                              {{0, 1}, {1, 2}, {2, 3}, {0, 3}, {4, 5}, {5, 6}, {4, 6}});
  EXPECT_DOUBLE_EQ(of(s, "rattlers"), 3.0 / 7.0);
}

TEST(SpecimenChecks, OverlapIsTheLargestOverTheSmallerRadius) {
  EXPECT_NEAR(of(assembly({{1, 1}, {2.9, 1}, {4.6, 1}}, {{0, 1}, {1, 2}}), "overlap"), 0.3, 1e-12);
  EXPECT_EQ(of(assembly({{1, 1}, {3.5, 1}}, {{0, 1}}), "overlap"), 0.0);  // bonded over a gap
}

TEST(SpecimenChecks, GrainsAcrossAndPorosity) {
  const Specimen s = assembly(row_of_six, {});
  EXPECT_DOUBLE_EQ(of(s, "grains_across"), 5.0);
  EXPECT_DOUBLE_EQ(of(s, "porosity"), 0.17);
  EXPECT_EQ(of(s, "joints"), -1.0);  // intact rock has no such measure
  EXPECT_EQ(of(s, "grains_per_spacing"), -1.0);
}

TEST(SpecimenChecks, TheSetThatMissesTheSpecimenCounts) {
  Specimen s = assembly(row_of_six, {{0, 1}, {0, 2}, {1, 2}});
  s.bedding.resize(2);
  s.bedding[0].spacing = 8.0, s.bedding[1].spacing = 6.0;
  for (Contact& c : s.contacts) c.kind = ContactKind::joint, c.set = 0;
  EXPECT_EQ(of(s, "joints"), 0.0);
  s.contacts[1].set = 1;
  EXPECT_EQ(of(s, "joints"), 1.0);
  EXPECT_DOUBLE_EQ(of(s, "grains_per_spacing"), 3.0);
}

TEST(SpecimenChecks, PlanesOfOneSetCountTogether) {
  Specimen s = assembly(row_of_six, {{0, 1}, {0, 2}, {1, 2}});
  s.bedding.resize(1);
  s.laid_sets.resize(2);  // both of set 0
  for (Contact& c : s.contacts) c.kind = ContactKind::joint;
  s.contacts[1].set = 1;
  EXPECT_EQ(of(s, "joints"), 3.0);
}

TEST(SpecimenChecks, DispersedJointsHaveNoSpacing) {
  Specimen s = assembly(row_of_six, {{0, 1}});
  s.bedding.resize(2);
  s.bedding[0].rule = BeddingRule::oriented, s.bedding[1].spacing = 6.0;
  EXPECT_DOUBLE_EQ(of(s, "grains_per_spacing"), 3.0);
  s.bedding.resize(1);
  EXPECT_EQ(of(s, "grains_per_spacing"), -1.0);
  EXPECT_EQ(of(s, "joints"), 0.0);
}

CrackEvent broken(std::int64_t step, std::uint32_t a, std::uint32_t b) {
  CrackEvent c;
  c.step = step, c.a = a, c.b = b;
  return c;
}

TEST(SpecimenChecks, BondsThatBreakBeforeLoadingAreCountedOnce) {
  Specimen s = assembly(row_of_six, {{0, 1}, {0, 2}, {1, 2}, {1, 3}, {3, 4}});
  for (Contact& c : s.contacts) c.sigma_c = 1.0;
  s.contacts[3].sigma_c = s.contacts[3].tau_c = 0.0;  // an interface without a bond
  s.contacts[4].kind = ContactKind::joint;            // three bonds are left
  s.bedding.resize(1);
  // Both ends of a flat joint, and one that broke while the test went on.
  const std::vector<CrackEvent> cracks = {broken(10, 0, 1), broken(20, 0, 1), broken(20, 3, 4),
                                          broken(21, 1, 2)};
  EXPECT_DOUBLE_EQ(broken_at_start(s, cracks, 20).value, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(broken_at_start(s, cracks, 21).value, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(broken_at_start(s, cracks, 9).value, 0.0);
}

TEST(SpecimenChecks, WithoutBondsNoneBreak) {
  const Number n = broken_at_start(assembly(row_of_six, {}), {}, 20);
  EXPECT_TRUE(std::isnan(n.value));
  EXPECT_EQ(n.note, "the matrix has no bonds");
}

}  // namespace
}  // namespace phy::analysis
