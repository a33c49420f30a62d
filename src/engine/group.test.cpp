// What a group is to its lanes: neighbours, moves, and states that have no direction.
#include <gtest/gtest.h>

#include <cmath>

#include "base/check.hpp"
#include "engine/small_groups_fixture.hpp"

namespace phy::engine {
namespace {

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
    options.lanes = some_lanes(precision);
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

// Constants of a contact are the same in all lanes: a neighbour of the other convention would be computed
// wrongly.
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

/// Thirty discs with bonds and joints that soon break, between walls that close in and side walls under a
/// servo or in balance, and two loose discs that fly against them from the right.
struct CrushedBlock {
  static constexpr double R = 3e-4;
  static constexpr int interval = 20, loose = 30;
  std::shared_ptr<const Specimen> specimen;
  LaneSetup setup;

  CrushedBlock() {
    std::vector<Disc> discs = hexagonal(5, 6, R);
    for (const int row : {1, 3})  // these rows reach farthest to the right
      discs.push_back({12.05 * R, R * (1.0 + std::sqrt(3.0) * row), R});
    MatrixRecipe m;
    m.sigma_c = 8e6, m.tau_c = 6e6;
    Specimen s = assembly(discs, m);
    BeddingRecipe set;
    set.theta = 35.0, set.spacing = 4.0 * R;
    set.sigma_n = 2e6, set.cohesion = 3e6, set.psi = 5.0;
    s.bedding = {set};
    bond_touching(s);
    joint_crossing(s);
    Boundary boundary;
    boundary.bodies.resize(4);
    for (std::uint32_t i = 0; i < 5; ++i) {
      boundary.bodies[0].touches.push_back({i, {0.0, 1.0}, 0.0});
      boundary.bodies[1].touches.push_back({25 + i, {0.0, -1.0}, 0.0});
    }
    for (std::uint32_t row = 0; row < 6; ++row) {
      boundary.bodies[2].touches.push_back({5 * row, {1.0, 0.0}, row % 2 == 0 ? 0.0 : R});
      boundary.bodies[3].touches.push_back({5 * row + 4, {-1.0, 0.0}, row % 2 == 1 ? 0.0 : R});
    }
    boundary.bodies[0].rough = boundary.bodies[1].rough = true;
    boundary.axial = {0, 1, {0.0, 1.0}, 1.0};
    setup.body_friction = 0.3;
    setup.boundary = shared(boundary);
    specimen = shared(std::move(s));
  }
  /// Loads a lane and sets it going; neighbours go at speeds of their own.
  void start(LaneGroup& group, int lane, double speed, bool balance) const {
    group.load(lane, specimen, setup);
    group.place_boundary(lane);
    for (const int body : {0, 1, 2, 3}) {
      PrescribedMotion prescribed;
      const double sign = body % 2 == 0 ? 1.0 : -1.0;
      if (body < 2) {
        prescribed.velocity = {0.0, sign * speed};
        prescribed.ramp = 1e-6;
      } else if (balance) {
        prescribed.balance_x = {true, sign * 2000.0};
      } else {
        prescribed.servo_x = {true, sign * 2000.0, 40e9, 0.0, 1.0};
      }
      group.prescribe(lane, body, prescribed);
    }
    for (const std::uint32_t grain : {30U, 31U}) group.set_motion(lane, grain, {}, {-3.0, 0.0}, 0.0);
  }
};

void expect_same_contacts(const std::vector<ContactState>& one, const std::vector<ContactState>& two) {
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    const ContactState &p = one[i], &q = two[i];
    EXPECT_TRUE(p.a == q.a && p.b == q.b && p.kind == q.kind && p.broken == q.broken) << i;
    EXPECT_TRUE(p.F_n == q.F_n && p.F_s == q.F_s && p.normal.x == q.normal.x && p.normal.y == q.normal.y)
        << i;
  }
}

/// All that a lane shows, bit by bit.
void expect_same(LaneGroup& one, int l, LaneGroup& two, int k) {
  for (const HistoryColumns& columns : {clock_columns(), gauge_columns(), balance_columns()})
    for (const HistoryColumn& c : columns) EXPECT_EQ(one.row(l).*c.value, two.row(k).*c.value) << c.name;
  EXPECT_EQ(one.time_step(l), two.time_step(k));
  EXPECT_EQ(one.health(l).reason, two.health(k).reason);
  const std::vector<GrainState> p = one.grains(l), q = two.grains(k);
  for (std::size_t i = 0; i < p.size(); ++i)
    EXPECT_TRUE(p[i].ux == q[i].ux && p[i].uy == q[i].uy && p[i].rotation == q[i].rotation) << i;
  ASSERT_EQ(one.cracks(l).size(), two.cracks(k).size());
  for (std::size_t i = 0; i < one.cracks(l).size(); ++i) {
    const Breakage &b = one.cracks(l)[i], &c = two.cracks(k)[i];
    EXPECT_TRUE(b.travel == c.travel && b.crack.step == c.crack.step && b.crack.time == c.crack.time) << i;
    EXPECT_TRUE(b.crack.a == c.crack.a && b.crack.b == c.crack.b && b.crack.mode == c.crack.mode) << i;
    EXPECT_TRUE(b.crack.energy == c.crack.energy && b.crack.position.x == c.crack.position.x) << i;
  }
  for (int body = 0; body < 4; ++body) {
    const BodyState &s = one.body(l, body), &t = two.body(k, body);
    EXPECT_TRUE(s.displacement.x == t.displacement.x && s.displacement.y == t.displacement.y) << body;
    EXPECT_TRUE(s.force.x == t.force.x && s.force.y == t.force.y) << body;
    EXPECT_TRUE(s.mean_force.x == t.mean_force.x) << body;
  }
  expect_same_contacts(one.snapshot(l).contacts, two.snapshot(k).contacts);
}

/// What has to have happened for the comparison to say something: breakage of both kinds, slip, and contacts
/// of the loose discs.
void expect_eventful(LaneGroup& group, int lane) {
  bool matrix = false, bedding = false, met = false;
  for (const Breakage& b : group.cracks(lane))
    (b.crack.place == CrackPlace::matrix ? matrix : bedding) = true;
  for (const ContactState& c : group.snapshot(lane).contacts) met = met || c.b >= CrushedBlock::loose;
  EXPECT_TRUE(matrix && bedding && met) << matrix << bedding << met;
  EXPECT_GT(group.row(lane).slip, 0.0);
  EXPECT_TRUE(group.health(lane).ok) << group.health(lane).reason;
}

/// A specimen that wanders through groups of the fewest lanes, of a full register and of one lane, among
/// neighbours in other states, is the one that stayed alone.
void expect_moves_unseen(Precision precision, bool balance) {
  const CrushedBlock block;
  const auto group_of = [&](int lanes) {
    return small_group(*block.specimen, precision, CrushedBlock::interval, lanes);
  };
  const auto home = group_of(precision == Precision::double_precision ? 1 : 4);
  block.start(*home, 0, 0.5, balance);
  struct Stay {
    std::unique_ptr<LaneGroup> group;
    int lane;
  };
  const std::vector<int> lanes = lanes_of(precision, native_isa());
  const int few = lanes[1], full = lanes.back();
  const Stay stays[3] = {{group_of(few), few - 1}, {group_of(full), full - 1}, {group_of(1), 0}};
  block.start(*stays[0].group, 0, 0.8, balance);
  block.start(*stays[1].group, 0, 0.1, !balance);
  block.start(*stays[0].group, few - 1, 0.5, balance);
  std::size_t here = 0;
  for (int i = 1; i <= 24; ++i) {
    home->advance();
    stays[here].group->advance();
    expect_same(*home, 0, *stays[here].group, stays[here].lane);
    if (i % 3 != 0) continue;
    const std::size_t next = (here + 1) % 3;
    stays[here].group->move_lane(stays[here].lane, *stays[next].group, stays[next].lane);
    here = next;
  }
  expect_eventful(*home, 0);
}

TEST(Group, ALaneThatMovesKeepsItsBits) {
  for (const Precision precision : both_precisions)
    for (const bool balance : {false, true}) expect_moves_unseen(precision, balance);
}

}  // namespace
}  // namespace phy::engine
