// Order of the grains in memory, and pairs of neighbours. Both depend on the packing alone where bits depend
// on them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.hpp"
#include "records/specimen.hpp"

namespace phy::engine {

/// Grains sorted into horizontal rows (bottom to top), by x within a row. A row is a little higher than the
/// largest grain, so that contacts join a row with itself or its neighbour.
struct Layout {
  std::vector<std::int32_t> order;      ///< sorted -> packing
  std::vector<std::int32_t> rank;       ///< packing -> sorted
  std::vector<std::int32_t> row_grain;  ///< first sorted grain of each row, n_rows + 1
  std::vector<std::int32_t> row_of;     ///< row of a sorted grain
  int n_rows() const { return static_cast<int>(row_grain.size()) - 1; }
};
Layout make_layout(const Packing& packing, double skin);

/// A pair of sorted grains a < b as one number that sorts by (b, a): the order of the contacts in memory.
using PairKey = std::uint64_t;
constexpr PairKey pair_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? (static_cast<PairKey>(b) << 32U) | a : (static_cast<PairKey>(a) << 32U) | b;
}
constexpr std::int32_t key_a(PairKey k) { return static_cast<std::int32_t>(k & 0xffffffffU); }
constexpr std::int32_t key_b(PairKey k) { return static_cast<std::int32_t>(k >> 32U); }

/// Appends all pairs whose gap is below `reach`, for centres `x` and radii `r`. Cell grid, O(n).
void near_pairs(std::span<const Vec2> x, std::span<const double> r, double reach,
                std::vector<PairKey>& pairs);

/// Weights of the least-squares fit u = a + b x + c y over the grains with centres in the middle 60 % of the
/// height: du_x/dx = sum(weight_x u_x), du_y/dy = sum(weight_y u_y).
struct GaugeWeights {
  std::vector<double> x, y;  ///< per packing grain [1/m], 0 outside the gauge
};
GaugeWeights gauge_weights(const Packing& packing);

}  // namespace phy::engine
