// Acoustic events of the engine's contacts and of a test.
#include <gtest/gtest.h>

#include <cmath>

#include "analysis/specimen_checks.hpp"
#include "engine/small_groups_fixture.hpp"
#include "events/forces.hpp"
#include "events/source.hpp"
#include "lab/procedure_fixture.hpp"

namespace phy::lab {
namespace {

constexpr double R = 3e-4;

/// Two bonded discs 0 and 1 along x among the six that touch them in a square lattice, all held by bodies.
/// The two are moved apart, by `way` of the first.
MomentTensor moved_apart(Vec2 way) {
  const MatrixRecipe m;
  std::vector<Disc> discs;
  const auto add = [&](double x, double y) { discs.push_back({(x + 5.0) * R, (y + 5.0) * R, R}); };
  add(-1, 0), add(1, 0), add(-3, 0), add(3, 0), add(-1, -2), add(1, -2), add(-1, 2), add(1, 2);
  Specimen s = assembly(discs, m);
  bond_touching(s);
  engine::Boundary boundary;
  boundary.bodies.resize(3);
  for (std::uint32_t i = 0; i < 8; ++i) boundary.bodies[i < 2 ? i : 2].grips.push_back({i, true, true, true});
  boundary.axial = {0, 1, {1.0, 0.0}, 0.0};
  engine::LaneSetup setup;
  setup.boundary = engine::shared(boundary);
  const int interval = 100;
  const auto group = engine::small_group(s, Precision::double_precision, interval);
  group->load(0, engine::shared(s), setup);
  group->place_boundary(0);
  for (const int body : {0, 1}) {
    engine::PrescribedMotion prescribed;
    prescribed.velocity = ((body == 0 ? 1.0 : -1.0) / (interval * group->time_step(0))) * way;
    group->prescribe(0, body, prescribed);
  }
  const events::Forces before = events::forces_of(*s.packing, group->snapshot(0));
  group->advance();
  const std::uint32_t source[] = {0, 1};
  return events::moment_tensor(source, {5.0 * R, 5.0 * R}, before,
                               events::forces_of(*s.packing, group->snapshot(0)));
}

// In a lattice the contacts are springs: E_c + E_b where they close, E_b where they open, E_b k_s/k_n across.
// Each disc closes one contact 2 R away and drags at two that are R away along x.
TEST(AcousticEvents, ADipolePutInByHandHasItsTensor) {
  const MatrixRecipe m;
  const double way = 1e-5 * R, k_n = m.E_c + m.E_b, k_s = m.E_b * m.bond_ks_over_kn;
  const MomentTensor t = moved_apart({-way, 0.0});
  const double xx = 4.0 * R * way * (k_n + k_s);
  RecordProperty("error_ppm", static_cast<int>(1e6 * std::fabs(t.xx / xx - 1.0)));
  EXPECT_NEAR(t.xx, xx, 0.01 * xx);
  EXPECT_NEAR(t.xy, 0.0, 0.01 * xx);
  EXPECT_NEAR(t.yy, 0.0, 0.01 * xx);
  EXPECT_EQ(events::type_of(events::volume_share(t)), SourceType::opening);
}

// Moved past each other, a down and b up: each drags at one contact 2 R away, closes one and opens another R
// away. The contacts that close push outwards more than the others pull inwards.
TEST(AcousticEvents, ACouplePutInByHandHasItsTensor) {
  const MatrixRecipe m;
  const double way = 1e-5 * R, closing = m.E_c + m.E_b, opening = m.E_b, k_s = m.E_b * m.bond_ks_over_kn;
  const MomentTensor t = moved_apart({0.0, -way});
  const double yx = R * way * (4.0 * k_s + 2.0 * (closing + opening));
  RecordProperty("error_ppm", static_cast<int>(1e6 * std::fabs(2.0 * t.xy / yx - 1.0)));
  EXPECT_NEAR(t.xy, 0.5 * yx, 0.01 * yx);
  EXPECT_NEAR(t.xx, 0.0, 0.01 * yx);
  EXPECT_NEAR(t.yy, 2.0 * R * way * (closing - opening), 0.01 * yx);
}

// Listening changes no bit of a test, and every crack under load belongs to one event.
TEST(AcousticEvents, AreHeardInATestThatTheyDoNotChange) {
  Recipe r = small_rock(TestKind("uniaxial"));
  r.test.history_interval = 50;
  const TestResult deaf = run_alone(r);
  r.test.events = true;
  const TestResult heard = run_alone(r);
  EXPECT_EQ(heard.hash, deaf.hash);
  EXPECT_TRUE(deaf.events.empty());
  std::int64_t n_cracks = 0;
  for (const AcousticEvent& e : heard.events) n_cracks += e.n_cracks;
  EXPECT_EQ(n_cracks, static_cast<std::int64_t>(heard.cracks.size()));
  EXPECT_EQ(number(heard, "n_events").value, static_cast<double>(heard.events.size()));
  EXPECT_NEAR(number(heard, "event_thickness").value,
              analysis::grain_diameter(genesis::make_specimens(small_packing(r), r).front()), 1e-12);
  for (std::size_t i = 0; i < heard.events.size(); ++i) {
    EXPECT_GT(heard.events[i].moment, 0.0) << i;
    EXPECT_LE(heard.events[i > 0 ? i - 1 : i].time, heard.events[i].time);
  }
}

}  // namespace
}  // namespace phy::lab
