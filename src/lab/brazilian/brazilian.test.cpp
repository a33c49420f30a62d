// The Brazilian room: the disc, jaws and platens, validity.
#include "lab/brazilian/brazilian.hpp"

#include <gtest/gtest.h>

#include "base/exact_math.hpp"
#include "genesis/cut.hpp"
#include "lab/brazilian/reading.hpp"
#include "lab/procedure_fixture.hpp"

namespace phy::lab {
namespace {

Recipe small_disc() {
  Recipe r = small_rock(TestKind("brazilian"));
  r.specimen = {0.012, 0.012};
  r.packing.n_grains = 371;
  r.test.platen_speed = 0.02;
  return r;
}

TEST(CutDisc, HoldsItsShareOfTheRockCentreOnCentre) {
  Recipe r = small_disc();
  r.specimen = {0.016, 0.02}, r.packing.n_grains = 825;
  const auto packing = small_packing(r);
  const double D = 0.014;
  const Packing disc = genesis::cut_disc(*packing, D);
  double area = 0.0, whole = 0.0;
  for (const Disc& d : packing->discs) whole += pi * d.r * d.r;
  for (const Disc& d : disc.discs) {
    area += pi * d.r * d.r;
    EXPECT_LE(norm(Vec2{d.x - 0.5 * disc.width, d.y - 0.5 * disc.height}), 0.5 * D + 1e-12);
    EXPECT_GE(std::min({d.x, d.y, disc.width - d.x, disc.height - d.y}), d.r);
  }
  EXPECT_NEAR(area / (pi / 4.0 * D * D), whole / (0.016 * 0.02), 0.03);
  EXPECT_EQ(disc.width, disc.height);
  EXPECT_NE(disc.hash, packing->hash);
}

TEST(Brazilian, SplitsAndKeepsTheEnergyBalance) {
  const TestResult r = run_alone(small_disc());
  ASSERT_EQ(r.outcome.status, Status::peaked) << r.outcome.reason;
  EXPECT_GT(number(r, "bts").value, 5e6);
  EXPECT_LT(number(r, "bts").value, 80e6);
  EXPECT_LT(number(r, "energy_error").value, 1.3e-3);
  // The note follows from the place of the first crack, nothing else.
  const bool central = std::fmax(std::fabs(number(r, "first_crack_y").value),
                                 std::fabs(number(r, "first_crack_x").value)) <= 1.0 / 6.0;
  EXPECT_EQ(number(r, "bts").note.empty(), central);
}

// A weak plane along the load through the centre: it opens first in the middle, where the tension is.
TEST(Brazilian, WeakPlaneAlongTheLoadSplitsAtALowerStress) {
  Recipe r = small_disc();
  const double intact = number(run_alone(r), "bts").value;
  r.bedding.resize(1);
  r.bedding.front().theta = 90.0, r.bedding.front().spacing = 0.05;
  EXPECT_LT(number(run_alone(r), "bts").value, 0.7 * intact);
}

TEST(Brazilian, JawsHoldTheirArcAndFlatPlatensTheOutermostGrain) {
  const Recipe r = small_disc();
  const Packing disc = genesis::cut_disc(*small_packing(r), disc_diameter(r));
  const Vec2 centre{0.5 * disc.width, 0.5 * disc.height};
  const engine::Boundary wide = jaws(disc, disc_diameter(r), 20.0).boundary,
                         flat = jaws(disc, disc_diameter(r), 0.0).boundary;
  for (const engine::BoundaryBody& body : wide.bodies) {
    EXPECT_GE(body.touches.size(), 3u);
    EXPECT_LE(body.touches.size(), 8u);
    for (const engine::Touch& t : body.touches) {
      const Vec2 out = Vec2{disc.discs[t.grain].x, disc.discs[t.grain].y} - centre;
      EXPECT_NEAR(dot(out, t.normal), -norm(out), 1e-12) << "along the radius, inwards";
      EXPECT_LT(std::fabs(out.x / out.y), std::tan(0.24)) << "within the arc and a radius beside it";
    }
  }
  for (const engine::BoundaryBody& body : flat.bodies) {
    double least = 1.0;
    for (const engine::Touch& t : body.touches) least = std::min(least, t.gap);
    EXPECT_NEAR(least, 0.0, 1e-15);
  }
}

// What the steps of time leave unaccounted for falls with them.
TEST(Brazilian, TheEnergyErrorIsThatOfTheTimeStep) {
  Recipe r = small_disc();
  const double usual = number(run_alone(r), "energy_error").value;
  r.engine.step_safety *= 0.5;
  EXPECT_LT(number(run_alone(r), "energy_error").value, 0.6 * usual);
}

// Oblique bedding pushes the disc sideways. What does not hold it lets it roll out while it is loaded, and
// the strength then depends on how long that takes.
TEST(Brazilian, JawsHoldTheDisc) {
  Recipe r = small_disc();
  r.bedding.resize(1);
  r.bedding.front().theta = 60.0;
  const auto bts = [&r](double speed) {
    r.test.platen_speed = speed;
    return number(run_alone(r), "bts").value;
  };
  const double usual = bts(0.04);
  EXPECT_NEAR(bts(0.008) / usual, 1.0, 0.01);
  r.test.jaw_friction = 0.0;
  EXPECT_LT(bts(0.008), 0.8 * usual);
}

TEST(Brazilian, DefinitionsSpeakOfTheTensionAtTheCentre) {
  expect_speaks_of("tension at the centre of an elastic disc",
                   disc_numbers(marble_of("brazilian"), {}, 0.1, 2700.0));
}

}  // namespace
}  // namespace phy::lab
