// Cracks by mode (tension, shear) and place (matrix, bedding).
#pragma once
#include <cstdint>
#include <vector>

#include "analysis/branch.hpp"

namespace phy::analysis {

/// Number of cracks of each kind.
struct CrackCounts {
  std::int64_t tension_matrix = 0, shear_matrix = 0, tension_bedding = 0, shear_bedding = 0;
};

/// Cracks up to and including an axial platen strain; infinity counts all.
CrackCounts count_cracks(const std::vector<CrackEvent>& cracks, double up_to_strain);

/// cracks_tension_matrix, ... of the whole test, and cracks_tension_matrix_at_peak, ... [1]. Without a peak
/// the latter are NaN with a note.
std::vector<Number> crack_numbers(const LoadingBranch& branch, const std::vector<CrackEvent>& cracks);

}  // namespace phy::analysis
