#include "events/recorder.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "events/source.hpp"
#include "records/assembly.hpp"

namespace phy::events {
namespace {

constexpr Window window{1.0, 1.0};

CrackEvent crack(double time, Vec2 position, std::uint32_t a) {
  CrackEvent c;
  c.time = time, c.position = position, c.a = a, c.b = a + 1, c.energy = 2.0, c.strain = 0.1 * time;
  return c;
}

/// Grains a and a + 1 push grain a + 10 with `force` along x, one metre away from `from`.
ContactForce push(std::uint32_t a, Vec2 from, double force) {
  return {a, a + 10, from + Vec2{1.0, 0.0}, {force, 0.0}};
}

TEST(Clusters, AreCracksNearInTimeAndSpace) {
  const std::vector<CrackEvent> cracks = {
      crack(0.0, {0.0, 0.0}, 0), crack(0.1, {5.0, 0.0}, 0), crack(0.9, {0.9, 0.0}, 0),
      crack(1.8, {1.8, 0.0}, 0),   // far from the first in both, near the third
      crack(1.8, {5.0, 0.0}, 0)};  // too late for the second
  const auto found = clusters(cracks, window);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0], (std::vector<std::size_t>{0, 2, 3}));
  EXPECT_EQ(found[1], (std::vector<std::size_t>{1}));
  EXPECT_EQ(found[2], (std::vector<std::size_t>{4}));
  EXPECT_TRUE(clusters({}, window).empty());
}

// E = 40 GPa, G = 16 GPa, a solid of 2500 kg/m3: 2530 m/s.
TEST(Window, IsAGrainAndTheShearWaveThroughIt) {
  MatrixRecipe m;
  m.E_c = 25e9, m.E_b = 15e9, m.radius_multiplier = 1.0, m.density = 2500.0;
  const Window w = window_of(assembly({{1.0, 1.0, 1.0}, {4.0, 1.0, 2.0}}, m));
  EXPECT_DOUBLE_EQ(w.reach, 3.0);
  EXPECT_NEAR(w.duration, 3.0 / std::sqrt(16e9 / 2500.0), 1e-12);
}

TEST(Recorder, AnEventLastsWhileItsCracksAreYoungAndKeepsItsLargestTensor) {
  Recorder r(window, 0.01, {push(0, {}, 5.0)});
  r.after_block(0.5, std::vector{crack(0.4, {}, 0)}, {push(0, {}, 8.0)});
  r.after_block(1.0, {}, {push(0, {}, 25.0)});  // the most: 20 more than before
  r.after_block(1.5, {}, {push(0, {}, 12.0)});  // its last block
  r.after_block(2.0, {}, {push(0, {}, 900.0)});
  const std::vector<AcousticEvent> events = r.take();
  ASSERT_EQ(events.size(), 1U);
  const AcousticEvent& e = events[0];
  EXPECT_EQ(e.n_cracks, 1);
  EXPECT_EQ(e.time, 0.4);
  EXPECT_EQ(e.duration, 0.0);
  EXPECT_EQ(e.energy, 2.0);
  EXPECT_DOUBLE_EQ(e.strain, 0.04);
  EXPECT_DOUBLE_EQ(e.tensor.xx, 20.0);
  EXPECT_DOUBLE_EQ(e.magnitude, magnitude_of(0.01 * 20.0 / std::sqrt(2.0)));
  EXPECT_EQ(e.type, SourceType::opening);
}

// The force before is that before the first crack, for what joins later too; the sum is over all its grains.
TEST(Recorder, CracksOfSeveralBlocksAreOneEvent) {
  Recorder r(window, 1.0, {});
  r.after_block(0.5, std::vector{crack(0.4, {0.0, 0.0}, 0)}, {push(0, {}, 1.0), push(2, {}, 4.0)});
  r.after_block(1.0, std::vector{crack(0.9, {0.0, 0.5}, 2)}, {push(0, {}, 1.0), push(2, {}, 4.0)});
  r.after_block(9.0, std::vector{crack(8.9, {0.0, 0.0}, 0)}, {});
  const std::vector<AcousticEvent> events = r.take();
  ASSERT_EQ(events.size(), 2U);
  EXPECT_EQ(events[0].n_cracks, 2);
  EXPECT_EQ(events[0].duration, 0.5);
  EXPECT_DOUBLE_EQ(events[0].position.y, 0.25);
  EXPECT_DOUBLE_EQ(events[0].tensor.xx, 5.0);
  EXPECT_DOUBLE_EQ(events[1].tensor.xx, -1.0) << "what it pushed with is gone";
  EXPECT_EQ(events[1].time, 8.9) << "an event that the test's end cuts short counts";
}

}  // namespace
}  // namespace phy::events
