// Records in memory and lanes: W records of eight numbers each become eight packs and back, number i of
// record l being lane l of pack i. A matrix is turned by exchanging its off-diagonal blocks, of half the size
// in every round: three rounds for eight rows.
#pragma once
#include <cstdint>
#include <utility>

#include "base/pack.hpp"

namespace phy {
inline namespace PHY_ISA {

constexpr int record_size = 8;

namespace detail {

/// Numbers of `y` that stand `block` before take the places of those of `x` that stand in odd blocks.
template <int block, class V, std::size_t... k>
PHY_HOT inline V upper_blocks(V x, V y, std::index_sequence<k...>) {
  constexpr int n = sizeof...(k);
  return __builtin_shufflevector(
      x, y, ((static_cast<int>(k) & block) ? n + static_cast<int>(k) - block : static_cast<int>(k))...);
}
/// The rest of both.
template <int block, class V, std::size_t... k>
PHY_HOT inline V lower_blocks(V x, V y, std::index_sequence<k...>) {
  constexpr int n = sizeof...(k);
  return __builtin_shufflevector(
      x, y, ((static_cast<int>(k) & block) ? n + static_cast<int>(k) : static_cast<int>(k) + block)...);
}

/// `size` rows of vectors; a vector longer than that holds several matrices side by side.
template <int size, int block, int W, class V>
PHY_HOT inline void turn(V* row) {
  constexpr auto numbers = std::make_index_sequence<static_cast<std::size_t>(W)>();
  for (int i = 0; i < size; ++i) {
    if ((i & block) != 0) continue;
    const V x = row[i], y = row[i + block];
    row[i] = upper_blocks<block>(x, y, numbers);
    row[i + block] = lower_blocks<block>(x, y, numbers);
  }
  if constexpr (block > 1) turn<size, block / 2, W>(row);
}

/// Part of the records `base + stride index[l]` that becomes rows of a matrix.
template <class R>
PHY_HOT inline typename R::Lanes row_of(const ScalarOf<R>* base, const std::int32_t* index,
                                        std::size_t stride, int i) {
  const auto at = [&](int l) { return base + static_cast<std::size_t>(index[l]) * stride; };
  typename R::Lanes row;
  if constexpr (R::width <= record_size) {
    __builtin_memcpy(&row, at(i), sizeof row);
  } else {
    typename Pack<ScalarOf<R>, record_size>::Lanes lower, upper;
    __builtin_memcpy(&lower, at(i), sizeof lower);
    __builtin_memcpy(&upper, at(i + record_size), sizeof upper);
    row = __builtin_shufflevector(lower, upper, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  }
  return row;
}

}  // namespace detail

/// Lane l of out[i] is number i of the record at base + stride index[l].
template <class R>
PHY_HOT inline void load_records(const ScalarOf<R>* base, const std::int32_t* index, std::size_t stride,
                                 R (&out)[record_size]) {
  constexpr int rows = R::width < record_size ? R::width : record_size;
  for (int first = 0; first < record_size; first += rows) {
    typename R::Lanes row[rows];
    for (int i = 0; i < rows; ++i) row[i] = detail::row_of<R>(base + first, index, stride, i);
    detail::turn<rows, rows / 2, R::width>(row);
    for (int i = 0; i < rows; ++i) out[first + i] = R::of(row[i]);
  }
}

/// The other way, into records that lie one after the other.
template <class R>
PHY_HOT inline void store_records(ScalarOf<R>* base, const R (&in)[record_size]) {
  constexpr int rows = R::width < record_size ? R::width : record_size;
  for (int first = 0; first < record_size; first += rows) {
    typename R::Lanes row[rows];
    for (int i = 0; i < rows; ++i) row[i] = in[first + i].v;
    detail::turn<rows, rows / 2, R::width>(row);
    for (int i = 0; i < rows; ++i) {
      if constexpr (R::width <= record_size) {
        __builtin_memcpy(base + i * record_size + first, &row[i], sizeof row[i]);
      } else {
        const auto lower = __builtin_shufflevector(row[i], row[i], 0, 1, 2, 3, 4, 5, 6, 7);
        const auto upper = __builtin_shufflevector(row[i], row[i], 8, 9, 10, 11, 12, 13, 14, 15);
        __builtin_memcpy(base + i * record_size, &lower, sizeof lower);
        __builtin_memcpy(base + (i + record_size) * record_size, &upper, sizeof upper);
      }
    }
  }
}

}  // namespace PHY_ISA
}  // namespace phy
