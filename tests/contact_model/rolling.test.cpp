// A contact model that the program does not know, put into its press.
#include "rolling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/exact_math.hpp"
#include "engine/force_loop.hpp"
#include "engine/lane_group.hpp"
#include "engine/wide_loop.hpp"
#include "genesis/packing.hpp"
#include "genesis/specimen.hpp"
#include "lab/tests.hpp"
#include "records/assembly.hpp"
#include "statics/system.hpp"

namespace phy {
namespace {

using Combination = contact::Combination<contact::Rolling, contact::SmoothJoint>;

const engine::ContactPhysics rolling{contact::models<Combination>(),
                                     [](engine::Isa, int lanes) -> engine::Kernel<double> {
                                       if (lanes == 1) return {engine::advance_block<double, Combination>};
                                       return {engine::advance_block<Pack<double, 4>, Combination>};
                                     },
                                     [](engine::Isa, int lanes) -> engine::Kernel<float> {
                                       if (lanes == 1)
                                         return {engine::advance_wide<Pack<float, 4>, Combination>, 4};
                                       return {engine::advance_block<Pack<float, 4>, Combination>};
                                     }};

constexpr double R = 3e-4;

/// Two discs pressed on each other by their overlap, the first one held, the second free to turn only, which
/// it does at `spin`. Damping 0.
std::unique_ptr<engine::LaneGroup> turning(double overlap, double spin, int lanes, Precision precision) {
  MatrixRecipe m;
  m.mu = 0.0;
  Specimen s = assembly({{R, R, R}, {3.0 * R - overlap, R, R}}, m);
  auto packing = std::make_shared<Packing>(*s.packing);
  packing->stress_free = false;
  s.packing = packing;
  s.contacts = {{0, 1, ContactKind::touching}};
  engine::Boundary boundary;
  boundary.bodies = {engine::BoundaryBody{"held", {}, {{0, true, true, true}}},
                     engine::BoundaryBody{"axle", {}, {{1, true, true, false}}}};
  engine::GroupOptions options;
  options.lanes = lanes;
  options.precision = precision;
  options.interval = 10;
  options.contacts = &rolling;
  auto group = engine::make_group(s.packing, options);
  engine::LaneSetup setup;
  setup.damping = 0.0, setup.step_safety = 0.01;  // rolling counts from the second step on
  setup.boundary = std::make_shared<const engine::Boundary>(boundary);
  const int lane = lanes - 1;
  group->load(lane, std::make_shared<const Specimen>(s), setup);
  group->place_boundary(lane);
  group->set_motion(lane, 1, {}, {0.0, 0.0}, spin);
  return group;
}

// The couple grows as a spring to M = mu_r r F_n and stays there until the disc has spent its energy:
//   1/2 I w^2 = M^2/(2 k_r) + M (turn - M/k_r)
// and then swings as a spring about the place where it holds.
TEST(RollingResistance, ATurningDiscStopsWhereItsEnergyIsSpent) {
  const MatrixRecipe m;
  const double overlap = 1e-3 * R, mass = m.density * pi * R * R, I = 0.5 * mass * R * R;
  const double M = contact::Rolling::rolling_friction * R * m.E_c * overlap;
  const double k_r = contact::Rolling::rolling_stiffness, slow = M / std::sqrt(k_r * I), spin = 3.0 * slow;
  const double turn = (0.5 * I * spin * spin - 0.5 * M * M / k_r) / M + M / k_r;
  struct Case {
    int lanes;
    Precision precision;
    double exact;
  };
  for (const Case& c :
       {Case{1, Precision::double_precision, 2e-3}, Case{4, Precision::double_precision, 2e-3},
        Case{4, Precision::single_precision, 5e-3}}) {
    const auto group = turning(overlap, spin, c.lanes, c.precision);
    const int lane = c.lanes - 1;
    const double energy = 0.5 * I * spin * spin, time = 4.0 * spin * I / M;
    double most = 0.0;
    while (group->row(lane).time < time) {
      group->advance();
      ASSERT_TRUE(group->health(lane).ok) << group->health(lane).reason;
      most = std::max(most, group->grains(lane)[1].rotation);
    }
    const HistoryRow& r = group->row(lane);
    EXPECT_NEAR(most, turn, c.exact * turn);
    EXPECT_NEAR(r.slip, M * (turn - M / k_r), c.exact * energy);
    const double swing = r.kinetic + r.strain_linear - 0.5 * m.E_c * overlap * overlap;
    EXPECT_NEAR(swing, 0.5 * M * M / k_r, c.exact * energy);
  }
}

// Two grains on different sides of a plane that have met and rolled on each other within a block become a
// broken interface at its end, whatever the matrix model remembers.
TEST(RollingResistance, MeetsAcrossAPlaneAsABrokenInterface) {
  const double gap = 0.03 * R;
  Specimen s = assembly({{R, R, R}, {3.0 * R + gap, R, R}}, MatrixRecipe{});
  BeddingRecipe set;
  set.theta = 90.0;  // its normal is (-1, 0)
  s.bedding = {set};
  s.plane_label = {1, 0};
  engine::GroupOptions options;
  options.interval = 50;
  options.contacts = &rolling;
  auto group = engine::make_group(s.packing, options);
  engine::Boundary boundary;  // of no effect but on the step: without any contact there would be none
  boundary.bodies = {engine::BoundaryBody{"near", {{0, {1.0, 0.0}, 0.5 * R}}, {}}};
  engine::LaneSetup setup;
  setup.damping = 0.0, setup.step_safety = 0.02;  // a collision lasts longer than a block
  setup.boundary = std::make_shared<const engine::Boundary>(boundary);
  group->load(0, std::make_shared<const Specimen>(s), setup);
  const double speed = 2.0 * gap / (50.0 * group->time_step(0));  // halfway through the block they meet
  group->set_motion(0, 0, {}, {speed, 0.0}, 30.0);
  group->set_motion(0, 1, {}, {0.0, 0.0}, 90.0);
  group->advance();
  ASSERT_TRUE(group->health(0).ok) << group->health(0).reason;
  const Snapshot met = group->snapshot(0);
  ASSERT_EQ(met.contacts.size(), 1u);
  EXPECT_EQ(met.contacts[0].kind, ContactKind::joint);
  EXPECT_TRUE(met.contacts[0].broken);
  EXPECT_NEAR(met.contacts[0].normal.x, 1.0, 1e-15);
}

// Loose grains in the uniaxial press: what the bodies put in is all accounted for.
TEST(RollingResistance, RunsInThePress) {
  Recipe recipe;
  recipe.specimen = {0.010, 0.020};
  recipe.packing.n_grains = 0, recipe.packing.porosity = 0.12;
  recipe.packing.radius_min = 0.0004, recipe.packing.radius_max = 0.0006;
  recipe.test.max_strain = 0.004, recipe.test.platen_speed = 0.1;
  const auto packing =
      std::make_shared<const Packing>(genesis::make_packing(recipe.specimen, recipe.packing, recipe.matrix));
  const auto specimen = std::make_shared<const Specimen>(genesis::make_specimens(packing, recipe).front());
  engine::GroupOptions options;
  options.contacts = &rolling;
  const auto group = engine::make_group(packing, options);
  const auto test = lab::make_test(specimen, recipe, *group, 0);
  do group->advance();
  while (!test->after_block());
  const TestResult result = test->take_result();
  ASSERT_GT(result.history.rows.size(), 10u);
  EXPECT_GT(result.history.rows.back().axial_stress, 0.0);
  EXPECT_LT(std::fabs(result.history.rows.back().energy_error), 5e-3);
  EXPECT_EQ(result.cracks.size(), 0u);
}

// The direct solution of a cantilever of such grains, its tip turned by a couple C: rolling springs in
// series, and no deflection but that of the turning (a frictional chain that sticks).
TEST(RollingResistance, CantileverOfTheDirectSolution) {
  const std::uint32_t n = 6;
  std::vector<Disc> discs;
  for (std::uint32_t i = 0; i <= n; ++i) discs.push_back({R + 2.0 * R * i, R, R});
  Specimen s = assembly(discs, MatrixRecipe{});
  bond_touching(s);
  const statics::Network net = statics::make_network(s, {}, rolling.models);
  statics::Boundary boundary;
  statics::move_with(boundary, net, 0, {});
  const double C = 1e-3, N = n;
  boundary.loads = {{{n, 2}, C}};
  const statics::LoadCase answer = statics::solve_once(net, boundary);
  ASSERT_TRUE(answer.outcome.ok()) << answer.outcome.reason;
  const double turn = N * C / contact::Rolling::rolling_stiffness;
  EXPECT_NEAR(answer.u[3 * n + 2], turn, 1e-9 * turn);
  EXPECT_NEAR(answer.u[3 * n + 1], N * R * turn, 1e-9 * N * R * turn);
}

}  // namespace
}  // namespace phy
