// Tolerances, the widest errors that matter, and the margin of a value judged by itself: the tolerance, or
// the 95 % interval of the difference between the laboratory's mean and the model's (Welch 1947: Student's t,
// degrees of freedom by Satterthwaite 1946) where that is wider. Rules of causes and the forecast of a
// verdict count in it; the verdict itself judges all values together (cells.hpp).
#pragma once
#include <vector>

#include "records/calibration.hpp"

namespace phy::verdict {

/// Misses that pass whatever the scatter.
inline double tolerance(Property property) { return measured(property).tolerance; }
/// The least error that matters: below it a value is met.
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

/// Does the margin pass errors that matter?
bool unresolved(const Comparison& row);

}  // namespace phy::verdict
