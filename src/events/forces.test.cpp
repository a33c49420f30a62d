#include "events/forces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/rng.hpp"
#include "records/assembly.hpp"

namespace phy::events {
namespace {

constexpr std::uint32_t source[] = {3, 4};

/// A contact of the source with grain `other`, which the source pushes with `push` at `at`.
ContactForce on_other(std::uint32_t of_source, std::uint32_t other, Vec2 at, Vec2 push) {
  if (of_source < other) return {of_source, other, at, push};
  return {other, of_source, at, -1.0 * push};
}

void expect_tensor(const MomentTensor& m, double xx, double xy, double yy) {
  const double tolerance = 1e-12 * (std::fabs(xx) + std::fabs(xy) + std::fabs(yy));
  EXPECT_NEAR(m.xx, xx, tolerance);
  EXPECT_NEAR(m.xy, xy, tolerance);
  EXPECT_NEAR(m.yy, yy, tolerance);
}

// Two forces of 100 N/m apart along x, 2 mm from each other: 0.2 N m per metre. Other forces were there
// before.
TEST(MomentTensor, OfADipolePutInByHand) {
  const Vec2 centre{0.010, 0.020};
  const Forces before = {on_other(3, 1, centre + Vec2{-0.001, 0.0}, {0.0, 30.0}),
                         on_other(4, 7, centre + Vec2{0.001, 0.0}, {50.0, 0.0})};
  Forces after = {on_other(3, 1, centre + Vec2{-0.001, 0.0}, {-100.0, 30.0}),
                  {3, 4, centre, {1e6, 1e6}},  // within the source
                  on_other(4, 7, centre + Vec2{0.001, 0.0}, {150.0, 0.0}),
                  {7, 9, centre + Vec2{0.1, 0.1}, {1e6, 0.0}}};  // of two others
  expect_tensor(moment_tensor(source, centre, before, after), 0.2, 0.0, 0.0);
}

// A couple along x with its arm along y and the couple that balances it: a double couple of 0.3 N m per
// metre. The source has the lower number of some pairs and the higher one of others.
TEST(MomentTensor, OfADoubleCouplePutInByHand) {
  const Vec2 centre{0.010, 0.020};
  const Forces after = {on_other(3, 0, centre + Vec2{0.0, -0.0015}, {-100.0, 0.0}),
                        on_other(3, 8, centre + Vec2{0.0, 0.0015}, {100.0, 0.0}),
                        on_other(4, 1, centre + Vec2{-0.0015, 0.0}, {0.0, -100.0}),
                        on_other(4, 9, centre + Vec2{0.0015, 0.0}, {0.0, 100.0})};
  expect_tensor(moment_tensor(source, centre, {}, after), 0.0, 0.3, 0.0);
  expect_tensor(moment_tensor(source, centre, after, {}), 0.0, -0.3, 0.0);
}

// Forces in equilibrium have one tensor whatever the point that arms are measured from.
TEST(MomentTensor, DoesNotDependOnTheCentreOfAForceCouple) {
  const Forces after = {on_other(3, 0, {1.0, 2.0}, {-70.0, 20.0}),
                        on_other(4, 8, {3.0, -1.0}, {70.0, -20.0})};
  const MomentTensor m = moment_tensor(source, {0.0, 0.0}, {}, after);
  expect_tensor(m, 140.0, 0.5 * (-210.0 - 40.0), 60.0);
  expect_tensor(moment_tensor(source, {5.0, 5.0}, {}, after), m.xx, m.xy, m.yy);
}

// Any tensor, as forces at twelve contacts around the source: F = T G^-1 R, G the sum of R R, adds up to T.
TEST(MomentTensor, OfForcesAllAround) {
  const Vec2 centre{0.010, 0.020};
  const MomentTensor put_in{0.4, -0.7, 0.1};
  std::vector<Vec2> arms;
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const double angle = 0.5 * i + uniform(1, Stream::test, i),
                 r = 1e-3 * (1.0 + uniform(2, Stream::test, i));
    const Vec2 arm{r * std::cos(angle), r * std::sin(angle)};
    arms.push_back(arm), xx += arm.x * arm.x, xy += arm.x * arm.y, yy += arm.y * arm.y;
  }
  Forces after;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const double det = xx * yy - xy * xy;
    const Vec2 g{(yy * arms[i].x - xy * arms[i].y) / det, (xx * arms[i].y - xy * arms[i].x) / det};
    const Vec2 push{put_in.xx * g.x + put_in.xy * g.y, put_in.xy * g.x + put_in.yy * g.y};
    after.push_back(on_other(3 + i % 2, i < 3 ? i : i + 3, centre + arms[i], push));
  }
  std::sort(after.begin(), after.end(),
            [](const auto& p, const auto& q) { return std::pair(p.a, p.b) < std::pair(q.a, q.b); });
  expect_tensor(moment_tensor(source, centre, {}, after), put_in.xx, put_in.xy, put_in.yy);
}

// Positions are the present ones, the normal that of the contact, forces those on the second grain.
TEST(ContactForces, AreThoseOfASnapshot) {
  const Specimen s = assembly({{1.0, 1.0, 1.0}, {3.0, 1.0, 1.0}, {1.0, 3.0, 1.0}}, MatrixRecipe{});
  Snapshot shot;
  shot.grains.resize(3);
  shot.grains[0].ux = 0.5, shot.grains[1].ux = 0.5;
  shot.contacts.resize(2);
  shot.contacts[0] = {0, 2, ContactKind::bonded, false, 0.0, 7.0, {0.0, 1.0}};
  shot.contacts[1] = {0, 1, ContactKind::bonded, false, 5.0, 2.0, {1.0, 0.0}};
  const Forces f = forces_of(*s.packing, shot);
  ASSERT_EQ(f.size(), 2U);
  EXPECT_EQ(f[0].b, 1U);
  EXPECT_DOUBLE_EQ(f[0].at.x, 2.5);
  EXPECT_DOUBLE_EQ(f[0].force.x, 5.0);
  EXPECT_DOUBLE_EQ(f[0].force.y, 2.0);
  EXPECT_DOUBLE_EQ(f[1].force.x, -7.0) << "the tangent is the normal turned anticlockwise";
  EXPECT_DOUBLE_EQ(f[1].force.y, 0.0);
}

}  // namespace
}  // namespace phy::events
