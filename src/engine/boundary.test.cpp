// Tools: in balance, and under the servo.
#include <gtest/gtest.h>

#include "contact/wall.hpp"
#include "engine/small_groups.test.hpp"

namespace phy::engine {
namespace {

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
