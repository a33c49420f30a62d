// The parts of the engine that are not covered by closed forms: order of grains, near pairs, the frequency
// bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/check.hpp"
#include "base/rng.hpp"
#include "contact/wall.hpp"
#include "engine/jacket.hpp"
#include "engine/lane_group.hpp"
#include "engine/layout.hpp"
#include "engine/stable_step.hpp"
#include "records/assembly.hpp"

namespace phy::engine {
namespace {

std::vector<Disc> scattered(std::uint32_t n, double box) {
  std::vector<Disc> discs;
  for (std::uint32_t i = 0; i < n; ++i)
    discs.push_back({box * uniform(7, Stream::test, i, 0), box * uniform(7, Stream::test, i, 1),
                     0.5 + uniform(7, Stream::test, i, 2)});
  return discs;
}

template <class List>
const auto& at(const List& list, std::int32_t i) {
  return list[static_cast<std::size_t>(i)];
}

TEST(Layout, RowsAreContiguousAndSortedByX) {
  const Specimen s = assembly(scattered(500, 40.0), soft_contact());
  const Layout layout = make_layout(*s.packing, 0.1);
  ASSERT_EQ(layout.order.size(), 500U);
  std::set<std::int32_t> seen(layout.order.begin(), layout.order.end());
  EXPECT_EQ(seen.size(), 500U);
  for (int row = 0; row < layout.n_rows(); ++row) {
    for (std::int32_t g = at(layout.row_grain, row); g < at(layout.row_grain, row + 1); ++g) {
      EXPECT_EQ(at(layout.row_of, g), row);
      EXPECT_EQ(at(layout.rank, at(layout.order, g)), g);
      if (g > at(layout.row_grain, row)) {
        EXPECT_LE(at(s.packing->discs, at(layout.order, g - 1)).x,
                  at(s.packing->discs, at(layout.order, g)).x);
      }
    }
  }
}

TEST(Layout, ContactsJoinARowWithItselfOrItsNeighbour) {
  const Specimen s = assembly(scattered(500, 40.0), soft_contact());
  const Layout layout = make_layout(*s.packing, 0.1);
  for (std::size_t a = 0; a < 500; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Disc p = s.packing->discs[a], q = s.packing->discs[b];
      if (norm(Vec2{p.x - q.x, p.y - q.y}) < p.r + q.r + 0.1) {
        EXPECT_LE(std::abs(at(layout.row_of, layout.rank[a]) - at(layout.row_of, layout.rank[b])), 1);
      }
    }
}

TEST(NearPairs, AreThoseOfTheDoubleLoop) {
  const auto discs = scattered(400, 30.0);
  std::vector<Vec2> x;
  std::vector<double> r;
  for (const Disc& d : discs) x.push_back({d.x, d.y}), r.push_back(d.r);
  x.back() = {1e6, -1e6};  // a fragment far away must not blow up the grid
  std::vector<PairKey> found, expected;
  near_pairs(x, r, 0.3, found);
  std::sort(found.begin(), found.end());
  for (std::uint32_t a = 0; a < x.size(); ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      if (norm(x[a] - x[b]) < r[a] + r[b] + 0.3) expected.push_back(pair_key(a, b));
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(found, expected);
}

TEST(GaugeWeights, ReadAnAffineFieldExactly) {
  const Specimen s = assembly(scattered(500, 40.0), soft_contact());
  const GaugeWeights w = gauge_weights(*s.packing);
  double xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < 500; ++i) {
    const Disc& d = s.packing->discs[i];
    xx += w.x[i] * (3.0 + 0.02 * d.x - 0.05 * d.y);
    yy += w.y[i] * (1.0 + 0.07 * d.x + 0.03 * d.y);
  }
  EXPECT_NEAR(xx, 0.02, 1e-12);
  EXPECT_NEAR(yy, 0.03, 1e-12);
}

// The bound is compared with the frequency that the engine itself shows at the edge of stability: a step a
// little below 2/omega_max keeps the energy bounded, which a bound on the unsafe side would not.
TEST(FrequencyBound, FullStepIsStable) {
  Specimen s = assembly(hexagonal(12, 12, 3e-4), soft_contact());
  bond_touching(s);
  GroupOptions options;
  options.isa = native_isa();
  auto group = make_group(s.packing, options);
  LaneSetup setup;
  setup.damping = 0.0;
  setup.step_safety = 1.0;
  const auto shared = std::make_shared<const Specimen>(s);
  group->load(0, shared, setup);
  for (std::uint32_t i = 0; i < s.packing->discs.size(); ++i)
    group->set_motion(0, i, {}, {1e-6 * normal(1, Stream::test, i, 0), 1e-6 * normal(1, Stream::test, i, 1)},
                      1e-3 * normal(1, Stream::test, i, 2));
  group->advance();
  const double start = group->row(0).kinetic + group->row(0).strain_bond;
  for (int i = 0; i < 100; ++i) group->advance();
  EXPECT_LT(group->row(0).kinetic + group->row(0).strain_bond, 3.0 * start);
}

TEST(FrequencyBound, NewContactsOnlyRaiseIt) {
  Specimen s = assembly(hexagonal(6, 6, 3e-4), soft_contact());
  bond_touching(s);
  FrequencyBound bound(s, initial_stiffnesses(contact::standard_models(), s));
  const double before = bound.omega();
  s.matrix = MatrixRecipe{};
  bound.add(stiffness_of(contact::standard_models(), s, {3, 4, ContactKind::touching}, {1.0, 0.0}));
  EXPECT_GT(bound.omega(), before);
  EXPECT_TRUE(bound.loose());
}

// Along a joint grains may slide until their centres meet: the branch vector then has no direction, and the
// joint goes on with its own.
TEST(Joint, GrainsPassThroughEachOther) {
  constexpr double R = 3e-4;
  Specimen s = assembly({{0.0, 0.0, R}, {2.0 * R, 0.0, R}}, soft_contact());
  BeddingRecipe set;
  set.theta = 0.0;  // the branch lies in the plane
  set.sigma_n = set.cohesion = 1e3;
  s.bedding = {set};
  s.plane_label = {1, 0};
  bond_touching(s);
  s.contacts[0].kind = ContactKind::joint, s.contacts[0].side = 1;
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    GroupOptions options;
    options.isa = native_isa();
    options.precision = precision;
    options.lanes = 4;
    auto group = make_group(s.packing, options);
    group->load(0, std::make_shared<const Specimen>(s), {});
    for (const double offset : {0.0, 1e-12, -1e-9}) {  // from the meeting of the centres
      group->set_motion(0, 0, {R, 0.0, 0.0}, {0.0, 0.0}, 0.0);
      group->set_motion(0, 1, {-R + offset, 0.0, 0.0}, {0.0, 0.0}, 0.0);
      for (int i = 0; i < 3; ++i) group->advance();
      EXPECT_TRUE(group->health(0).ok) << group->health(0).reason;
      for (const GrainState& g : group->grains(0)) EXPECT_TRUE(std::isfinite(g.ux + g.uy + g.rotation));
    }
  }
}

// Constants of a contact are the same in all lanes: a mate of the other convention would be computed wrongly.
TEST(Group, NeighboursShareTheStiffnessConvention) {
  MatrixRecipe m;
  const auto one = std::make_shared<const Specimen>(assembly({{1.0, 1.0, 1.0}, {3.0, 1.0, 1.0}}, m));
  m.stiffness_convention = StiffnessConvention::pfc5;
  const auto two = std::make_shared<const Specimen>(assembly({{1.0, 1.0, 1.0}, {3.0, 1.0, 1.0}}, m));
  GroupOptions options;
  options.lanes = 2;
  const auto group = make_group(one->packing, options), other = make_group(one->packing, options);
  group->load(0, one, {});
  EXPECT_THROW(group->load(1, two, {}), InternalError);
  other->load(0, two, {});
  EXPECT_THROW(other->move_lane(0, *group, 1), InternalError);
  other->load(0, one, {});
  other->move_lane(0, *group, 1);
}

/// A tool that touches grains 0 ... n - 1 and pushes along +x (direction 1) or -x (-1).
Tool pusher(std::uint32_t n, double direction) {
  Tool t;
  for (std::uint32_t i = 0; i < n; ++i) t.touches.push_back({i, {direction, 0.0}, 0.0});
  return t;
}

/// Two loose discs of radius R side by side, `gap` apart, in a group without damping at a fiftieth of the
/// stable step, where a collision keeps its energy within 5e-3. The tool that gives the step its stiffness is
/// placed with `jacket` only.
struct TwoDiscs {
  static constexpr double R = 3e-4, skin = 0.25 * R;
  MatrixRecipe m;
  double mass = m.density * pi * R * R, block = 0.0;
  std::unique_ptr<LaneGroup> group;

  TwoDiscs(double gap, bool jacket, Precision precision) {
    const auto s = std::make_shared<const Specimen>(assembly({{R, R, R}, {3.0 * R + gap, R, R}}, m));
    GroupOptions options;
    options.isa = native_isa();
    options.precision = precision;
    options.lanes = 4;
    options.interval = 400;
    group = make_group(s->packing, options);
    Rig rig;
    rig.tools = {pusher(2, 1.0)};
    for (Touch& t : rig.tools[0].touches) t.gap = 0.5 * R;  // counts for the step, is never reached
    rig.jacket = jacket;
    LaneSetup setup;
    setup.damping = 0.0, setup.step_safety = 0.02;
    setup.rig = std::make_shared<const Rig>(rig);
    group->load(0, s, setup);
    if (jacket) group->place_rig(0);
    block = group->time_step(0) * options.interval;
  }
  double moved(std::size_t disc) const { return group->grains(0)[disc].ux; }
};

// A grain that goes farther in a block of cycles than the list of near pairs reaches meets what lies in its
// way all the same. Head on with its like it comes to rest, and the other goes on as fast.
TEST(NearPairs, ReachAsFarAsAFastGrainFlies) {
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    const double gap = 1.5 * TwoDiscs::skin;
    TwoDiscs t(gap, false, precision);
    const double v = 2.0 * TwoDiscs::skin / t.block, kinetic = 0.5 * t.mass * v * v;
    t.group->set_motion(0, 0, {}, {v, 0.0}, 0.0);
    for (int i = 0; i < 3; ++i) {
      t.group->advance();
      const HistoryRow& r = t.group->row(0);
      EXPECT_NEAR((r.kinetic + r.strain_linear) / kinetic, 1.0, 5e-3) << "after block " << i + 1;
    }
    EXPECT_LT(t.moved(0), 1.5 * gap);
    EXPECT_GT(t.moved(1), 3.0 * TwoDiscs::skin);
  }
}

// Two loose discs under a jacket run into each other: p 2R on each, work = p times the area swept, also
// where the list of near pairs knew nothing of the other when it was made.
TEST(Jacket, WorkIsPressureTimesTheAreaSwept) {
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    TwoDiscs t(3.0 * TwoDiscs::skin, true, precision);
    const double drift = 2.0 * TwoDiscs::skin;  // in the first block
    const double force = 2.0 * drift * t.mass / (t.block * t.block);
    const double p = force / (2.0 * TwoDiscs::R);
    t.group->press(0, p);
    double most = 0.0;  // they bounce and give work back
    for (int i = 0; i < 6; ++i) {
      t.group->advance();
      const HistoryRow& r = t.group->row(0);
      const double closer = t.moved(0) - t.moved(1);
      EXPECT_NEAR(r.boundary_work / (force * closer), 1.0, 1e-5) << "after block " << i + 1;
      most = std::max(most, r.boundary_work);
      EXPECT_NEAR(r.kinetic + r.strain_linear, r.boundary_work, 5e-3 * most) << "after block " << i + 1;
      EXPECT_NEAR(t.moved(0) + t.moved(1), 0.0, 1e-3 * drift);
      EXPECT_EQ(t.group->jacket(0).pressure, p);
      EXPECT_NEAR(p * t.group->jacket(0).swept / r.boundary_work, 1.0, 1e-12);
    }
    EXPECT_LT(t.moved(0), 1.6 * TwoDiscs::skin) << "they do not pass through each other";
  }
}

// Three discs of a side, the middle one behind the others: as much of it is pressed as shows between them.
TEST(Jacket, PressesOnWhatShows) {
  const std::vector<double> r(4, 1.0);
  const auto heights = [&](double lower, double upper) {
    const std::vector<Vec2> x = {{1.0, lower}, {3.0, 3.0}, {1.0, upper}, {5.0, 3.0}};
    return jacket_heights(x, r, 6.0, 0.01);
  };
  const std::vector<double> apart = heights(1.0, 5.0), close = heights(1.6, 4.5), shut = heights(2.0, 4.0);
  EXPECT_NEAR(apart[1], 2.0, 0.02);
  EXPECT_NEAR(close[1], 3.5 - 2.6, 0.02);
  EXPECT_EQ(shut[1], 0.0);
  for (const std::vector<double>& h : {apart, close, shut}) EXPECT_NEAR(h[3], -2.0, 0.02);
}

// A tool in balance has no mass: a disc that it pushes with a constant force is accelerated by force / mass
// from the first step on, and the tool stays force / stiffness ahead of it.
TEST(Balance, PushesADiscLikeAConstantForce) {
  constexpr double R = 3e-4, force = 200.0;
  const MatrixRecipe m;
  const auto s = std::make_shared<const Specimen>(assembly({{R, R, R}}, m));
  Rig rig;
  rig.tools = {pusher(1, 1.0)};
  for (const int interval : {1, 7}) {
    GroupOptions options;
    options.interval = interval;
    auto group = make_group(s->packing, options);
    LaneSetup setup;
    setup.damping = 0.0;
    setup.rig = std::make_shared<const Rig>(rig);
    group->load(0, s, setup);
    group->place_rig(0);
    Drive drive;
    drive.balance_x = {true, force};
    group->drive(0, 0, drive);
    const double k = contact::wall::normal_stiffness(m), mass = m.density * pi * R * R;
    for (int block = 1; block <= 50; ++block) {
      group->advance();
      EXPECT_NEAR(group->tool(0, 0).force.x, force, 1e-4 * force);
      EXPECT_NEAR(group->tool(0, 0).mean_force.x, force, 1e-4 * force) << "in every step";
      const double n = block * interval, dt = group->time_step(0), u = group->grains(0)[0].ux;
      const double leap_frog =
          0.5 * force / mass * dt * dt * n * (n - 1.0);  // no force before the first step
      EXPECT_NEAR(u, leap_frog, 2e-4 * leap_frog + 1e-15);
      EXPECT_NEAR(group->tool(0, 0).displacement.x - u, force / k, 2e-4 * force / k);
    }
    EXPECT_NEAR(group->row(0).energy_error, 0.0, 5e-4);
  }
}

// Grains at different distances: the tool meets the force with those that it reaches, after a jump that
// touches none, one, or all of them.
TEST(Balance, FindsTheGrainsThatCarryTheForce) {
  constexpr double R = 3e-4;
  const MatrixRecipe m;
  const auto s = std::make_shared<const Specimen>(
      assembly({{R, R, R}, {R, 4.0 * R, R}, {R, 7.0 * R, R}, {R, 10.0 * R, R}}, m));
  Rig rig;
  rig.tools = {pusher(4, 1.0)};
  for (std::uint32_t i = 0; i < 4; ++i) rig.tools[0].touches[i].gap = 1e-7 * i;
  const double k = contact::wall::normal_stiffness(m);
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    GroupOptions options;
    options.interval = 1;
    options.precision = precision;
    options.lanes = 4;
    auto group = make_group(s->packing, options);
    for (int lane = 0; lane < 3; ++lane) {
      LaneSetup setup;
      setup.rig = std::make_shared<const Rig>(rig);
      group->load(lane, s, setup);
      group->place_rig(lane);
    }
    const double some = 0.5e-7 * k, more = 6e-7 * k, most = 4e-5 * k;  // 0.5; 1 + 2 + 3 = 6; far beyond
    const double forces[3] = {some, more, most};
    for (int lane = 0; lane < 3; ++lane) {
      Drive drive;
      drive.balance_x = {true, forces[lane]};
      group->drive(lane, 0, drive);
    }
    group->advance();
    for (int lane = 0; lane < 3; ++lane)
      EXPECT_NEAR(group->tool(lane, 0).force.x, forces[lane], 1e-4 * forces[lane]);
    EXPECT_NEAR(group->tool(0, 0).displacement.x, 0.5e-7, 1e-11);
    EXPECT_NEAR(group->tool(1, 0).displacement.x, 3e-7, 1e-10);
    EXPECT_NEAR(group->tool(2, 0).displacement.x, 1e-5 + 1.5e-7, 1e-9);
  }
}

}  // namespace
}  // namespace phy::engine
