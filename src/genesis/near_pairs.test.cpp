// Is the grid's list the list of the obvious double loop?
#include "genesis/near_pairs.hpp"

#include <gtest/gtest.h>

#include "base/rng.hpp"

namespace phy::genesis {
namespace {

TEST(NearPairs, SameAsDoubleLoop) {
  std::vector<Disc> discs;
  for (std::uint32_t i = 0; i < 300; ++i)
    discs.push_back({10.0 * uniform(7, Stream::test, i, 0) - 5.0, 4.0 * uniform(7, Stream::test, i, 1),
                     0.1 + 0.2 * uniform(7, Stream::test, i, 2)});
  for (const double reach : {0.0, 0.15}) {
    std::vector<Pair> expected;
    for (std::uint32_t i = 0; i < 300; ++i)
      for (std::uint32_t j = i + 1; j < 300; ++j)
        if (gap(discs[i], discs[j]) <= reach) expected.push_back({i, j});
    const std::vector<Pair> found = near_pairs(discs, reach);
    ASSERT_GT(expected.size(), 100U);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_EQ(found[k].a, expected[k].a);
      EXPECT_EQ(found[k].b, expected[k].b);
    }
  }
}

TEST(NearPairs, GapIsNegativeInOverlap) {
  EXPECT_DOUBLE_EQ(gap({0.0, 0.0, 1.0}, {3.0, 4.0, 2.0}), 2.0);
  EXPECT_DOUBLE_EQ(gap({0.0, 0.0, 3.0}, {3.0, 4.0, 2.5}), -0.5);
}

}  // namespace
}  // namespace phy::genesis
