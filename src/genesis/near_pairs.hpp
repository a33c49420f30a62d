// Contacts of a packing in the making (base/near_pairs.hpp), sorted by (a, b): the order of the list is the
// order of every sum over contacts, so it depends on the discs alone.
#pragma once
#include <cstdint>
#include <vector>

#include "records/specimen.hpp"

namespace phy::genesis {

/// Two discs, a < b.
struct Pair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
};

/// All pairs whose gap |x_b - x_a| - r_a - r_b is at most `reach` [m], sorted by (a, b). The discs may lie
/// anywhere.
std::vector<Pair> near_pairs(const std::vector<Disc>& discs, double reach);

/// Gap between two discs [m]; negative where they overlap.
double gap(const Disc& a, const Disc& b);

}  // namespace phy::genesis
