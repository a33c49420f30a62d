// What the watchdog sees, each of its checks made to fire by the engine itself, and what it leaves: the last
// row that had passed, and its neighbours untouched.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contact/wall.hpp"
#include "engine/small_groups_fixture.hpp"

namespace phy::engine {
namespace {

using testing::HasSubstr;

constexpr double R = TwoDiscs::R, skin = TwoDiscs::skin;

/// The row is `good` in all but step and time, and these are those of `block`, in blocks of `steps`.
void expect_last_good(const LaneGroup& group, const HistoryRow& good, int block, int steps) {
  const HistoryRow& r = group.row(0);
  EXPECT_EQ(r.step, block * steps);
  EXPECT_GT(r.time, good.time);
  for (const HistoryColumns& columns : {gauge_columns(), balance_columns()})
    for (const HistoryColumn& c : columns) EXPECT_EQ(r.*c.value, good.*c.value) << c.name;
}

/// A row of discs along x, bonded where they touch, in lanes without any boundary.
struct RowOfDiscs {
  static constexpr int interval = 10;
  std::shared_ptr<const Specimen> specimen;
  std::unique_ptr<LaneGroup> group;

  RowOfDiscs(Precision precision, const MatrixRecipe& m) {
    Specimen s = assembly({{R, R, R}, {3.0 * R, R, R}, {5.0 * R, R, R}}, m);
    bond_touching(s);
    specimen = shared(s);
    group = small_group(s, precision, interval);
  }
  /// The same small motion in every lane that is loaded.
  void load(int lane) {
    group->load(lane, specimen, {});
    group->set_motion(lane, 2, {}, {1e-3, 2e-3}, 0.1);
  }
};

struct Motion {
  GrainState at;
  Vec2 velocity;
};

/// A block from `bad` in one of two lanes; `alone` is what the other would be without a neighbour.
void expect_no_number(const Motion& bad, Precision precision) {
  RowOfDiscs alone(precision, soft_contact()), t(precision, soft_contact());
  alone.load(0);
  t.load(0), t.load(1);
  for (int i = 0; i < 2; ++i) alone.group->advance(), t.group->advance();
  const HistoryRow good = t.group->row(0);
  ASSERT_TRUE(t.group->health(0).ok);
  ASSERT_GT(good.kinetic + good.strain_bond, 0.0);
  t.group->set_motion(0, 1, bad.at, bad.velocity, 0.0);
  alone.group->advance(), t.group->advance();
  EXPECT_FALSE(t.group->health(0).ok);
  EXPECT_FALSE(t.group->health(0).outran);
  EXPECT_EQ(t.group->health(0).reason, "at step 30 energies or forces are no numbers any more");
  expect_last_good(*t.group, good, 3, RowOfDiscs::interval);
  t.group->clear(0);
  alone.group->advance(), t.group->advance();
  EXPECT_TRUE(t.group->health(1).ok);
  for (const HistoryColumn& c : balance_columns())
    EXPECT_EQ(t.group->row(1).*c.value, alone.group->row(0).*c.value) << "of its neighbour: " << c.name;
}

TEST(Watchdog, SeesWhatIsNoNumber) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  for (const Precision precision : both_precisions) {
    const double fast = precision == Precision::double_precision ? 1e200 : 1e30;  // its energy is infinite
    for (const Motion& bad :
         {Motion{{inf, 0.0, 0.0}, {}}, Motion{{0.0, std::nan(""), 0.0}, {}}, Motion{{0.0, 0.0, inf}, {}},
          Motion{{}, {0.0, -inf}}, Motion{{}, {std::nan(""), 0.0}}, Motion{{}, {fast, 0.0}}})
      expect_no_number(bad, precision);
  }
}

/// The reason in a single cycle from grain 1 lying `overlap` of its radius in grain 0; empty: none.
std::string reason_at(double overlap, double r1, Precision precision) {
  const Specimen s = assembly({{2.0 * R, 2.0 * R, 2.0 * R}, {4.0 * R + r1, 2.0 * R, r1}}, MatrixRecipe{});
  Specimen counted = s;  // one contact, for a stable step
  counted.contacts.push_back({0, 1, ContactKind::touching, 0, 0, 0.0, 0.0});
  const auto group = small_group(s, precision, 1);
  group->load(0, shared(counted), {});
  group->set_motion(0, 1, {-overlap * r1, 0.0, 0.0}, {}, 0.0);
  group->advance();
  EXPECT_EQ(group->health(0).ok, group->health(0).reason.empty());
  EXPECT_FALSE(group->health(0).outran);
  return group->health(0).reason;
}

TEST(Watchdog, SeesAnOverlapBeyondTheSmallerRadius) {
  for (const Precision precision : both_precisions)
    for (const double r1 : {R, 2.0 * R}) {
      EXPECT_EQ(reason_at(0.99, r1, precision), "");
      EXPECT_NE(reason_at(1.01, r1, precision), "");
      EXPECT_EQ(reason_at(1.2, r1, precision),
                "at step 1 grains 0 and 1 (not bonded) overlap by 1.2 of the smaller radius");
    }
}

TEST(Watchdog, SaysWhatWasBetweenTheGrains) {
  for (const Precision precision : both_precisions) {
    Specimen s = *RowOfDiscs(precision, soft_contact()).specimen;
    const auto holds = small_group(s, precision, 1);
    holds->load(0, shared(s), {});
    holds->set_motion(0, 2, {-1.5 * R, 0.0, 0.0}, {}, 0.0);
    holds->advance();
    EXPECT_THAT(holds->health(0).reason, HasSubstr("grains 1 and 2 (bonded) overlap by 1.5"));

    s.matrix = MatrixRecipe{};  // bonds that break
    for (Contact& c : s.contacts) c.sigma_c = c.tau_c = s.matrix.sigma_c;
    const auto breaks = small_group(s, precision, 1);
    breaks->load(0, shared(s), {});
    breaks->set_motion(0, 2, {0.1 * R, 0.0, 0.0}, {}, 0.0);
    breaks->advance();
    ASSERT_EQ(breaks->cracks(0).size(), 1U);
    ASSERT_TRUE(breaks->health(0).ok) << breaks->health(0).reason;
    const HistoryRow good = breaks->row(0);
    breaks->set_motion(0, 2, {-1.5 * R, 0.0, 0.0}, {}, 0.0);
    breaks->advance();
    EXPECT_THAT(breaks->health(0).reason,
                HasSubstr("at step 2 grains 1 and 2 (their bond broken) overlap by 1.5"));
    expect_last_good(*breaks, good, 2, 1);
  }
}

/// A disc between two walls, the lower of which closes in, gently at first: one mass, two springs k that only
/// push, and the leap-frog written down anew. Its bound of the frequency, 2 k/m, is the frequency itself, so
/// that a step safety beyond 1 is a step beyond the edge of stability.
struct DiscBetweenWalls {
  static constexpr int interval = 5, ramp = 40;  // cycles
  static constexpr double speed = 0.01;
  MatrixRecipe m;
  double k = contact::wall::normal_stiffness(m), mass = m.density * pi * R * R;
  double dt;
  // by hand
  double time = 0.0, u = 0.0, v = 0.0, force = 0.0, lower = 0.0, wall = 0.0, work = 0.0;

  explicit DiscBetweenWalls(double safety) : dt(safety * 2.0 / std::sqrt(2.0 * k / mass)) {}

  std::unique_ptr<LaneGroup> group(double safety, double loaded, Precision precision) const {
    const auto s = shared(assembly({{R, R, R}}, m));
    Boundary boundary;
    boundary.bodies.resize(2);
    boundary.bodies[0].touches = {{0, {0.0, 1.0}, 0.0}}, boundary.bodies[1].touches = {{0, {0.0, -1.0}, 0.0}};
    boundary.axial = {0, 1, {0.0, 1.0}, loaded};
    LaneSetup setup;
    setup.damping = 0.0, setup.step_safety = safety;
    setup.boundary = shared(boundary);
    auto g = small_group(*s, precision, interval);
    g->load(0, s, setup);
    g->place_boundary(0);
    PrescribedMotion prescribed;
    prescribed.velocity = {0.0, speed};
    prescribed.ramp = ramp * dt;
    g->prescribe(0, 0, prescribed);
    return g;
  }
  /// The energy error after the next block.
  double advance() {
    for (int step = 0; step < interval; ++step) {
      const double way = dt * speed * std::min(1.0, (time + 0.5 * dt) / (ramp * dt));
      time += dt;
      v += dt / mass * force;
      u += dt * v;
      wall += way;
      const double push = k * std::max(wall - u, 0.0);
      work += 0.5 * (lower + push) * way;
      lower = push;
      force = push - k * std::max(u, 0.0);
    }
    const double next = v + dt / mass * force, upper = lower - force;
    const double held = 0.25 * mass * (v * v + next * next) + (lower * lower + upper * upper) / (2.0 * k);
    return (work - held) / work;
  }
};

TEST(Watchdog, SeesAStepThatIsTooLong) {
  for (const Precision precision : both_precisions) {
    DiscBetweenWalls by_hand(1.01);
    const auto group = by_hand.group(1.01, 0.0, precision);
    EXPECT_NEAR(group->time_step(0), by_hand.dt, 1e-8 * by_hand.dt);
    HistoryRow good;
    int block = 1;
    double error = by_hand.advance();
    for (; std::fabs(error) <= 0.2; ++block, error = by_hand.advance()) {
      ASSERT_LT(block, 30) << "the test is stable";
      group->advance();
      ASSERT_TRUE(group->health(0).ok) << group->health(0).reason;
      good = group->row(0);
      EXPECT_NEAR(good.energy_error, error, 1e-3) << "in block " << block;
    }
    EXPECT_GT(block, 2) << "the first rows are good ones";
    group->advance();
    EXPECT_FALSE(group->health(0).ok);
    EXPECT_FALSE(group->health(0).outran);
    EXPECT_LT(error, 0.0) << "energy comes from nowhere";
    EXPECT_EQ(group->health(0).reason,
              fmt::format("at step {} the energy balance is off by {:.2g} of the work",
                          block * DiscBetweenWalls::interval, error));
    expect_last_good(*group, good, block, DiscBetweenWalls::interval);
  }
}

TEST(Watchdog, LetsALongStablePass) {
  for (const Precision precision : both_precisions) {
    DiscBetweenWalls by_hand(0.98);
    const auto group = by_hand.group(0.98, 0.0, precision);
    for (int block = 1; block <= 100; ++block) {
      group->advance();
      ASSERT_TRUE(group->health(0).ok) << "in block " << block << group->health(0).reason;
      EXPECT_NEAR(group->row(0).energy_error, by_hand.advance(), 1e-3) << "in block " << block;
    }
  }
}

// Before it is loaded the balance is over next to nothing: the watchdog waits until the bodies have gone as
// far as counts, from where the strains count.
TEST(Watchdog, WaitsForTheLoad) {
  for (const int zeroed_after : {0, 9}) {
    DiscBetweenWalls by_hand(1.01);
    const double loaded = 32.5 * by_hand.dt * DiscBetweenWalls::speed;  // unstable long before
    const auto group = by_hand.group(1.01, loaded, Precision::double_precision);
    double zero = 0.0, error = 0.0;
    for (int block = 1; block <= 30 && group->health(0).ok; ++block) {
      group->advance();
      error = by_hand.advance();
      EXPECT_EQ(group->health(0).ok, by_hand.wall - zero < loaded) << "in block " << block;
      if (block == zeroed_after) group->zero_strains(0), zero = by_hand.wall;
    }
    EXPECT_THAT(group->health(0).reason, HasSubstr("the energy balance is off by"));
    EXPECT_LT(error, -1.0);
    EXPECT_LT(group->row(0).energy_error, -1.0) << "rows before the load may be off";
  }
}

/// Two bonded discs far from all others, for a first crack: it is made by drawing the second one away.
const std::vector<Disc> pair_to_break = {{40.0 * R, R, R}, {42.0 * R, R, R}};
constexpr GrainState drawn_away{0.1 * R, 0.0, 0.0};

/// Three loose discs along x: the left one flies against the middle one, which flies on towards the right one
/// within the same block of cycles. Something has broken before.
struct Billiards {
  static constexpr int interval = 400;
  std::shared_ptr<const Specimen> specimen;
  LaneSetup setup;
  std::unique_ptr<LaneGroup> group;

  Billiards(double gap, Precision precision, int lanes = 0) {
    const double first = 0.2 * skin;
    Specimen s = assembly({{R, R, R},
                           {3.0 * R + first, R, R},
                           {5.0 * R + first + gap, R, R},
                           pair_to_break[0],
                           pair_to_break[1]},
                          MatrixRecipe{});
    bond_touching(s);
    group = small_group(s, precision, interval, lanes);
    Boundary boundary;
    boundary.bodies = {pusher(3, 1.0)};  // never placed: gives the first step its stiffness
    setup.damping = 0.0, setup.step_safety = 0.02;
    setup.boundary = shared(boundary);
    specimen = shared(std::move(s));
    group->load(0, specimen, setup);
    group->set_motion(0, 4, drawn_away, {}, 0.0);
    group->advance();  // the others are at rest
    EXPECT_EQ(group->cracks(0).size(), 1U);
    const double v = std::max(4.0 * skin, 1.4 * gap) / (group->time_step(0) * interval);
    group->set_motion(0, 0, {}, {v, 0.0}, 0.0);
  }
};

// With a list that reaches as far as the grains went: it makes no difference that the pair was not known.
TEST(Watchdog, ABlockInWhichGrainsMetUnseenIsRunAgain) {
  for (const Precision precision : both_precisions)
    for (const int lanes : {0, 1}) {
      Billiards known(0.9 * skin, precision, lanes), unknown(1.2 * skin, precision, lanes);
      for (const Billiards* b : {&known, &unknown}) {
        b->group->advance();
        EXPECT_TRUE(b->group->health(0).ok) << b->group->health(0).reason;
        EXPECT_GT(b->group->grains(0)[2].ux, skin) << "hit by the middle one";
        EXPECT_EQ(b->group->row(0).step, 2.0 * Billiards::interval);
      }
    }
}

TEST(Watchdog, SeesGrainsThatMetBeyondAnyList) {
  for (const Precision precision : both_precisions) {
    Billiards far(10.0 * R, precision);
    const HistoryRow good = far.group->row(0);
    far.group->advance();
    const LaneHealth& health = far.group->health(0);
    EXPECT_FALSE(health.ok);
    EXPECT_TRUE(health.outran);
    EXPECT_THAT(health.reason, HasSubstr("at step 800 grains 1 and 2 have met unseen"));
    EXPECT_EQ(far.group->grains(0)[2].ux, 0.0) << "nobody knew that they meet";
    expect_last_good(*far.group, good, 2, Billiards::interval);
  }
}

/// A disc that flies against a loose one, which flies on against a wall at rest within the same block.
TEST(Watchdog, ABlockInWhichAGrainMetAWallUnseenIsRunAgain) {
  for (const Precision precision : both_precisions)
    for (const int lanes : {0, 1}) {
      const double first = 0.2 * skin;
      Specimen s =
          assembly({{R, R, R}, {3.0 * R + first, R, R}, pair_to_break[0], pair_to_break[1]}, MatrixRecipe{});
      bond_touching(s);
      const auto group = small_group(s, precision, Billiards::interval, lanes);
      Boundary boundary;
      boundary.bodies = {pusher(2, -1.0)};
      boundary.bodies[0].touches[0].gap = 20.0 * R;
      boundary.bodies[0].touches[1].gap = 2.0 * skin;  // to the right of the second disc
      LaneSetup setup;
      setup.damping = 0.0, setup.step_safety = 0.02, setup.boundary = shared(boundary);
      group->load(0, shared(s), setup);
      group->place_boundary(0);
      group->set_motion(0, 3, drawn_away, {}, 0.0);
      group->advance();
      EXPECT_EQ(group->cracks(0).size(), 1U);
      group->set_motion(0, 0, {}, {5.0 * skin / (group->time_step(0) * Billiards::interval), 0.0}, 0.0);
      group->advance();
      EXPECT_TRUE(group->health(0).ok) << group->health(0).reason;
      EXPECT_LT(group->grains(0)[1].ux, 2.6 * skin) << "thrown back by the wall";
      EXPECT_NE(group->body(0, 0).force.x + group->body(0, 0).mean_force.x, 0.0);
    }
}

}  // namespace
}  // namespace phy::engine
