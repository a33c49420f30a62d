// The room of an opening under stress: the elastic block against Kirsch, relaxation, breakout and collapse.
#include "lab/opening/opening.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "base/exact_math.hpp"
#include "lab/opening/reading.hpp"
#include "lab/procedure_fixture.hpp"
#include "records/quality.hpp"

namespace phy::lab {
namespace {

/// A square block of 24 mm with a hole of 8 mm: six mean grain diameters in the radius.
Recipe block(double vertical, double horizontal) {
  Recipe r;
  r.specimen = {0.024, 0.024};
  r.test.opening_diameter = 0.008;
  r.packing.n_grains = 1500;
  r.test.kind = TestKind("opening");
  r.test.vertical_stress = vertical, r.test.horizontal_stress = horizontal;
  r.test.platen_speed = 0.05, r.test.history_interval = 50;
  return r;
}

double mean_of(const TestResult& r, double WallPoint::*value) {
  double sum = 0.0, n = 0.0;
  for (const WallPoint& p : r.wall)
    if (p.moment == WallMoment::standing) sum += p.*value, n += 1.0;
  return sum / n;
}

// A pressure as high as the stress of the rock takes nothing away: there is no closure, and the rock behind
// the wall has the stress of the far field all round.
TEST(Opening, FullySupportedDoesNotMove) {
  Recipe r = block(20e6, 20e6);
  r.matrix.unbreakable = true;
  const TestResult bare = run_alone(r);
  r.test.internal_pressure = 20e6;
  const TestResult held = run_alone(r);
  ASSERT_EQ(held.outcome.reason, "nothing can break: the opening stands");
  EXPECT_LT(std::fabs(number(held, "closure").value), 0.02 * number(bare, "closure").value);
  // Of one packing, six grains in the radius: the mean of many is 1.
  EXPECT_NEAR(mean_of(held, &WallPoint::hoop) / 20e6, 1.0, 0.1);
  EXPECT_NEAR(mean_of(held, &WallPoint::radial) / 20e6, 1.0, 0.05);
  EXPECT_LT(number(bare, "energy_error").value, 1e-3);
  for (const TestResult* t : {&bare, &held}) {
    EXPECT_TRUE(std::isnan(number(*t, "collapse_stress").value)) << "it stands";
    EXPECT_EQ(t->outcome.reason, "nothing can break: the opening stands");
  }
}

// A pressure far above the stress of the rock bursts it, and there is nothing left to raise.
TEST(Opening, BurstsUnderAPressureAboveItsStress) {
  Recipe r = block(20e6, 20e6);
  r.test.internal_pressure = 150e6;
  const TestResult t = run_alone(r);
  EXPECT_EQ(t.outcome.status, Status::not_peaked) << t.outcome.reason;
  EXPECT_NE(t.outcome.reason.find("widening by 5."), std::string::npos) << t.outcome.reason;
  EXPECT_LT(number(t, "closure_at_end").value, -0.05);
  EXPECT_TRUE(std::isnan(number(t, "collapse_stress").value));
}

// In proportion: the same rock under twice the stress closes by twice as much.
TEST(Opening, OfElasticRockIsLinear) {
  Recipe r = block(10e6, 5e6);
  r.matrix.unbreakable = true;
  const TestResult one = run_alone(r);
  r.test.vertical_stress *= 2.0, r.test.horizontal_stress *= 2.0;
  const TestResult two = run_alone(r);
  for (const char* name : {"closure", "hoop_max", "hoop_min"})
    EXPECT_NEAR(number(two, name).value / number(one, name).value, 2.0, 0.02) << name;
  // Most at the ends of the horizontal diameter, least where the larger stress comes from.
  EXPECT_NEAR(std::cos(2.0 * number(one, "hoop_max_direction").value * pi / 180.0), 1.0, 0.3);
  EXPECT_NEAR(std::cos(2.0 * number(one, "hoop_min_direction").value * pi / 180.0), -1.0, 0.3);
}

// Rock that bears its stress breaks when it is raised: where the hoop stress is largest.
TEST(Opening, CollapsesWhenTheStressIsRaised) {
  Recipe r = block(20e6, 10e6);
  const TestResult t = run_alone(r);
  ASSERT_EQ(t.outcome.status, Status::peaked) << t.outcome.reason;
  EXPECT_GT(number(t, "collapse_factor").value, 1.0);
  EXPECT_NEAR(number(t, "collapse_stress").value, 20e6 * number(t, "collapse_factor").value, 1.0);
  EXPECT_EQ(number(t, "breakout_depth").value, 0.0) << "it stood";
  EXPECT_GT(number(t, "breakout_depth_at_end").value, 0.0);
  EXPECT_LT(number(t, "energy_error").value, 1e-3);
  // Strength grows with the speed of the walls: the quality marks have to see it.
  EXPECT_GT(number(t, "wave_transits").value, 10.0);
  r.test.platen_speed *= 4.0;
  EXPECT_LT(number(run_alone(r), "wave_transits").value, 0.5 * number(t, "wave_transits").value);
  double most = 0.0;
  for (const HistoryRow& row : t.history.rows) {
    EXPECT_GE(row.excavated, most) << "what is taken away stays away";
    most = row.excavated;
    if (row.excavated < 1.0 || row.borne_stress < 1.02 * 20e6) continue;
    EXPECT_NEAR(row.lateral_stress / row.axial_stress, 0.5, 0.02) << row.axial_strain;
  }
  EXPECT_EQ(most, 1.0);
}

// Weak rock closes when it is excavated, and the test says so.
TEST(Opening, OfWeakRockDoesNotStand) {
  Recipe r = block(40e6, 40e6);
  r.matrix.sigma_c = r.matrix.tau_c = 6e6, r.matrix.sigma_c_sd = r.matrix.tau_c_sd = 0.6e6;
  r.matrix.mu = 0.1;
  const TestResult t = run_alone(r);
  ASSERT_EQ(t.outcome.status, Status::peaked) << t.outcome.reason;
  EXPECT_LE(number(t, "collapse_factor").value, 1.0) << t.outcome.reason;
  EXPECT_EQ(t.outcome.reason.find("closure of 5."), 0U) << t.outcome.reason;
  EXPECT_TRUE(std::isnan(number(t, "closure").value));
  EXPECT_EQ(number(t, "closure").note, "it did not stand");
  // With a support it stands.
  r.test.internal_pressure = 30e6;
  EXPECT_TRUE(std::isfinite(number(run_alone(r), "closure").value));
}

// The mean of two pieces that fell far apart is a direction in which nothing fell.
TEST(Opening, HasADirectionOfBreakoutWhereThereIsAnAxis) {
  const auto numbers = [](const std::vector<double>& at) {
    std::vector<double> depths(n_wall_sectors, 0.0);
    for (const double angle : at) depths[static_cast<std::size_t>(angle / 10.0)] = 1e-3;
    OpeningState state;
    for (int k = 0; k < n_wall_sectors; ++k) state.points.push_back({WallMoment::standing, 10.0 * k});
    state.breakout = analysis::breakout_of(depths, 1e-4);
    History history;
    history.kind = TestKind("opening");
    TestResult t;
    t.numbers = opening_numbers(history, {}, {20e6, 4e-3, false, state, state, {}}, 0.5e-3);
    return t;
  };
  const TestResult sides = numbers({0.0, 10.0, 180.0, 350.0}), apart = numbers({50.0, 160.0});
  EXPECT_NEAR(std::fmod(number(sides, "breakout_direction").value + 90.0, 180.0), 90.0, 5.0);
  EXPECT_TRUE(std::isnan(number(apart, "breakout_direction").value));
  EXPECT_EQ(number(apart, "breakout_direction_at_end").note, "on no clear axis");
  EXPECT_EQ(number(apart, "breakout_depth").value, 0.25);
}

// Layers that slide out leave a hole in a block of two halves: its strength is no longer the opening's.
TEST(Opening, RockThatReachesTheEdgeIsMarked) {
  OpeningState state;
  for (int k = 0; k < n_wall_sectors; ++k) state.points.push_back({WallMoment::end, 10.0 * k});
  const auto marks = [&] {
    History history;
    history.kind = TestKind("opening");
    return quality_marks(opening_numbers(history, {}, {20e6, 10e-3, true, state, state, {}}, 0.5e-3));
  };
  EXPECT_TRUE(marks().empty());
  for (int k = 20; k < 29; ++k)
    state.points[static_cast<std::size_t>(k)].breakout = std::numeric_limits<double>::infinity();
  ASSERT_EQ(marks().size(), 1U);
  EXPECT_EQ(marks().front().text(),
            "wall_to_edge 0.25, above 0: rock has slid out to the edge of the block, and the collapse may be "
            "the block's");
}

TEST(Opening, CracksOfTheFarFieldAreNoneOfTheExcavation) {
  History history;
  history.kind = TestKind("opening");
  for (const auto& [step, strain, stress] :
       {std::array{100.0, 0.0, 0.0}, {200.0, 1e-4, 10e6}, {300.0, 2e-4, 20e6}, {400.0, 3e-4, 5e6}}) {
    HistoryRow& row = history.rows.emplace_back();
    row.step = step, row.axial_strain = strain, row.borne_stress = stress;
  }
  std::vector<CrackEvent> cracks(7);
  for (std::size_t i = 0; i < cracks.size(); ++i)
    cracks[i].step = i < 4 ? 50 : 250, cracks[i].strain = i < 4 ? -1e-5 : 1.5e-4;
  TestResult t;
  t.numbers = opening_numbers(history, cracks, {20e6, 4e-3, true, {}, {}, {}}, 0.5e-3);
  EXPECT_NEAR(number(t, "sigma_ci").value, 15e6, 1.0);
  EXPECT_NEAR(number(t, "sigma_first_crack").value, 15e6, 1.0);
}

// A stress that the rock does not bear without an opening, or a user who stops early: there is no wall to
// read.
TEST(Opening, EndsBeforeTheExcavationBegins) {
  Recipe r = block(20e6, 20e6);
  const auto specimen =
      std::make_shared<const Specimen>(genesis::make_specimens(small_packing(r), r).front());
  engine::GroupOptions options;
  options.isa = engine::native_isa();
  options.interval = static_cast<int>(r.test.history_interval);
  const auto group = engine::make_group(specimen->packing, options);
  const auto test = make_test(specimen, r, *group, 0);
  group->advance();
  ASSERT_FALSE(test->after_block());
  test->interrupt();
  const TestResult t = test->take_result();
  EXPECT_EQ(t.outcome.status, Status::interrupted);
  EXPECT_TRUE(t.wall.empty());
  for (const char* name : {"closure", "closure_at_end", "breakout_depth_at_end"})
    EXPECT_EQ(number(t, name).note, "the excavation did not begin") << name;
}

}  // namespace
}  // namespace phy::lab
