// Is the grid's list the list of the obvious double loop?
#include "base/near_pairs.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/rng.hpp"

namespace phy {
namespace {

TEST(NearPairs, AreThoseOfTheDoubleLoop) {
  std::vector<Vec2> x;
  std::vector<double> r;
  for (std::uint32_t i = 0; i < 400; ++i) {
    x.push_back({30.0 * uniform(7, Stream::test, i, 0), 30.0 * uniform(7, Stream::test, i, 1)});
    r.push_back(0.5 + 0.5 * uniform(7, Stream::test, i, 2));
  }
  x.back() = {1e6, -1e6};  // a fragment far away must not blow up the grid
  std::vector<PairKey> found, expected;
  near_pairs(x, r, 0.3, found);
  std::sort(found.begin(), found.end());
  for (std::uint32_t a = 0; a < x.size(); ++a)
    for (std::uint32_t b = 0; b < a; ++b)
      if (norm(x[a] - x[b]) < r[a] + r[b] + 0.3) expected.push_back(pair_key(a, b));
  std::sort(expected.begin(), expected.end());
  ASSERT_GT(expected.size(), 100U);
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace phy
