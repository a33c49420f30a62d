// By how much the model may be off a value of the table: fixed tolerances, what chance explains, and from
// where on chance explains so much that nothing can be said.
//
// A miss passes within the tolerance, or within the 95 % interval of the difference between two means: that
// of the laboratory's specimens and that of the model's packings (Welch 1947: Student's t, with degrees of
// freedom by Satterthwaite 1946). A margin wider than coarsest() passes misses that matter: such a row tells
// nothing, whether it is met or not.
#pragma once
#include <optional>
#include <vector>

#include "records/calibration.hpp"

namespace phy::verdict {

/// Misses that pass whatever the scatter.
inline double tolerance(Property property) { return measured(property).tolerance; }
/// The widest margin by which a row can be judged.
inline double coarsest(Property property) { return measured(property).coarsest; }

/// From where a table is out of reach: the miss of an E, the root mean square of those of the strengths.
constexpr double modulus_limit = 0.06, strength_limit = 0.10;

/// Standard errors beyond which a difference is no chance, 1 % to both sides.
constexpr double z_99 = 2.58;

/// Model less laboratory: relative, but of nu absolute.
double miss_of(const Comparison& row);

/// In the same units: the miss that passes.
double margin(const Comparison& row);

bool misses(const Comparison& row);

/// Unseen packings of a verification. Five are enough where the means over them are known to a quarter of the
/// tolerance (standard error, root mean square over the strengths); where packings differ by more, a margin
/// that counts their scatter would hide misses, so five more are tested, and once more.
constexpr std::size_t first_packings = 5, most_packings = 15;
bool wants_packings(const std::vector<Comparison>& verification);

/// Is the row too coarse to be judged by?
bool unresolved(const Comparison& row);

/// Specimens more that would make it fine enough; nothing: packings of this size differ too much for any
/// number of specimens below a hundred.
std::optional<int> specimens_missing(const Comparison& row);

}  // namespace phy::verdict
