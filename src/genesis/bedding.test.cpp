// Which contacts become joints, on which side, checked on packings small enough to count by hand.
#include "genesis/bedding.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "records/assembly.hpp"

namespace phy::genesis {
namespace {

BeddingRecipe plane(double theta, BeddingRule rule, double zone = 0.5, double spacing = 100.0) {
  BeddingRecipe b;
  b.theta = theta;
  b.rule = rule;
  b.zone_thickness = zone;
  b.spacing = spacing;
  return b;
}

/// Numbers 0 1 below, 2 3 above; radius 1, in a box of 4 x 4.
Specimen four_discs(std::vector<BeddingRecipe> bedding) {
  auto p = std::make_shared<Packing>();
  p->width = p->height = 4.0;
  p->discs = {{1.0, 1.0, 1.0}, {3.0, 1.0, 1.0}, {1.0, 3.0, 1.0}, {3.0, 3.0, 1.0}};
  return make_specimen(p, MatrixRecipe{}, std::move(bedding), "four");
}

/// "01:b 02:+0 ..." : pair, then b for bonded or the side and set of a joint.
std::string describe(const Specimen& s) {
  std::string text;
  for (const Contact& c : s.contacts) {
    text += (text.empty() ? "" : " ") + std::to_string(c.a) + std::to_string(c.b) + ":";
    text += c.kind == ContactKind::joint ? (c.side > 0 ? "+" : "-") + std::to_string(c.set) : "b";
  }
  return text;
}

Recipe small_recipe() {
  Recipe r;
  r.specimen = {0.010, 0.012};
  r.packing.n_grains = 320;
  r.bedding = {BeddingRecipe{}};
  r.bedding[0].spacing = 0.002;
  r.bedding[0].offset = 0.0003;
  return r;
}

std::shared_ptr<const Packing> packing_of(const Recipe& r) {
  return std::make_shared<Packing>(make_packing(r.specimen, r.packing, r.matrix));
}

TEST(Bedding, CrossingRuleTakesTheContactsAcross) {
  EXPECT_EQ(describe(four_discs({plane(0.0, BeddingRule::crossing)})), "01:b 02:+0 13:+0 23:b");
  EXPECT_EQ(describe(four_discs({plane(90.0, BeddingRule::crossing)})), "01:-0 02:b 13:b 23:-0");
}

TEST(Bedding, ZoneRuleTakesContactPointsNearThePlane) {
  EXPECT_EQ(describe(four_discs({plane(0.0, BeddingRule::zone)})), "01:b 02:+0 13:+0 23:b");
  const Specimen wide = four_discs({plane(0.0, BeddingRule::zone, 2.01)});
  EXPECT_EQ(describe(wide), "01:+0 02:+0 13:+0 23:+0");  // branch along the plane: the larger number is above
  EXPECT_DOUBLE_EQ(wide.bedding_report[0].non_crossing_fraction, 0.5);
  EXPECT_DOUBLE_EQ(wide.bedding_report[0].overlap_ratio, 2.0);
}

TEST(Bedding, ReportCountsJointLengthOnThePlane) {
  const Specimen s = four_discs({plane(0.0, BeddingRule::crossing)});
  EXPECT_DOUBLE_EQ(s.bedding_report[0].overlap_ratio, 1.0);  // two joints of length 2 on a plane of length 4
  EXPECT_EQ(s.bedding_report[0].bridge_fraction, 0.0);
  EXPECT_EQ(s.bedding_report[0].non_crossing_fraction, 0.0);
}

TEST(Bedding, ContactPointLiesBetweenTheSurfaces) {
  // Centres on both sides of y = 2, but the contact point is at y = 2.4: in a zone of 0.9, not of 0.6.
  auto p = std::make_shared<Packing>();
  p->width = p->height = 4.0;
  p->discs = {{2.0, 1.9, 0.5}, {2.0, 3.9, 1.5}};
  const auto with = [&](BeddingRule rule, double zone) {
    return make_specimen(p, MatrixRecipe{}, {plane(0.0, rule, zone)}, "two");
  };
  EXPECT_EQ(describe(with(BeddingRule::crossing, 0.6)), "01:+0");
  EXPECT_EQ(describe(with(BeddingRule::zone, 0.9)), "01:+0");
  const Specimen bridge = with(BeddingRule::zone, 0.6);
  EXPECT_EQ(describe(bridge), "01:b");
  EXPECT_DOUBLE_EQ(bridge.bedding_report[0].bridge_fraction, 1.0);
}

TEST(Bedding, ZoneRuleWithoutBridgesTakesWhatCrossesToo) {
  Recipe r = small_recipe();
  const auto packing = packing_of(r);
  r.bedding[0].theta = 40.0;
  BeddingRecipe across = r.bedding[0], closed = r.bedding[0];
  across.rule = BeddingRule::crossing, closed.bridges = false;
  const auto made = [&](const BeddingRecipe& set) { return make_specimen(packing, r.matrix, {set}, "one"); };
  const Specimen zone = made(r.bedding[0]), crossing = made(across), both = made(closed);
  int more = 0;
  for (std::size_t k = 0; k < both.contacts.size(); ++k) {
    const bool near = zone.contacts[k].kind == ContactKind::joint;
    const bool crosses = crossing.contacts[k].kind == ContactKind::joint;
    EXPECT_EQ(both.contacts[k].kind == ContactKind::joint, near || crosses);
    more += crosses && !near ? 1 : 0;
  }
  EXPECT_GT(more, 3);
  EXPECT_GT(zone.bedding_report[0].bridge_fraction, 0.0);
  EXPECT_EQ(both.bedding_report[0].bridge_fraction, 0.0);
}

// Branches of a hexagonal lattice lie at 0, 60 and 120 degrees; the normal of theta = 30 lies at 120.
TEST(Bedding, OrientedRuleTakesContactsByTheirDirection) {
  const Specimen lattice = assembly(hexagonal(5, 6, 1.0), MatrixRecipe{});
  const auto with = [&](double theta, double range) {
    BeddingRecipe set = plane(theta, BeddingRule::oriented);
    set.orientation_range = range;
    return make_specimen(lattice.packing, MatrixRecipe{}, {set}, "lattice");
  };
  const auto branch = [](const Specimen& s, const Contact& c) {
    const Disc &a = s.packing->discs[c.a], &b = s.packing->discs[c.b];
    const double angle = std::atan2(b.y - a.y, b.x - a.x) * 180.0 / pi;
    return static_cast<int>(std::lround(angle + 180.0)) % 180;
  };
  const Specimen s = with(30.0, 1.0);
  std::size_t n_joints = 0;
  for (const Contact& c : s.contacts) {
    EXPECT_EQ(c.kind == ContactKind::joint, branch(s, c) == 120);
    n_joints += c.kind == ContactKind::joint ? 1 : 0;
    EXPECT_EQ(c.side, c.kind == ContactKind::joint ? 1 : 0);  // b is the upper disc
  }
  EXPECT_EQ(n_joints, 22U);  // between 6 rows: in turn 4 and 5 of 9 branches
  EXPECT_TRUE(s.bedding_report[0].dispersed);
  EXPECT_DOUBLE_EQ(s.bedding_report[0].joint_fraction, 22.0 / static_cast<double>(s.contacts.size()));
  EXPECT_EQ(std::count(s.plane_label.begin(), s.plane_label.end(), 0), std::ssize(s.plane_label));
  for (const Contact& c : with(0.0, 29.0).contacts) EXPECT_EQ(c.kind, ContactKind::bonded);
  const Specimen wide = with(0.0, 31.0);  // 60 and 120 are 30 from the normal
  for (const Contact& c : wide.contacts) EXPECT_EQ(c.kind == ContactKind::joint, branch(wide, c) != 0);
}

TEST(Bedding, FirstSetHasAContestedContact) {
  const BeddingRecipe first = plane(0.0, BeddingRule::crossing);
  const BeddingRecipe second = plane(90.0, BeddingRule::zone, 2.01);
  const Specimen s = four_discs({first, second});
  EXPECT_EQ(describe(s), "01:-1 02:+0 13:+0 23:-1");
}

TEST(Bedding, LabelsAreIntervalNumbersPerSet) {
  BeddingRecipe fine = plane(0.0, BeddingRule::crossing, 0.5, 0.75);
  fine.offset = 0.1;
  const Specimen s = four_discs({fine, plane(90.0, BeddingRule::crossing)});
  // heights -1, -1, 1, 1: floor(-1.1/0.75) = -2, floor(0.9/0.75) = 1; second set: heights 1, -1, 1, -1
  EXPECT_EQ(s.plane_label, (std::vector<std::int32_t>{-2, -2, 1, 1, 0, -1, 0, -1}));
}

TEST(PlaneSet, LengthInsideTheRectangle) {
  const auto length = [](double theta, double spacing, double w, double h) {
    return PlaneSet(plane(theta, BeddingRule::zone, 0.5, spacing), w, h).total_length();
  };
  EXPECT_DOUBLE_EQ(length(0.0, 3.0, 4.0, 8.0), 3 * 4.0);
  EXPECT_DOUBLE_EQ(length(90.0, 100.0, 4.0, 8.0), 8.0);
  EXPECT_NEAR(length(45.0, 100.0, 4.0, 4.0), 4.0 * std::sqrt(2.0), 1e-14);
  // Many planes: length times spacing is the area.
  EXPECT_NEAR(length(30.0, 0.01, 4.0, 8.0) * 0.01, 32.0, 1e-3);
}

TEST(PlaneSet, DistanceToTheNearestPlane) {
  BeddingRecipe b = plane(0.0, BeddingRule::zone, 0.5, 2.0);
  b.offset = 0.5;
  const PlaneSet planes(b, 4.0, 4.0);
  EXPECT_DOUBLE_EQ(planes.distance(0.5), 0.0);
  EXPECT_DOUBLE_EQ(planes.distance(1.4), 0.9);
  EXPECT_DOUBLE_EQ(planes.distance(1.6), 0.9);
  EXPECT_NEAR(planes.distance(-1.7), 0.2, 1e-15);
}

TEST(Bedding, MirroredPackingAndAngleGiveMirroredJoints) {
  const Recipe r = small_recipe();
  const auto packing = packing_of(r);
  auto mirrored = std::make_shared<Packing>(*packing);
  for (Disc& d : mirrored->discs) d.x = packing->width - d.x;
  for (const BeddingRule rule : {BeddingRule::crossing, BeddingRule::zone}) {
    BeddingRecipe left = r.bedding[0], right = r.bedding[0];
    left.rule = right.rule = rule;
    left.theta = 30.0;
    right.theta = 150.0;  // its normal is the mirrored normal reversed: offset and side change sign
    right.offset = -left.offset;
    const Specimen a = make_specimen(packing, r.matrix, {left}, "left");
    const Specimen b = make_specimen(mirrored, r.matrix, {right}, "right");
    ASSERT_EQ(a.contacts.size(), b.contacts.size());
    int n_joints = 0;
    for (std::size_t k = 0; k < a.contacts.size(); ++k) {
      EXPECT_EQ(a.contacts[k].kind, b.contacts[k].kind);
      EXPECT_EQ(a.contacts[k].side, -b.contacts[k].side);
      EXPECT_EQ(a.contacts[k].sigma_c, b.contacts[k].sigma_c);
      n_joints += a.contacts[k].kind == ContactKind::joint ? 1 : 0;
    }
    EXPECT_GT(n_joints, 100);
    EXPECT_NEAR(a.bedding_report[0].overlap_ratio, b.bedding_report[0].overlap_ratio, 1e-12);
  }
}

TEST(Specimens, OnePerAngleAndTheIntactOneLast) {
  Recipe r = small_recipe();
  r.test.angles = {0.0, 22.5, 90.0};
  r.test.intact = true;
  const std::vector<Specimen> all = make_specimens(packing_of(r), r);
  ASSERT_EQ(all.size(), 4U);
  EXPECT_EQ(all[1].name, "theta = 22.5 deg");
  EXPECT_EQ(all[1].bedding[0].theta, 22.5);
  EXPECT_EQ(all[3].name, "intact");
  EXPECT_TRUE(all[3].bedding.empty());
  EXPECT_TRUE(all[3].plane_label.empty());
  EXPECT_GT(all[0].contacts.size(), 700U);
  for (std::size_t k = 0; k < all[3].contacts.size(); ++k) {
    EXPECT_EQ(all[3].contacts[k].kind, ContactKind::bonded);
    EXPECT_EQ(all[3].contacts[k].sigma_c, all[0].contacts[k].sigma_c);  // only the bedding differs
  }
}

TEST(Specimens, WithoutAnglesTheBeddingAsItStands) {
  Recipe r = small_recipe();
  r.bedding[0].theta = 60.0;
  const auto packing = packing_of(r);
  std::vector<Specimen> all = make_specimens(packing, r);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].name, "theta = 60 deg");
  r.bedding.clear();
  all = make_specimens(packing, r);
  ASSERT_EQ(all.size(), 1U);
  EXPECT_EQ(all[0].name, "intact");
  r.test.angles = {30.0};
  EXPECT_THROW(make_specimens(packing, r), InputError);
}

// A square lattice with a seam about every third row of contacts, twice as stiff and a third as strong; where
// two sets claim a contact the first has it.
TEST(Layers, BondsAboutThePlanesHaveTheirMatrix) {
  constexpr double R = 1e-3;
  Packing p;
  p.width = 8.0 * R, p.height = 20.0 * R;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 4; ++i) p.discs.push_back({R * (1.0 + 2.0 * i), R * (1.0 + 2.0 * j), R});
  MatrixRecipe m;
  BeddingRecipe seam;
  seam.spacing = 6.0 * R, seam.persistence = 0.0;
  seam.layer_thickness = R, seam.layer_stiffness = 2.0, seam.layer_strength = 1.0 / 3.0;
  BeddingRecipe other = seam;
  other.layer_thickness = 2.9 * R, other.layer_stiffness = 5.0, other.layer_strength = 1.0;
  const auto packing = std::make_shared<const Packing>(p);
  const Specimen plain = make_specimen(packing, m, {}, "plain");
  const Specimen s = make_specimen(packing, m, {seam, other}, "layered");
  int n_seam = 0, n_other = 0;
  for (std::size_t i = 0; i < s.contacts.size(); ++i) {
    const Contact& c = s.contacts[i];
    ASSERT_EQ(c.kind, ContactKind::bonded);
    const double y = 0.5 * (p.discs[c.a].y + p.discs[c.b].y) / R;  // planes at 4, 10 and 16
    const double off = std::min({std::abs(y - 4.0), std::abs(y - 10.0), std::abs(y - 16.0)});
    const double stiffness = off < 0.5 ? 2.0 : off < 1.45 ? 5.0 : 1.0;
    EXPECT_EQ(c.layer, stiffness) << y;
    EXPECT_DOUBLE_EQ(c.sigma_c, plain.contacts[i].sigma_c * (off < 0.5 ? 1.0 / 3.0 : 1.0));
    EXPECT_DOUBLE_EQ(c.tau_c, plain.contacts[i].tau_c * (off < 0.5 ? 1.0 / 3.0 : 1.0));
    n_seam += off < 0.5, n_other += off >= 0.5 && off < 1.45;
  }
  for (const std::int32_t label : s.plane_label) EXPECT_EQ(label, 0) << "no joint to meet at";
  EXPECT_EQ(n_seam, 3 * 4);
  EXPECT_EQ(n_other, 6 * 3);
}

TEST(Specimens, OtherSetsTurnWithTheFirst) {
  std::vector<BeddingRecipe> sets(3);
  sets[0].theta = 30.0;
  sets[0].offset = 0.001;
  sets[1].theta = 100.0;
  sets[1].offset = 0.002;
  sets[2].theta = 30.0;
  MatrixRecipe matrix;
  matrix.tension_ratio = 2.0, matrix.foliation = 100.0;
  turn_layers(matrix, sets, 120.0);
  EXPECT_DOUBLE_EQ(matrix.foliation, 10.0);
  EXPECT_EQ(sets[0].theta, 120.0);
  EXPECT_EQ(sets[0].offset, 0.001);
  EXPECT_DOUBLE_EQ(sets[1].theta, 10.0);  // 190 - 180: the normal is reversed
  EXPECT_EQ(sets[1].offset, -0.002);
  EXPECT_DOUBLE_EQ(sets[2].theta, 120.0);
}

}  // namespace
}  // namespace phy::genesis
