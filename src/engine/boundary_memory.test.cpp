// Bodies: in balance, and under the servo.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/wall.hpp"
#include "engine/small_groups_fixture.hpp"

namespace phy::engine {
namespace {

// A body in balance has no mass: a disc that it pushes with a constant force is accelerated by force / mass
// from the first step on, and the body stays force / stiffness ahead of it.
TEST(Balance, PushesADiscLikeAConstantForce) {
  constexpr double R = 3e-4, force = 200.0;
  const MatrixRecipe m;
  const auto s = std::make_shared<const Specimen>(assembly({{R, R, R}}, m));
  Boundary boundary;
  boundary.bodies = {pusher(1, 1.0)};
  for (const int interval : {1, 7}) {
    GroupOptions options;
    options.interval = interval;
    auto group = make_group(s->packing, options);
    LaneSetup setup;
    setup.damping = 0.0;
    setup.boundary = std::make_shared<const Boundary>(boundary);
    group->load(0, s, setup);
    group->place_boundary(0);
    PrescribedMotion prescribed;
    prescribed.balance_x = {true, force};
    group->prescribe(0, 0, prescribed);
    const double k = contact::wall::normal_stiffness(m), mass = m.density * pi * R * R;
    for (int block = 1; block <= 50; ++block) {
      group->advance();
      EXPECT_NEAR(group->body(0, 0).force.x, force, 1e-4 * force);
      EXPECT_NEAR(group->body(0, 0).mean_force.x, force, 1e-4 * force) << "in every step";
      const double n = block * interval, dt = group->time_step(0), u = group->grains(0)[0].ux;
      const double leap_frog =
          0.5 * force / mass * dt * dt * n * (n - 1.0);  // no force before the first step
      EXPECT_NEAR(u, leap_frog, 2e-4 * leap_frog + 1e-15);
      EXPECT_NEAR(group->body(0, 0).displacement.x - u, force / k, 2e-4 * force / k);
    }
    EXPECT_NEAR(group->row(0).energy_error, 0.0, 5e-4);
  }
}

// Grains at different distances: the body meets the force with those that it reaches, after a jump that
// touches none, one, or all of them.
TEST(Balance, FindsTheGrainsThatCarryTheForce) {
  constexpr double R = 3e-4;
  const MatrixRecipe m;
  const auto s = std::make_shared<const Specimen>(
      assembly({{R, R, R}, {R, 4.0 * R, R}, {R, 7.0 * R, R}, {R, 10.0 * R, R}}, m));
  Boundary boundary;
  boundary.bodies = {pusher(4, 1.0)};
  for (std::uint32_t i = 0; i < 4; ++i) boundary.bodies[0].touches[i].gap = 1e-7 * i;
  const double k = contact::wall::normal_stiffness(m);
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    auto group = small_group(*s, precision, 1);
    const int n = std::min(3, some_lanes(precision));
    for (int lane = 0; lane < n; ++lane) {
      LaneSetup setup;
      setup.boundary = std::make_shared<const Boundary>(boundary);
      group->load(lane, s, setup);
      group->place_boundary(lane);
    }
    const double some = 0.5e-7 * k, more = 6e-7 * k, most = 4e-5 * k;  // 0.5; 1 + 2 + 3 = 6; far beyond
    const double forces[3] = {some, more, most};
    for (int lane = 0; lane < n; ++lane) {
      PrescribedMotion prescribed;
      prescribed.balance_x = {true, forces[lane]};
      group->prescribe(lane, 0, prescribed);
    }
    group->advance();
    const double places[3] = {0.5e-7, 3e-7, 1e-5 + 1.5e-7}, tolerances[3] = {1e-11, 1e-10, 1e-9};
    for (int lane = 0; lane < n; ++lane) {
      EXPECT_NEAR(group->body(lane, 0).force.x, forces[lane], 1e-4 * forces[lane]);
      EXPECT_NEAR(group->body(lane, 0).displacement.x, places[lane], tolerances[lane]);
    }
  }
}

/// A wall under the servo in block after block, from the rule as boundary.hpp states it.
struct ServoByHand {
  double target, k, moved = 0.0, memory = 0.0, mean = 0.0;
  int interval;
  /// One block against a spring of stiffness k: the wall goes evenly, so that the mean of the steps' forces
  /// is that of the place in the middle, half a step beyond it.
  void advance() {
    const double missing = (target - mean) / k;
    memory += 0.2 * missing;
    const double way = memory + 0.6 * missing;
    mean = k * (moved + way * 0.5 * (1.0 + 1.0 / interval));
    moved += way;
  }
};

/// A disc that a grip holds, and a smooth wall that presses on it along +x (1) or -x (-1): a linear spring.
struct WallOnADisc {
  static constexpr double R = 3e-4, force = 200.0;
  MatrixRecipe m;
  double k = contact::wall::normal_stiffness(m), sign;
  int interval;
  Servo servo;
  std::unique_ptr<LaneGroup> group;

  WallOnADisc(double direction, int steps, Precision precision) : sign(direction), interval(steps) {
    const auto s = shared(assembly({{R, R, R}}, m));
    Boundary boundary;
    boundary.bodies = {pusher(1, direction), {}};
    boundary.bodies[1].grips = {{0, true, true, true}};
    LaneSetup setup;
    setup.boundary = shared(boundary);
    group = small_group(*s, precision, interval);
    group->load(0, s, setup);
    group->place_boundary(0);
    servo = {true, sign * force, k, 0.0, 1.0};
  }
  void start() {
    PrescribedMotion prescribed;
    prescribed.servo_x = servo;
    group->prescribe(0, 0, prescribed);
  }
  /// Towards the disc [m].
  double moved() const { return sign * group->body(0, 0).displacement.x; }
  double pushes() const { return sign * group->body(0, 0).force.x; }
  double block() const { return group->time_step(0) * interval; }
};

TEST(Servo, FollowsItsRuleOnALinearSpring) {
  for (const Precision precision : both_precisions)
    for (const double direction : {1.0, -1.0})
      for (const int interval : {1, 20}) {
        WallOnADisc wall(direction, interval, precision);
        wall.start();
        const double force = wall.force;
        const double tolerance = precision == Precision::double_precision ? 1e-11 : 2e-6;  // of the target
        ServoByHand by_hand{force, wall.k, 0.0, 0.0, 0.0, interval};
        for (int block = 1; block <= 60; ++block) {
          wall.group->advance();
          by_hand.advance();
          EXPECT_NEAR(wall.moved(), by_hand.moved, tolerance * force / wall.k) << "after block " << block;
          EXPECT_NEAR(wall.pushes(), wall.k * by_hand.moved, tolerance * force) << "after block " << block;
          EXPECT_NEAR(wall.sign * wall.group->body(0, 0).mean_force.x, by_hand.mean, tolerance * force);
        }
        EXPECT_NEAR(wall.pushes(), force, 1e-5 * force) << "there is no force missing in the end";
        EXPECT_NEAR(wall.group->body(0, 1).force.x, -direction * force, 1e-5 * force) << "of the grip";
      }
}

// The disc goes away from the wall at a steady speed: what the servo remembers follows it, and no force is
// missing.
TEST(Servo, LosesNothingToASteadyDrift) {
  WallOnADisc wall(1.0, 20, Precision::double_precision);
  const double drift = 0.1 * wall.force / wall.k / wall.block();  // a tenth of the force in a block
  wall.start();
  PrescribedMotion away;
  away.velocity = {drift, 0.0};
  wall.group->prescribe(0, 1, away);
  for (int block = 0; block < 100; ++block) wall.group->advance();
  const double before = wall.moved();
  wall.group->advance();
  EXPECT_NEAR(wall.pushes(), wall.force, 1e-6 * wall.force);
  EXPECT_NEAR(wall.moved() - before, drift * wall.block(), 1e-6 * drift * wall.block());
}

// Far from its target it goes as fast as it may and no faster, and winds nothing up on the way: it comes to
// its target at once afterwards.
TEST(Servo, KeepsItsSpeed) {
  WallOnADisc wall(1.0, 20, Precision::double_precision);
  const double way = wall.force / wall.k;
  wall.servo.max_speed = 0.1 * way / wall.block();  // ten blocks to go
  wall.start();
  double before = 0.0, most = 0.0;
  for (int block = 1; block <= 60; ++block) {
    wall.group->advance();
    if (block <= 8) {
      EXPECT_NEAR(wall.moved(), 0.1 * block * way, 1e-9 * way) << "after block " << block;
    }
    EXPECT_LE(std::fabs(wall.moved() - before), 0.1 * way * (1.0 + 1e-9)) << "after block " << block;
    before = wall.moved();
    most = std::max(most, wall.pushes());
  }
  EXPECT_NEAR(wall.pushes(), wall.force, 1e-5 * wall.force);
  EXPECT_LT(most, 1.3 * wall.force);
}

// Constant normal stiffness: the target falls by the spring's force, so that both carry F = k_n U together.
TEST(Servo, GivesWayLikeASpring) {
  WallOnADisc wall(1.0, 20, Precision::double_precision);
  wall.servo.spring = 0.5 * wall.k;
  wall.start();
  for (int block = 0; block < 100; ++block) wall.group->advance();
  EXPECT_NEAR(wall.moved(), wall.force / (1.5 * wall.k), 1e-6 * wall.force / wall.k);
  EXPECT_NEAR(wall.pushes(), wall.force / 1.5, 1e-6 * wall.force);
}

// Three bonded discs between a wall at rest and one under the servo: four springs in a row, of 2 E_c at the
// walls and of E_c + E_b between the discs, as long as these are wide.
TEST(Servo, BringsAColumnToItsForce) {
  constexpr double R = 3e-4, force = 200.0;
  MatrixRecipe m;
  Specimen s = assembly({{R, R, R}, {R, 3.0 * R, R}, {R, 5.0 * R, R}}, m);
  bond_touching(s);
  Boundary boundary;
  boundary.bodies.resize(2);
  boundary.bodies[0].touches = {{0, {0.0, 1.0}, 0.0}}, boundary.bodies[1].touches = {{2, {0.0, -1.0}, 0.0}};
  const double k = 1.0 / (2.0 / (2.0 * m.E_c) + 2.0 / (m.E_c + m.E_b));
  LaneSetup setup;
  setup.boundary = shared(boundary);
  for (const Precision precision : both_precisions) {
    const auto group = small_group(s, precision, 50);
    group->load(0, shared(s), setup);
    group->place_boundary(0);
    PrescribedMotion prescribed;
    prescribed.servo_y = {true, -force, k, 0.0, 1.0};
    group->prescribe(0, 1, prescribed);
    for (int block = 0; block < 200; ++block) group->advance();
    const double tolerance = precision == Precision::double_precision ? 1e-6 : 1e-4;
    EXPECT_NEAR(group->body(0, 1).force.y, -force, tolerance * force);
    EXPECT_NEAR(group->body(0, 0).force.y, force, tolerance * force);
    EXPECT_NEAR(group->body(0, 1).displacement.y, -force / k, tolerance * force / k);
    EXPECT_NEAR(group->row(0).energy_error, 0.0, 1e-3);
  }
}

}  // namespace
}  // namespace phy::engine
