#include "engine/energy_balance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/small_groups_fixture.hpp"

namespace phy::engine {
namespace {

using group::EnergyBalance;

/// A row that holds these energies [J/m].
HistoryRow holding(double kinetic, double linear, double bond, double joint, double wall) {
  HistoryRow r;
  r.kinetic = kinetic, r.strain_linear = linear, r.strain_bond = bond, r.strain_joint = joint;
  r.strain_wall = wall;
  return r;
}

TEST(EnergyBalance, IsTheFractionOfTheWorkThatIsLeftOver) {
  EnergyBalance e;
  e.begin(holding(1.0, 2.0, 3.0, 4.0, 7.0));  // 10 J/m; what the walls hold is let go when they are placed
  e.work = 5.0, e.slip = 0.5, e.damping = 0.25, e.released = 0.125;
  HistoryRow r = holding(2.0, 3.0, 4.0, 4.5, 0.5);  // 14 J/m: 4 more
  e.write(r);
  EXPECT_EQ(r.boundary_work, 5.0);
  EXPECT_EQ(r.slip, 0.5);
  EXPECT_EQ(r.damping, 0.25);
  EXPECT_EQ(r.released, 0.125);
  EXPECT_DOUBLE_EQ(r.energy_error, 0.125 / 5.0);  // 5 - 4 - 0.875
  e.work = 4.0;
  e.write(r);
  EXPECT_DOUBLE_EQ(r.energy_error, -0.875 / 4.0) << "more is there than was put in";
}

TEST(EnergyBalance, HasNoErrorWithoutWork) {
  EnergyBalance e;
  HistoryRow r = holding(1.0, 0.0, 0.0, 0.0, 0.0);
  for (const double work : {0.0, -1.0}) {
    e.work = work;
    e.write(r);
    EXPECT_EQ(r.energy_error, 0.0) << "a fraction of nothing, or of work taken out, says nothing";
  }
}

TEST(EnergyBalance, SettlesOnceAndBeginsAnew) {
  EnergyBalance e;
  e.begin(HistoryRow{});
  e.work = 100.0, e.slip = 1.0;
  e.settle();
  HistoryRow r = holding(0.0, 2.0, 3.0, 0.0, 4.0);
  e.write(r);
  EXPECT_EQ(r.boundary_work, 10.0) << "9 held, 1 slipped: that is what its state cost";
  EXPECT_EQ(r.energy_error, 0.0);
  r = holding(0.0, 2.0, 3.0, 0.0, 2.0);
  e.write(r);
  EXPECT_EQ(r.boundary_work, 10.0);
  EXPECT_DOUBLE_EQ(r.energy_error, 0.2);
  e.begin(r);
  EXPECT_EQ(e.work + e.slip + e.damping + e.released, 0.0);
}

// Two loose discs meet at a slant: what they lose is what friction and damping took, block after block, and
// their first motion is the work that was put in.
TEST(EnergyBalance, OfACollisionCloses) {
  constexpr double R = TwoDiscs::R, speed = 1.0;
  for (const Precision precision : both_precisions) {
    MatrixRecipe m;
    m.mu = 0.2;  // they slip all the time that they touch
    const auto s = shared(assembly({{R, R, R}, {(1.0 + 0.6 * 2.01) * R, (1.0 + 0.8 * 2.01) * R, R}}, m));
    Boundary boundary;
    boundary.bodies = {pusher(2, 1.0)};  // never placed: gives the first step its stiffness
    LaneSetup setup;
    setup.damping = 0.2, setup.step_safety = 0.02;
    setup.boundary = shared(boundary);
    const auto group = small_group(*s, precision, 20);
    group->load(0, s, setup);
    group->start_moving(0, [&](Vec2 x) { return Vec2{x.x < 1.5 * R ? speed : 0.0, 0.0}; });
    const double kinetic = 0.5 * m.density * pi * R * R * speed * speed;
    bool pressed = false;
    for (int block = 1; block <= 120; ++block) {
      group->advance();
      const HistoryRow& r = group->row(0);
      EXPECT_DOUBLE_EQ(r.boundary_work, kinetic);
      EXPECT_NEAR(r.kinetic + r.strain_linear + r.slip + r.damping, kinetic, 2e-3 * kinetic)
          << "after block " << block;
      EXPECT_NEAR(r.energy_error, 0.0, 2e-3) << "after block " << block;
      pressed = pressed || r.strain_linear > 0.1 * kinetic;
    }
    EXPECT_TRUE(pressed);
    EXPECT_GT(group->row(0).slip, 0.02 * kinetic);
    EXPECT_GT(group->row(0).damping, 0.02 * kinetic);
    EXPECT_EQ(group->row(0).strain_linear, 0.0) << "they have parted";
    EXPECT_NEAR(group->row(0).energy_error, 0.0, 5e-5) << "the error comes from the step, while they touch";
  }
}

/// Two discs with a bond, or a joint across their line, that grips pull apart so that step n - 1/2 would
/// carry it to its strength: it breaks in step n.
struct PulledBond {
  static constexpr double R = 3e-4;
  static constexpr int n = 350, interval = 100;
  double stiffness, strength, in_step;  // the last: they part by [m]
  std::unique_ptr<LaneGroup> group;

  PulledBond(bool joint, Precision precision) {
    const MatrixRecipe m;
    Specimen s = assembly({{R, R, R}, {3.0 * R, R, R}}, m);
    bond_touching(s);
    stiffness = m.E_b;  // E_b A/L, A = L = 2 R
    strength = m.sigma_c * 2.0 * R;
    if (joint) {
      s.bedding.resize(1);
      s.bedding[0].theta = 90.0;  // its normal is -x
      s.plane_label = {1, 0};
      s.contacts[0].kind = ContactKind::joint, s.contacts[0].side = -1;
      stiffness = s.bedding[0].k_n * 2.0 * R, strength = s.bedding[0].sigma_n * 2.0 * R;
    }
    in_step = strength / (stiffness * (n - 0.5));
    Boundary boundary;
    boundary.bodies.resize(2);
    for (std::uint32_t i = 0; i < 2; ++i) boundary.bodies[i].grips = {{i, true, true, true}};
    boundary.axial = {0, 1, {1.0, 0.0}, 0.0};
    LaneSetup setup;
    setup.boundary = shared(boundary);
    group = small_group(s, precision, interval);
    group->load(0, shared(s), setup);
    group->place_boundary(0);
    const double speed = 0.5 * in_step / group->time_step(0);
    for (const int body : {0, 1}) {
      PrescribedMotion prescribed;
      prescribed.velocity = {body == 0 ? -speed : speed, 0.0};
      group->prescribe(0, body, prescribed);
    }
  }
};

// The bond carries k n du when it breaks: it releases half its square over k. The bodies have felt the forces
// of all steps before, the last of them to nothing: work = sum over steps of the mean force times du.
void expect_balance_of(PulledBond& t, bool joint, double tolerance) {
  constexpr int n = PulledBond::n;
  const HistoryRow& r = t.group->row(0);
  const double& strain = joint ? r.strain_joint : r.strain_bond;
  for (int i = 0; i < 3; ++i) t.group->advance();
  EXPECT_TRUE(t.group->cracks(0).empty());
  const double held = 0.5 * t.stiffness * std::pow(300 * t.in_step, 2);
  EXPECT_NEAR(strain, held, tolerance * held);
  EXPECT_NEAR(r.boundary_work, held, tolerance * held);
  EXPECT_NEAR(t.group->body(0, 1).force.x, t.stiffness * 300 * t.in_step, tolerance * t.strength);
  for (int i = 0; i < 2; ++i) t.group->advance();
  ASSERT_EQ(t.group->cracks(0).size(), 1U);
  const Breakage& broken = t.group->cracks(0)[0];
  const double force = t.stiffness * n * t.in_step, released = 0.5 * force * force / t.stiffness;
  EXPECT_EQ(broken.crack.step, n);
  EXPECT_EQ(broken.crack.mode, CrackMode::tension);
  EXPECT_EQ(broken.crack.place, joint ? CrackPlace::bedding : CrackPlace::matrix);
  EXPECT_NEAR(broken.crack.energy, released, tolerance * released);
  EXPECT_NEAR(broken.travel, -n * t.in_step, tolerance * n * t.in_step) << "they part";
  EXPECT_DOUBLE_EQ(broken.crack.time, n * t.group->time_step(0));
  const double work = 0.5 * t.stiffness * t.in_step * t.in_step * n * (n - 1.0);
  EXPECT_EQ(r.released, broken.crack.energy);
  EXPECT_NEAR(r.boundary_work, work, tolerance * work);
  EXPECT_EQ(strain, 0.0);
  EXPECT_EQ(r.n_cracks, 1.0);
  EXPECT_NEAR(r.energy_error, (work - released - r.kinetic) / work, 2.0 * tolerance);
  EXPECT_LT(r.kinetic, 2e-4 * work) << "the grips' own motion, which nobody worked for";
}

TEST(EnergyBalance, OfABondThatIsPulledApart) {
  for (const bool joint : {false, true}) {
    PulledBond exact(joint, Precision::double_precision), coarse(joint, Precision::single_precision);
    expect_balance_of(exact, joint, 1e-9);
    expect_balance_of(coarse, joint, 1e-4);  // places that are sums of n steps
  }
}

}  // namespace
}  // namespace phy::engine
