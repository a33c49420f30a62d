// Which discs are near each other: a cell grid, O(n). The order in which pairs are found depends on how the
// grid is walked; whoever sums over pairs sorts them first. Rejected: a tree (radii differ by less than a
// factor two, so a grid wastes nothing).
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.hpp"

namespace phy {

/// A pair of numbers a < b as one number that sorts by (b, a): the order of the contacts in memory.
using PairKey = std::uint64_t;
constexpr PairKey pair_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? (static_cast<PairKey>(b) << 32U) | a : (static_cast<PairKey>(a) << 32U) | b;
}
constexpr std::int32_t key_a(PairKey k) { return static_cast<std::int32_t>(k & 0xffffffffU); }
constexpr std::int32_t key_b(PairKey k) { return static_cast<std::int32_t>(k >> 32U); }

/// Appends all pairs whose gap |x_b - x_a| - r_a - r_b is below `reach` [m], for centres `x` and radii `r`
/// [m]. The points may lie anywhere; far fragments do not enlarge the grid beyond a few cells per point.
void near_pairs(std::span<const Vec2> x, std::span<const double> r, double reach,
                std::vector<PairKey>& pairs);

}  // namespace phy
