// What is taken out of the middle of a specimen: a hole and an open flaw.
#include "genesis/cut.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "base/exact_math.hpp"
#include "genesis/bond.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "records/assembly.hpp"

namespace phy::genesis {
namespace {

/// 16 x 24 mm, grains of the paper.
const Recipe& rock() {
  static const Recipe recipe = [] {
    Recipe r;
    r.specimen = {0.016, 0.024};
    r.packing.n_grains = 990;
    return r;
  }();
  return recipe;
}
const std::shared_ptr<const Packing>& packing() {
  static const auto made =
      std::make_shared<const Packing>(make_packing(rock().specimen, rock().packing, rock().matrix));
  return made;
}

double area(const Packing& p) {
  double sum = 0.0;
  for (const Disc& d : p.discs) sum += pi * d.r * d.r;
  return sum;
}
double density() { return area(*packing()) / (packing()->width * packing()->height); }
Vec2 from_middle(const Packing& p, const Disc& d) { return {d.x - 0.5 * p.width, d.y - 0.5 * p.height}; }

/// The discs that are left are those of the packing, in its order and to the last bit.
void expect_part_of(const Packing& rest, const Packing& whole) {
  std::size_t k = 0;
  for (const Disc& d : whole.discs)
    if (k < rest.discs.size() && rest.discs[k].x == d.x && rest.discs[k].y == d.y && rest.discs[k].r == d.r)
      ++k;
  EXPECT_EQ(k, rest.discs.size());
  EXPECT_NE(rest.hash, whole.hash);
  EXPECT_EQ(rest.width, whole.width);
  EXPECT_EQ(rest.height, whole.height);
}

TEST(Cut, NothingIsTakenOutOfSoundRock) {
  EXPECT_EQ(shaped(packing(), rock()), packing());
  EXPECT_EQ(opening_name(rock()), "");
}

TEST(Cut, HoleHasTheAreaAskedForInTheMiddle) {
  constexpr double D = 0.008;
  Recipe r = rock();
  r.specimen.hole_diameter = D;
  const auto rest = shaped(packing(), r);
  expect_part_of(*rest, *packing());
  // A grain in twenty of those of the hole lies on its circle, and whole grains are counted.
  const double hole = 0.25 * pi * D * D;
  EXPECT_NEAR((area(*packing()) - area(*rest)) / density() / hole, 1.0, 0.06);
  double nearest = 1.0;
  for (const Disc& d : rest->discs) nearest = std::min(nearest, norm(from_middle(*rest, d)));
  EXPECT_GE(nearest, 0.5 * D);
  EXPECT_LT(nearest, 0.5 * D + 2.0 * r.packing.radius_max);
  for (const Disc& d : packing()->discs)
    if (norm(from_middle(*packing(), d)) >= 0.5 * D) {
      EXPECT_TRUE(std::any_of(rest->discs.begin(), rest->discs.end(),
                              [&](const Disc& left) { return left.x == d.x && left.y == d.y; }));
    }
}

TEST(Cut, HoleOfADiscIsConcentric) {
  Recipe r = rock();
  r.test.kind = TestKind("brazilian");
  r.test.disc_diameter = 0.0155;
  const auto disc = shaped(packing(), r);
  r.specimen.hole_diameter = 0.005;
  const auto ring = shaped(packing(), r);
  expect_part_of(*ring, *disc);
  Vec2 mean;
  for (const Disc& d : ring->discs) {
    const Vec2 x = from_middle(*ring, d);
    EXPECT_GE(norm(x), 0.0025);
    mean = mean + (1.0 / static_cast<double>(ring->discs.size())) * x;
  }
  EXPECT_LT(norm(mean), 2e-4);
}

/// The two lines from a to b and from c to d cross.
bool cross_each_other(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto side = [](Vec2 from, Vec2 to, Vec2 x) { return cross(to - from, x - from) > 0.0; };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

TEST(Cut, FlawIsOpenAndHasItsLength) {
  constexpr double L = 0.008;
  for (const double gap : {0.0, 1e-4})
    for (const double angle : {0.0, 35.0, 90.0, 120.0}) {
      Recipe r = rock();
      r.specimen.flaw_length = L, r.specimen.flaw_angle = angle, r.matrix.bond_gap = gap;
      const Specimen s = make_specimens(packing(), r).front();
      const Packing& p = *s.packing;
      expect_part_of(p, *packing());
      const double r_max = r.packing.radius_max;
      const SinCos a = sin_cos_degrees(angle);
      const Vec2 axis{a.cos, a.sin};
      // As far as no grain of an end reaches.
      const Vec2 end = (0.5 * L - 2.0 * r_max) * axis;
      for (const Contact& c : s.contacts)
        EXPECT_FALSE(
            cross_each_other(from_middle(p, p.discs[c.a]), from_middle(p, p.discs[c.b]), end, Vec2{} - end))
            << angle;
      // Beyond its ends the rock is whole: the axis meets grains that are bonded across it.
      std::size_t n_across = 0;
      for (const Contact& c : s.contacts)
        if (cross_each_other(from_middle(p, p.discs[c.a]), from_middle(p, p.discs[c.b]), 0.5 * L * axis,
                             0.5 * (L + 4.0 * r_max) * axis))
          ++n_across;
      EXPECT_GT(n_across, 0U) << angle;
      const double width = 2.0 * r_max + gap;
      EXPECT_NEAR((area(*packing()) - area(p)) / density(), width * (L - 2.0 * r_max), 0.25 * width * L)
          << angle;
    }
}

TEST(Cut, WideFlawIsASlot) {
  Recipe r = rock();
  r.specimen.flaw_length = 0.009, r.specimen.flaw_angle = 30.0, r.specimen.flaw_width = 0.003;
  const auto rest = shaped(packing(), r);
  const SinCos a = sin_cos_degrees(30.0);
  for (const Disc& d : rest->discs) {
    const Vec2 x = from_middle(*rest, d);
    const double along = std::fabs(dot(Vec2{a.cos, a.sin}, x)),
                 across = std::fabs(cross(Vec2{a.cos, a.sin}, x));
    EXPECT_TRUE(along + d.r >= 0.0045 || across >= 0.0015);
  }
  EXPECT_NEAR((area(*packing()) - area(*rest)) / density() / (0.003 * (0.009 - 6.6e-4)), 1.0, 0.12);
}

TEST(Cut, NamesTellOpeningsApart) {
  Recipe hole = rock(), flaw = rock();
  hole.specimen.hole_diameter = 0.004, flaw.specimen.flaw_length = 0.004;
  EXPECT_NE(opening_name(hole), opening_name(flaw));
  Recipe other = flaw;
  other.specimen.flaw_angle = 30.0;
  EXPECT_NE(opening_name(other), opening_name(flaw));
  other = flaw, other.matrix.bond_gap = 1e-5;
  EXPECT_NE(opening_name(other), opening_name(flaw));
}

TEST(Cut, RockInPiecesIsRefused) {
  // A strip of 3 rows: the hole parts it.
  Specimen strip = assembly(hexagonal(40, 3, 0.001), soft_contact());
  auto cut = std::make_shared<Packing>(cut_hole(*strip.packing, 0.012));
  ASSERT_LT(cut->discs.size(), strip.packing->discs.size());
  Specimen parted = assembly(cut->discs, soft_contact());
  bond_touching(parted);
  Recipe r;
  check_in_one_piece(parted, r);  // nothing was taken out by the recipe: not its question
  r.specimen.hole_diameter = 0.012;
  EXPECT_THROW(check_in_one_piece(parted, r), InputError);
  bond_touching(strip);
  check_in_one_piece(strip, r);
}

}  // namespace
}  // namespace phy::genesis
