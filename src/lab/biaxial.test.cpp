// The room of confined compression: target, energy, strength with confinement, sides.
#include "lab/biaxial.hpp"

#include <gtest/gtest.h>

#include "lab/rigs.hpp"
#include "lab/test_bench.test.hpp"

namespace phy {
namespace {

Recipe confined(double stress, Confinement sides) {
  Recipe r = small_rock(TestKind::biaxial);
  r.test.confining_stress = stress;
  r.test.confinement = sides;
  r.test.platen_speed = 0.02;
  return r;
}

// Without confining stress nothing is left but the press: the same cracks at the same strains, to the bit.
TEST(Biaxial, WithoutConfiningStressIsThePress) {
  const TestResult press = [] {
    Recipe r = small_rock(TestKind::uniaxial);
    r.test.platen_speed = 0.02;
    return run_alone(r);
  }();
  const TestResult free = run_alone(confined(0.0, Confinement::walls));
  EXPECT_EQ(number(free, "q_max").value, number(press, "ucs").value);
  ASSERT_EQ(free.cracks.size(), press.cracks.size());
  EXPECT_EQ(free.cracks.back().strain, press.cracks.back().strain);
  EXPECT_EQ(number(free, "confinement_error").note, "not confined");
}

TEST(Biaxial, JacketKeepsTheStressAndTheBooks) {
  const TestResult r = run_alone(confined(10e6, Confinement::jacket));
  ASSERT_EQ(r.outcome.status, Status::peaked) << r.outcome.reason;
  EXPECT_EQ(r.outcome.reason.find("peak deviatoric stress "), 0u) << r.outcome.reason;
  EXPECT_EQ(number(r, "sigma_3").value, 10e6);
  EXPECT_EQ(number(r, "confinement_error").value, 0.0);
  EXPECT_LT(number(r, "energy_error").value, 1e-3);
  EXPECT_NEAR(number(r, "sigma_1").value - 10e6, number(r, "q_max").value, 1e-3);
  const HistoryRow& first = r.history.rows.front();
  EXPECT_LT(std::fabs(first.axial_strain), 1e-5) << "strains count from the confined state";
  EXPECT_NEAR(first.axial_stress / 10e6, 1.0, 0.05);
  double most = 0.0;
  for (const HistoryRow& row : r.history.rows) most = std::max(most, row.volumetric_strain);
  EXPECT_GT(most, 0.0) << "shortens before it dilates";
}

TEST(Biaxial, WallsKeepTheBooksAndConfinementStrengthens) {
  const TestResult free = run_alone(confined(0.0, Confinement::walls));
  Recipe r = confined(10e6, Confinement::walls);
  r.engine.step_safety = 0.46;  // 330 grains fail at once: the burst alone costs up to 1.3e-3 at the usual
                                // step, in the press as well, and a third of it at half the step
  const TestResult walls = run_alone(r);
  ASSERT_EQ(walls.outcome.status, Status::peaked) << walls.outcome.reason;
  EXPECT_LT(number(walls, "confinement_error").value, 1e-3);
  for (const HistoryRow& row : walls.history.rows)
    ASSERT_NEAR(row.lateral_stress / 10e6, 1.0, 1e-3) << "after the peak too, at " << row.axial_strain;
  EXPECT_LT(number(walls, "energy_error").value, 1e-3);
  EXPECT_GT(number(walls, "sigma_1").value, number(free, "sigma_1").value + 10e6);
  EXPECT_NEAR(number(walls, "E_tangent").value / number(free, "E_tangent").value, 1.0, 0.15);
}

// Not the mean of two walls alone: each presses with its stress, in every step of every block.
TEST(Biaxial, EachWallPressesWithItsStress) {
  const Recipe r = confined(5e6, Confinement::walls);
  const auto specimen = std::make_shared<const Specimen>(make_specimens(small_packing(r), r).front());
  GroupOptions options;
  options.isa = native_isa();
  options.interval = static_cast<int>(r.test.history_interval);
  const auto group = make_group(specimen->packing, options);
  const auto test = make_test(specimen, r, *group, 0);
  double least = 1e9, most = 0.0;
  for (bool over = false; !over;) {
    group->advance();
    over = test->after_block();
    if (test->latest().strain <= 0.0) continue;  // still preparing
    for (const int wall : {2, 3})
      for (const Vec2 force : {group->tool(0, wall).force, group->tool(0, wall).mean_force}) {
        const double stress = (wall == 2 ? force.x : -force.x) / specimen->packing->height;
        least = std::min(least, stress), most = std::max(most, stress);
      }
  }
  EXPECT_GT(least, 0.999 * 5e6);
  EXPECT_LT(most, 1.001 * 5e6);
  EXPECT_GT(group->row(0).n_cracks, 20.0) << "rock has broken";
}

// The jacket presses on the whole height from both sides, and on side grains only.
TEST(Biaxial, JacketCoversTheSides) {
  const Recipe r = confined(10e6, Confinement::jacket);
  const auto packing = small_packing(r);
  const Rig rig = confined_platens(*packing, r.test);
  double left = 0.0, right = 0.0;
  for (const GrainLoad& p : rig.loads) {
    const double x = packing->discs[p.grain].x;
    (p.length.x > 0.0 ? left : right) += std::fabs(p.length.x);
    EXPECT_LT(std::min(x, packing->width - x), 4.0 * r.packing.radius_max);
  }
  EXPECT_NEAR(left, packing->height, 1e-12);
  EXPECT_NEAR(right, packing->height, 1e-12);
}

}  // namespace
}  // namespace phy
