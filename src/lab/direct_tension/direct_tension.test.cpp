// The tension room: what the grips hold and what they leave free, the start without a wave, the place of
// failure.
#include "lab/direct_tension/direct_tension.hpp"

#include <gtest/gtest.h>

#include "lab/direct_tension/reading.hpp"
#include "lab/procedure_fixture.hpp"

namespace phy::lab {
namespace {

const TestResult& pulled() {
  static const TestResult one = run_alone(small_rock(TestKind("direct_tension")));
  return one;
}

TEST(DirectTension, PeaksInTensionAndKeepsTheEnergyBalance) {
  const TestResult& r = pulled();
  ASSERT_EQ(r.outcome.status, Status::peaked) << r.outcome.reason;
  EXPECT_GT(number(r, "sigma_t").value, 10e6);
  EXPECT_LT(number(r, "sigma_t").value, 100e6);
  for (const HistoryRow& row : r.history.rows) EXPECT_LT(row.axial_strain, 0.0);
  EXPECT_LT(number(r, "energy_error").value, 1e-3);
  EXPECT_LT(number(r, "kinetic_ratio").value, 1e-2);
  EXPECT_EQ(number(r, "ucs").note, "absent");
}

// Grains in a grip move with it along the load, to the bit, and are free across it.
TEST(DirectTension, GripsHoldAlongTheLoadOnly) {
  const TestResult& r = pulled();
  const Recipe recipe = small_rock(TestKind("direct_tension"));
  const auto packing = small_packing(recipe);
  const TestBoundary pull = grips(*packing, grip_thickness(recipe, *packing));
  const engine::Boundary& boundary = pull.boundary;
  const std::vector<GrainState>& u = r.snapshots.back().grains;
  for (const engine::BoundaryBody& body : boundary.bodies) {
    ASSERT_GT(body.grips.size(), 10u);
    double least = 1.0, most = -1.0, turn = 0.0;
    for (const engine::Grip& p : body.grips) {
      EXPECT_NEAR(u[p.grain].uy, u[body.grips.front().grain].uy, 1e-15);
      least = std::min(least, u[p.grain].ux), most = std::max(most, u[p.grain].ux);
      turn = std::max(turn, std::fabs(u[p.grain].rotation));
    }
    EXPECT_GT(most - least, 1e-7) << "the end contracts or widens freely";
    EXPECT_GT(turn, 0.0);
  }
  const double opened = -r.history.rows.back().axial_strain * pull.axial.length;
  EXPECT_NEAR(u[boundary.bodies[1].grips.front().grain].uy - u[boundary.bodies[0].grips.front().grain].uy,
              opened, 1e-12);
}

// With the velocity field of uniform straining the stress rises evenly from the first row on: modulus from
// the first tenth of the strength as from its middle.
TEST(DirectTension, StartsWithoutAWave) {
  const TestResult& r = pulled();
  const double E = number(r, "E_tangent_platen").value, strength = number(r, "sigma_t").value;
  for (const HistoryRow& row : r.history.rows) {
    if (row.axial_stress < -0.2 * strength) break;
    EXPECT_NEAR(row.axial_stress, E * row.axial_strain, 0.02 * strength);
    EXPECT_NEAR(row.stress_top, row.stress_bottom, 0.02 * strength);
  }
}

// The linear part of a contact carries no tension, so rock is softer in tension than in compression.
TEST(DirectTension, IsSofterThanCompression) {
  const TestResult pressed = run_alone(small_rock(TestKind("uniaxial")));
  const double ratio = number(pulled(), "E_small").value / number(pressed, "E_small").value;
  EXPECT_GT(ratio, 0.4);
  EXPECT_LT(ratio, 0.7);
}

TEST(DirectTension, FailureAtTheGripIsSaid) {
  Recipe r = small_rock(TestKind("direct_tension"));
  r.test.grip_thickness = 0.0055;  // more than a recipe may have: it has to fail near a grip
  const TestResult result = run_alone(r);
  ASSERT_EQ(result.outcome.status, Status::peaked);
  EXPECT_GT(number(result, "failure_at_grip").value, 0.5);
  EXPECT_NE(number(result, "sigma_t").note.find("failed at the grip"), std::string::npos);
  r.test.grip_thickness = 0.0;
  r.bedding = {BeddingRecipe{}};  // one weak plane across the load, half-way up
  r.bedding.front().spacing = 0.02;
  const TestResult split = run_alone(r);
  EXPECT_NEAR(number(split, "failure_position").value, 0.5, 0.05);
  EXPECT_EQ(number(split, "failure_at_grip").value, 0.0);
  EXPECT_EQ(number(split, "sigma_t").note, "");
  EXPECT_LT(number(split, "sigma_t").value, 0.6 * number(pulled(), "sigma_t").value);
}

TEST(DirectTension, DefinitionsSpeakOfTension) {
  expect_speaks_of("tension", tension_numbers(marble_of("direct_tension"), {}, 0.001, {}));
}

}  // namespace
}  // namespace phy::lab
