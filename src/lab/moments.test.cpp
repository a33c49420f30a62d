#include "lab/moments.hpp"

#include <gtest/gtest.h>

namespace phy::lab {
namespace {

struct Row {
  double step = 0.0;
};

std::vector<Row> kept(std::int64_t wanted, std::int64_t n_rows) {
  Moments<Row> moments(wanted);
  for (std::int64_t row = 0; row < n_rows; ++row)
    if (moments.due(row)) moments.keep({static_cast<double>(row)});
  return moments.take({static_cast<double>(n_rows - 1)});
}

TEST(Moments, BetweenNAndTwiceNAtEqualStepsAndTheLast) {
  for (const std::int64_t wanted : {1, 5, 40})
    for (std::int64_t n_rows = wanted; n_rows < 700; n_rows += 7) {
      const auto rows = kept(wanted, n_rows);
      EXPECT_GE(rows.size(), static_cast<std::size_t>(wanted)) << n_rows;
      EXPECT_LE(rows.size(), static_cast<std::size_t>(2 * wanted + 1)) << n_rows;
      EXPECT_EQ(rows.front().step, 0.0);
      EXPECT_EQ(rows.back().step, static_cast<double>(n_rows - 1));
      for (std::size_t i = 2; i + 1 < rows.size(); ++i)
        EXPECT_EQ(rows[i].step - rows[i - 1].step, rows[1].step - rows[0].step);
    }
}

TEST(Moments, NoneWantedLeavesTheLast) { EXPECT_EQ(kept(0, 50).size(), 1U); }

}  // namespace
}  // namespace phy::lab
