// Stress, motion and breakout of a wall on lattices whose stress and whose lost grains are known.
#include "analysis/opening_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/exact_math.hpp"
#include "records/assembly.hpp"

namespace phy::analysis {
namespace {

Vec2 direction(double angle) {
  const SinCos a = sin_cos_degrees(angle);
  return {a.cos, a.sin};
}

ContactState pushing(std::uint32_t a, std::uint32_t b, double F_n, Vec2 normal) {
  ContactState c;
  c.a = a, c.b = b, c.F_n = F_n, c.normal = normal, c.kind = ContactKind::bonded;
  return c;
}

// A closed chain of grains whose links carry N: every cut meets one, and the mean of N cos over half a link
// to either side is known.
TEST(StressAround, ChainCarriesItsForceAcrossEveryCut) {
  constexpr int n = 24;
  constexpr double rho = 1.0, N = 5.0, half = pi / n;
  Packing packing;
  Snapshot shot;
  for (int k = 0; k < n; ++k) {
    const Vec2 x = rho * direction(360.0 * (k + 0.5) / n);
    packing.discs.push_back({x.x + 7.0, x.y - 2.0, rho * std::sin(half)});
  }
  shot.grains.resize(n);
  for (std::uint32_t k = 0; k < n; ++k)
    shot.contacts.push_back(
        pushing(k, (k + 1) % n, N, direction(360.0 * (static_cast<double>(k) + 1.0) / n + 90.0)));
  // Sector k of 24 holds one link, in its middle; of 8 three.
  for (const int sectors : {n, n / 3})
    for (const SectorStress& s : stress_around(packing, shot, {{7.0, -2.0}, 0.9, 1.1}, sectors)) {
      EXPECT_NEAR(s.hoop, N * std::sin(half) / half / 0.2, 1e-3 * N / 0.2) << s.angle;
      EXPECT_NEAR(s.shear, 0.0, 1e-12) << s.angle;
    }
  // Nothing is in another ring.
  for (const SectorStress& s : stress_around(packing, shot, {{7.0, -2.0}, 0.5, 0.9}, 6))
    EXPECT_EQ(s.hoop, 0.0) << s.angle;
}

/// A hexagonal lattice of radius r, n_x by n_y, each of whose three kinds of contacts carries one force.
struct Lattice {
  Specimen specimen;
  Snapshot shot;
  Vec2 centre;
};
Lattice lattice(int n_x, int n_y, double r, std::array<double, 3> forces) {
  Lattice l;
  l.specimen = assembly(hexagonal(n_x, n_y, r), soft_contact());
  bond_touching(l.specimen);
  const auto& discs = l.specimen.packing->discs;
  l.shot.grains.resize(discs.size());
  for (const Contact& c : l.specimen.contacts) {
    const Vec2 branch{discs[c.b].x - discs[c.a].x, discs[c.b].y - discs[c.a].y};
    const Vec2 normal = (0.5 / r) * branch;
    const int kind = std::fabs(branch.y) < 0.1 * r ? 0 : branch.x * branch.y > 0.0 ? 1 : 2;
    l.shot.contacts.push_back(pushing(c.a, c.b, forces[static_cast<std::size_t>(kind)], normal));
  }
  l.centre = {0.5 * l.specimen.packing->width, 0.5 * l.specimen.packing->height};
  return l;
}

// In a uniform stress the mean over a sector is that of the turning axes: m -+ the deviator's mean over it.
TEST(StressAround, UniformStressIsSeenFromEverySector) {
  constexpr double r = 0.01;
  const std::array<double, 3> forces = {3.0, 1.0, -0.5};
  const Lattice l = lattice(150, 170, r, forces);
  // One contact of each kind in an area of 2 sqrt(3) r^2.
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 n = direction(60.0 * static_cast<double>(k));
    const double F = forces[k] / (std::sqrt(3.0) * r);
    xx += F * n.x * n.x, yy += F * n.y * n.y, xy += F * n.x * n.y;
  }
  const double size = std::hypot(xx, yy), flat = std::sin(pi / 12.0) / (pi / 12.0);  // mean of cos 2a
  for (const SectorStress& s : stress_around(*l.specimen.packing, l.shot, {l.centre, 0.8, 1.3}, 12)) {
    const SinCos two = sin_cos_degrees(2.0 * s.angle);
    const double turned = flat * (0.5 * (xx - yy) * two.cos + xy * two.sin);
    EXPECT_NEAR(s.radial, 0.5 * (xx + yy) + turned, 0.02 * size) << s.angle;
    EXPECT_NEAR(s.hoop, 0.5 * (xx + yy) - turned, 0.02 * size) << s.angle;
    EXPECT_NEAR(s.shear, flat * (xy * two.cos - 0.5 * (xx - yy) * two.sin), 0.02 * size) << s.angle;
  }
}

// Shear forces count as normal ones: a lattice that rotates nothing, sheared along x.
TEST(StressAround, ShearForcesCount) {
  Lattice l = lattice(60, 70, 0.01, {0.0, 0.0, 0.0});
  const Vec2 force{2.0, -1.0};
  // The same force in the contacts of both oblique kinds: sigma = F (x) sum of l over the cell's area.
  for (ContactState& c : l.shot.contacts) {
    if (std::fabs(c.normal.y) < 0.1) continue;
    const double up = c.normal.y > 0.0 ? 1.0 : -1.0;
    c.F_n = up * dot(force, c.normal), c.F_s = up * dot(force, tangent(c.normal));
  }
  // Both branches go up by sqrt(3) r and cancel along x: sigma_xy and sigma_yx differ, the mean is taken.
  const double scale = 2.0 * std::sqrt(3.0) * 0.01 / (2.0 * std::sqrt(3.0) * 0.01 * 0.01);
  const double yy = force.y * scale, xy = 0.5 * force.x * scale;
  for (const SectorStress& s : stress_around(*l.specimen.packing, l.shot, {l.centre, 0.2, 0.5}, 4)) {
    const double flat = 2.0 / pi, sign = std::fmod(s.angle, 180.0) < 1.0 ? 1.0 : -1.0;
    EXPECT_NEAR(s.hoop, 0.5 * yy * (1.0 + sign * flat), 0.05 * std::fabs(yy)) << s.angle;
    EXPECT_NEAR(s.shear, sign * flat * xy, 0.05 * std::fabs(yy)) << s.angle;
  }
}

constexpr double grain = 0.01, hole = 0.2;

/// A lattice with a hole, its grains at rest.
Lattice pierced() {
  Lattice l = lattice(60, 70, grain, {0.0, 0.0, 0.0});
  std::vector<Disc> discs;
  for (const Disc& d : l.specimen.packing->discs)
    if (norm(Vec2{d.x, d.y} - l.centre) >= hole) discs.push_back(d);
  l.specimen = assembly(discs, soft_contact());
  bond_touching(l.specimen);
  l.shot.grains.assign(discs.size(), {}), l.shot.contacts.clear();
  for (const Contact& c : l.specimen.contacts) l.shot.contacts.push_back(pushing(c.a, c.b, 0.0, {1.0, 0.0}));
  return l;
}

/// Breaks all bonds of the grains for which `loose` is true, of their place from the centre.
template <class Loose>
void break_off(Lattice& l, const Loose& loose) {
  const auto& discs = l.specimen.packing->discs;
  for (ContactState& c : l.shot.contacts)
    for (const std::uint32_t g : {c.a, c.b})
      if (loose(Vec2{discs[g].x, discs[g].y} - l.centre)) c.broken = true;
}

TEST(WallMotion, UniformShorteningClosesTheHole) {
  Lattice l = pierced();
  const auto& discs = l.specimen.packing->discs;
  for (std::size_t g = 0; g < discs.size(); ++g)
    l.shot.grains[g].ux = -0.03 * (discs[g].x - l.centre.x),
    l.shot.grains[g].uy = -0.01 * (discs[g].y - l.centre.y);
  const WallMotion wall = wall_motion(l.specimen, l.shot, {l.centre, hole}, 12);
  // Centres of the wall's grains lie half a grain behind the circle, on the mean.
  EXPECT_NEAR(wall.closure, 0.02 * (1.0 + 0.5 * grain / hole), 0.0006);
  EXPECT_NEAR(wall.inwards[0], 0.03 * (hole + 0.5 * grain), 0.0004);
  EXPECT_NEAR(wall.inwards[3], 0.01 * (hole + 0.5 * grain), 0.0002);
  const WallMotion none = wall_motion(l.specimen, l.shot, {l.centre, hole}, 12, &l.shot);
  EXPECT_EQ(none.closure, 0.0);
}

TEST(WallMotion, FallenGrainsAreNoWall) {
  Lattice l = pierced();
  break_off(l, [](Vec2 x) { return x.x > 0.0 && std::fabs(x.y) < 0.1 && norm(x) < hole + 4.0 * grain; });
  const auto& discs = l.specimen.packing->discs;
  const std::vector<bool> body = standing_body(l.specimen, l.shot);
  for (std::size_t g = 0; g < discs.size(); ++g)
    if (!body[g]) l.shot.grains[g].ux = -hole;
  const WallMotion wall = wall_motion(l.specimen, l.shot, {l.centre, hole}, 36);
  EXPECT_TRUE(std::isnan(wall.inwards[0]));
  EXPECT_EQ(wall.inwards[18], 0.0);
  EXPECT_EQ(wall.closure, 0.0);
}

TEST(Breakout, SoundWallHasNone) {
  const Lattice l = pierced();
  const std::vector<double> depths = breakout_depths(l.specimen, l.shot, l.centre, 72);
  for (const double d : depths) EXPECT_EQ(d, 0.0);
  const Breakout b = breakout_of(depths, grain);
  EXPECT_EQ(b.depth, 0.0);
  EXPECT_TRUE(std::isnan(b.direction));
  EXPECT_EQ(b.width[0] + b.width[1], 0.0);
}

TEST(Breakout, LostGrainsShowWhereTheyWere) {
  Lattice l = pierced();
  // Two dog-ears on the axis of 30 degrees, the opposite one shallower and narrower.
  const auto in = [](Vec2 x, double axis, double half, double depth) {
    const Vec2 a = direction(axis);
    const double turn = std::atan2(cross(a, x), dot(a, x)) * 180.0 / pi;
    return std::fabs(turn) < half && norm(x) < hole + depth;
  };
  break_off(l, [&](Vec2 x) { return in(x, 30.0, 25.0, 0.1) || in(x, 210.0, 15.0, 0.06); });
  // What has come off lies anywhere.
  const std::vector<bool> body = standing_body(l.specimen, l.shot);
  for (std::size_t g = 0; g < body.size(); ++g)
    if (!body[g]) l.shot.grains[g].ux = 0.5 * (l.centre.x - l.specimen.packing->discs[g].x);
  const std::vector<double> depths = breakout_depths(l.specimen, l.shot, l.centre, 72);
  EXPECT_NEAR(depths[6], 0.1, 2.0 * grain);
  EXPECT_NEAR(depths[42], 0.06, 2.0 * grain);
  EXPECT_EQ(depths[24], 0.0);
  const Breakout b = breakout_of(depths, grain);
  EXPECT_NEAR(b.depth, 0.1, 2.0 * grain);
  EXPECT_NEAR(b.direction, 30.0, 2.0);
  EXPECT_GT(b.clarity, 0.8);
  EXPECT_NEAR(b.width[0], 50.0, 10.0);
  EXPECT_NEAR(b.width[1], 30.0, 10.0);
}

TEST(Breakout, DirectionIsAnAxis) {
  std::vector<double> depths(8, 0.0);
  depths[7] = depths[3] = 2.0;  // 315 and 135 degrees
  Breakout b = breakout_of(depths, 1.0);
  EXPECT_NEAR(b.direction, 135.0, 1e-9);
  EXPECT_NEAR(b.clarity, 1.0, 1e-12);
  EXPECT_EQ(b.width[0], 45.0);
  EXPECT_EQ(b.width[1], 45.0);
  depths[1] = depths[5] = 2.0;  // as much across it: no direction
  EXPECT_NEAR(breakout_of(depths, 1.0).clarity, 0.0, 1e-12);
  // Through to the outside on one side, and nothing at the start on another.
  depths = {std::numeric_limits<double>::infinity(), 0.0, nan, 0.0, 3.0, 0.0, 0.0, 0.0};
  b = breakout_of(depths, 1.0);
  EXPECT_TRUE(std::isinf(b.depth));
  EXPECT_NEAR(b.direction, 0.0, 1e-9);
  EXPECT_EQ(b.width[0], 45.0);
  EXPECT_EQ(b.width[1], 45.0);
}

}  // namespace
}  // namespace phy::analysis
