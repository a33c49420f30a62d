// Bonding: every pair of discs that touches, or nearly so, is cemented with strengths of its own.
//
// Strengths are drawn from a normal distribution and drawn again outside mean +- 3 SD and at values <= 0
// (truncation at 3 SD lowers the standard deviation by 1.34 %, the mean not at all). A draw is keyed by
// (bond_seed, a, b, attempt): it does not depend on which other bonds exist or in which order they are made.
// SD = 0 gives the mean to the last bit. In a matrix with directions (contact/direction.hpp) a draw is
// multiplied by the factor of its contact: the scatter is a share of what the direction has, and is the same
// share in all. Contacts that are left without a bond (matrix.unbonded_fraction) are linear contacts of mean
// stiffness from the start; of flat joints they are interfaces without bonds, closed or (gapped_fraction)
// open.
#pragma once
#include <cstdint>
#include <vector>

#include "base/rng.hpp"
#include "records/specimen.hpp"

namespace phy::genesis {

/// Strengths are redrawn beyond this many standard deviations.
constexpr double strength_cut = 3.0;

/// Which draw: equal keys give equal strengths. The grains may be in either order.
struct StrengthKey {
  std::int64_t seed;
  Stream stream;
  std::uint32_t a, b;
};

/// Strength [Pa] of a bond. mean > 0 unless sd = 0.
double draw_strength(double mean, double sd, const StrengthKey& of);

/// All pairs that touch or have a gap <= bond_gap, bonded but for the unbonded and gapped fractions, sorted
/// by (a, b).
std::vector<Contact> bond(const Packing& packing, const MatrixRecipe& matrix);

}  // namespace phy::genesis
