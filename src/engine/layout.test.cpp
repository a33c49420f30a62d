#include "engine/layout.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/rng.hpp"
#include "engine/small_groups_fixture.hpp"

namespace phy::engine {
namespace {

std::vector<Disc> scattered(std::uint32_t n, double box) {
  std::vector<Disc> discs;
  for (std::uint32_t i = 0; i < n; ++i)
    discs.push_back({box * uniform(7, Stream::test, i, 0), box * uniform(7, Stream::test, i, 1),
                     0.5 + uniform(7, Stream::test, i, 2)});
  return discs;
}

template <class List>
const auto& at(const List& list, std::int32_t i) {
  return list[static_cast<std::size_t>(i)];
}

TEST(Layout, RowsAreContiguousAndSortedByX) {
  const Specimen s = assembly(scattered(500, 40.0), soft_contact());
  const Layout layout = make_layout(*s.packing, 0.1);
  ASSERT_EQ(layout.order.size(), 500U);
  std::set<std::int32_t> seen(layout.order.begin(), layout.order.end());
  EXPECT_EQ(seen.size(), 500U);
  for (int row = 0; row < layout.n_rows(); ++row) {
    for (std::int32_t g = at(layout.row_grain, row); g < at(layout.row_grain, row + 1); ++g) {
      EXPECT_EQ(at(layout.row_of, g), row);
      EXPECT_EQ(at(layout.rank, at(layout.order, g)), g);
      if (g > at(layout.row_grain, row)) {
        EXPECT_LE(at(s.packing->discs, at(layout.order, g - 1)).x,
                  at(s.packing->discs, at(layout.order, g)).x);
      }
    }
  }
}

TEST(Layout, ContactsJoinARowWithItselfOrItsNeighbour) {
  const Specimen s = assembly(scattered(500, 40.0), soft_contact());
  const Layout layout = make_layout(*s.packing, 0.1);
  for (std::size_t a = 0; a < 500; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Disc p = s.packing->discs[a], q = s.packing->discs[b];
      if (norm(Vec2{p.x - q.x, p.y - q.y}) < p.r + q.r + 0.1) {
        EXPECT_LE(std::abs(at(layout.row_of, layout.rank[a]) - at(layout.row_of, layout.rank[b])), 1);
      }
    }
}

TEST(GaugeWeights, ReadAnAffineFieldExactly) {
  const Specimen s = assembly(scattered(500, 40.0), soft_contact());
  const GaugeWeights w = gauge_weights(*s.packing);
  double xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < 500; ++i) {
    const Disc& d = s.packing->discs[i];
    xx += w.x[i] * (3.0 + 0.02 * d.x - 0.05 * d.y);
    yy += w.y[i] * (1.0 + 0.07 * d.x + 0.03 * d.y);
  }
  EXPECT_NEAR(xx, 0.02, 1e-12);
  EXPECT_NEAR(yy, 0.03, 1e-12);
}

}  // namespace
}  // namespace phy::engine
