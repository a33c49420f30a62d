// Order of the grains in memory, which depends on the packing alone, and weights of the strain gauge.
#pragma once
#include <cstdint>
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

/// Weights of the least-squares fit u = a + b x + c y over the grains with centres in the middle 60 % of the
/// height: du_x/dx = sum(weight_x u_x), du_y/dy = sum(weight_y u_y).
struct GaugeWeights {
  std::vector<double> x, y;  ///< per packing grain [1/m], 0 outside the gauge
};
GaugeWeights gauge_weights(const Packing& packing);

}  // namespace phy::engine
