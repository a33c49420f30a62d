// Which stress of a compression test is its strength: one rule, for tests that peak and tests that harden.
//
//   peak     The largest stress of the test, where the test went on as far as its recipe asks for a peak: a
//            fall to test.stop_at of it, or test.post_peak more strain without a larger one. Else the first
//            maximum that a fall of 10 % follows before it is exceeded. The mean of both platens is noisy by
//            half their difference, and a difference of 3 % carries a warning (records/quality.hpp): noise
//            without a warning comes nowhere near 10 %.
//   knee     Where there is neither: the largest stress up to the first strain at which the tangent modulus
//            is below 5 % of the modulus before. The tangent is the least-squares slope over 10 % of the
//            strain (from 0.95 to 1.05 of it, at least 5 rows), the modulus that between 0.2 and 0.6 of it.
//            A knee counts when the test has gone on for another quarter of its strain.
//   largest  Where there is no knee either: no strength.
//
// A dip on the rising branch is neither peak nor knee: one that is exceeded by more than 5 % within another
// quarter of its strain, or within five rows where rows are that far apart. What lies below 20 % of the
// largest stress is not looked at: stress waves are not yet even there.
//
// The numbers are choices of this program. Strengths of different rules are not to be mixed in one envelope:
// a knee lies below the peak that a test would have shown later.
#pragma once
#include <cstddef>
#include <span>

namespace phy::analysis {

enum class StrengthRule { peak = 1, knee = 2, largest = 3 };
const char* to_string(StrengthRule rule);

/// What ends a test as peaked, of its recipe (lab/procedure.hpp).
struct StopRule {
  double stop_at = 0.6;    ///< fall to this fraction of the largest stress
  double post_peak = 1.0;  ///< strain beyond that of the peak, as a fraction of it; 0: no such limit
};

struct StrengthPoint {
  StrengthRule rule = StrengthRule::largest;
  std::size_t row = 0;  ///< the stress there is the largest up to it
};

/// Of finite strains and stresses, row by row, with a stress above zero among them. A history whose strain
/// does not grow from row to row has no knee.
StrengthPoint strength_point(std::span<const double> strain, std::span<const double> stress,
                             const StopRule& stop);

}  // namespace phy::analysis
