// What the list of near pairs reaches, and contacts that are created from it.
#include <gtest/gtest.h>

#include "engine/small_groups.test.hpp"

namespace phy::engine {
namespace {

// A grain that goes farther in a block of cycles than the list of near pairs reaches meets what lies in its
// way all the same. Head on with its like it comes to rest, and the other goes on as fast.
TEST(NearPairs, ReachAsFarAsAFastGrainFlies) {
  for (const Precision precision : {Precision::double_precision, Precision::single_precision}) {
    const double gap = 1.5 * TwoDiscs::skin;
    TwoDiscs t(gap, false, precision);
    const double v = 2.0 * TwoDiscs::skin / t.block, kinetic = 0.5 * t.mass * v * v;
    t.group->set_motion(0, 0, {}, {v, 0.0}, 0.0);
    for (int i = 0; i < 3; ++i) {
      t.group->advance();
      const HistoryRow& r = t.group->row(0);
      EXPECT_NEAR((r.kinetic + r.strain_linear) / kinetic, 1.0, 5e-3) << "after block " << i + 1;
    }
    EXPECT_LT(t.moved(0), 1.5 * gap);
    EXPECT_GT(t.moved(1), 3.0 * TwoDiscs::skin);
  }
}

}  // namespace
}  // namespace phy::engine
