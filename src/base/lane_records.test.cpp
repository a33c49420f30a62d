#include "base/lane_records.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace phy {
namespace {

/// Records of nine numbers each, number i of record g being 100 g + i.
template <class R>
void turn_and_return() {
  using T = ScalarOf<R>;
  constexpr std::size_t W = R::width, stride = 9, n = 40;
  std::vector<T> records;
  for (std::size_t g = 0; g < n; ++g)
    for (std::size_t i = 0; i < stride; ++i) records.push_back(static_cast<T>(100 * g + i));
  std::vector<std::int32_t> index;
  for (std::size_t l = 0; l < W; ++l)
    index.push_back(static_cast<std::int32_t>((7 * l + 3) % n));  // some twice
  R out[record_size];
  load_records(records.data() + 1, index.data(), stride, out);
  for (int i = 0; i < record_size; ++i)
    for (std::size_t l = 0; l < W; ++l)
      EXPECT_EQ(out[i][static_cast<int>(l)], static_cast<T>(100 * index[l] + i + 1)) << i << ", lane " << l;
  std::vector<T> back(W * record_size);
  store_records(back.data(), out);
  for (std::size_t l = 0; l < W; ++l)
    for (std::size_t i = 0; i < record_size; ++i)
      EXPECT_EQ(back[l * record_size + i], static_cast<T>(100 * index[l]) + static_cast<T>(i + 1));
}

TEST(LaneRecords, GoIntoLanesAndBack) {
  turn_and_return<Pack<float, 4>>();
  turn_and_return<Pack<float, 8>>();
  turn_and_return<Pack<float, 16>>();
  turn_and_return<Pack<double, 4>>();
  turn_and_return<Pack<double, 8>>();
}

}  // namespace
}  // namespace phy
