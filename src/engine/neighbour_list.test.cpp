// What the list of near pairs reaches, and contacts that are created from it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/small_groups_fixture.hpp"

namespace phy::engine {
namespace {

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

/// Two loose discs side by side, `gap` apart, the left one under way to the right at 0.004 R per
/// cycle of the first step; one cycle per block. A body that is never placed gives the first step its
/// stiffness.
struct Meeting {
  static constexpr double R = 3e-4;
  MatrixRecipe m;
  double mass = m.density * pi * R * R;
  double gap, first_step;  // [m], [s]
  std::uint32_t left;
  std::unique_ptr<LaneGroup> group;
  Vec2 u[2], v[2];    // of the left and the right disc: displacement, velocity in the last cycle
  double step = 0.0;  // of the last cycle [s]

  /// `s` has the two discs, `left_disc` is the number of the left one.
  Meeting(Specimen s, std::uint32_t left_disc, Precision precision) : left(left_disc) {
    gap = std::fabs(s.packing->discs[1].x - s.packing->discs[0].x) - 2.0 * R;
    Boundary boundary;
    boundary.bodies = {pusher(2, 1.0)};
    LaneSetup setup;
    setup.damping = 0.0, setup.step_safety = 0.25;
    setup.boundary = shared(boundary);
    group = small_group(s, precision, 1);
    const auto specimen = shared(std::move(s));
    for (const int lane : {0, 1}) group->load(lane, specimen, setup);  // in lane 1 nothing happens
    first_step = group->time_step(0);
    v[0].x = 0.004 * R / first_step;
    group->set_motion(0, left, {}, v[0], 0.0);
  }
  void advance() {
    step = group->time_step(0);
    group->advance();
    const std::vector<GrainState> grains = group->grains(0);
    for (std::uint32_t i = 0; i < 2; ++i) {
      const GrainState& g = grains[i == 0 ? left : 1 - left];
      v[i] = (1.0 / step) * Vec2{g.ux - u[i].x, g.uy - u[i].y};
      u[i] = {g.ux, g.uy};
    }
  }
  double closer() const { return u[0].x - u[1].x; }
};

// Before they meet every disc has only the wall's spring 2 E_c: omega^2 = 2 E_c/m. With the spring E_c
// between them the two swing against each other fastest: omega^2 = (2 E_c + 2 E_c)/m. The step goes by it as
// soon as they are 0.02 R apart, and their force is E_c times the overlap.
TEST(Contacts, AreCreatedWhereLooseGrainsMeet) {
  constexpr double R = Meeting::R;
  for (const Precision precision : both_precisions) {
    Meeting t(assembly({{R, R, R}, {3.05 * R, R, R}}, MatrixRecipe{}), 0, precision);
    const double E_c = t.m.E_c, safe = 0.25 * 2.0;
    const double relative = precision == Precision::double_precision ? 1e-9 : 1e-4;  // of the largest force
    const double most = E_c * 0.008 * R;
    EXPECT_NEAR(t.first_step, safe / std::sqrt(2.0 * E_c / t.mass), 1e-8 * t.first_step);
    bool met = false;
    double force = 0.0, largest = 0.0;
    for (int cycle = 1; cycle <= 60; ++cycle) {
      const double before = t.v[1].x;
      t.advance();
      EXPECT_NEAR((t.v[1].x - before) * t.mass / t.step, force, relative * most) << "in cycle " << cycle;
      const double overlap = t.closer() - t.gap;
      met = met || -overlap < 0.02 * R;
      const double omega = std::sqrt((met ? 4.0 : 2.0) * E_c / t.mass);
      EXPECT_NEAR(t.group->time_step(0), safe / omega, 1e-8 * t.first_step) << "after cycle " << cycle;
      EXPECT_EQ(t.group->time_step(1), t.first_step) << "of the lane in which nobody meets";
      force = E_c * std::max(overlap, 0.0);
      const HistoryRow& r = t.group->row(0);
      EXPECT_NEAR(r.strain_linear, 0.5 * force * force / E_c, 2.0 * relative * most * most / E_c);
      const std::vector<ContactState> contacts = t.group->snapshot(0).contacts;
      EXPECT_EQ(contacts.size(), force > 0.0 ? 1U : 0U) << "after cycle " << cycle;
      if (contacts.size() == 1) {
        EXPECT_EQ(contacts[0].kind, ContactKind::touching);
        EXPECT_NEAR(contacts[0].F_n, force, relative * most);
        EXPECT_NEAR(contacts[0].normal.x, 1.0, 1e-12);
      }
      largest = std::max(largest, force);
    }
    EXPECT_TRUE(met);
    EXPECT_GT(largest, 0.5 * most);
    EXPECT_EQ(force, 0.0) << "they have parted";
    EXPECT_NEAR(t.v[0].x / (0.004 * R / t.first_step), 0.0, 0.05) << "and have exchanged their velocities";
  }
}

/// Discs on two sides of a plane of the second of two sets, the left one above it: planes that rise at 60
/// degrees. They slide along it without friction. `tilted`: both are planes of one set, at 30 degrees in the
/// mean.
Specimen across_a_plane(bool left_first, bool tilted) {
  constexpr double R = Meeting::R;
  const Disc left{R, R, R}, right{3.03 * R, R, R};
  Specimen s = left_first ? assembly({left, right}, MatrixRecipe{}) : assembly({right, left}, MatrixRecipe{});
  s.bedding.resize(2);
  s.bedding[0].theta = 10.0, s.bedding[1].theta = 60.0;
  s.bedding[1].mu = 0.0;
  s.plane_label = {4, 4, left_first ? 3 : 1, left_first ? 1 : 3};
  if (!tilted) return s;
  for (const BeddingRecipe& plane : s.bedding) s.laid_sets.push_back({plane, 0, 0});
  s.bedding.resize(1);
  s.bedding[0].theta = 30.0;
  return s;
}

// They meet as a broken joint of that set: the grains' own gap at that moment is still to be closed, along
// the plane's normal, and the force is along it, whatever the line between the centres.
TEST(Contacts, AcrossAPlaneAreBrokenJoints) {
  constexpr double R = Meeting::R;
  const Vec2 n{std::sqrt(0.75), -0.5};  // of the plane, from the left disc to the right one
  for (const Precision precision : both_precisions)
    for (const auto& [left_first, tilted] : {std::pair{true, false}, {false, false}, {true, true}}) {
      const Specimen s = across_a_plane(left_first, tilted);
      Meeting t(s, left_first ? 0 : 1, precision);
      const double k = s.bedding_of(1).k_n * 2.0 * R;
      const double tolerance = precision == Precision::double_precision ? 1e-9 : 1e-4;
      double met_at = 0.0, force = 0.0, largest = 0.0;  // way when they met [m]; [N/m]
      for (int cycle = 1; cycle <= 40; ++cycle) {
        const Vec2 before = t.v[1];
        t.advance();
        const std::vector<ContactState> contacts = t.group->snapshot(0).contacts;
        ASSERT_EQ(contacts.size(), t.gap - t.closer() < 0.02 * R || met_at > 0.0 ? 1U : 0U) << cycle;
        if (contacts.empty()) continue;
        if (met_at == 0.0) {
          met_at = t.closer();
          EXPECT_LT(t.group->time_step(0), t.first_step);
        }
        EXPECT_EQ(contacts[0].kind, ContactKind::joint);
        EXPECT_TRUE(contacts[0].broken);
        EXPECT_NEAR(contacts[0].normal.x, left_first ? n.x : -n.x, 1e-12) << "from disc 0 to disc 1";
        EXPECT_NEAR(contacts[0].normal.y, left_first ? n.y : -n.y, 1e-12);
        EXPECT_EQ(contacts[0].F_s, 0.0);
        if (largest > 0.0) {
          EXPECT_NEAR(t.v[1].x - before.x, t.step * force * n.x / t.mass, tolerance * t.v[0].x);
          EXPECT_NEAR(t.v[1].y - before.y, t.step * force * n.y / t.mass, tolerance * t.v[0].x);
        } else {
          const double closed = n.x * (t.closer() - met_at) - (t.gap - met_at);
          EXPECT_NEAR(contacts[0].F_n, k * std::max(closed, 0.0), tolerance * k * 0.01 * R) << cycle;
        }
        force = contacts[0].F_n;
        largest = std::max(largest, force);
      }
      EXPECT_GT(largest, 0.01 * R * k);
      EXPECT_NEAR(t.u[1].y / t.u[1].x, n.y / n.x, 1e-4);
    }
}

TEST(Contacts, OnOneSideOfAPlaneAreOfTheMatrix) {
  Specimen s = across_a_plane(true, false);
  s.plane_label[3] = s.plane_label[2];
  Meeting t(s, 0, Precision::double_precision);
  double overlap = 0.0;
  for (int cycle = 1; cycle <= 40 && !(overlap > 0.0); ++cycle) {
    EXPECT_TRUE(t.group->snapshot(0).contacts.empty());
    t.advance();
    overlap = t.closer() - t.gap;
  }
  ASSERT_EQ(t.group->snapshot(0).contacts.size(), 1U);
  EXPECT_EQ(t.group->snapshot(0).contacts[0].kind, ContactKind::touching);
  EXPECT_NEAR(t.group->snapshot(0).contacts[0].F_n / (t.m.E_c * overlap), 1.0, 1e-9);
}

}  // namespace
}  // namespace phy::engine
