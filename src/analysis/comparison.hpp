// Two stress-strain curves of one test, ours and somebody else's, read by the same definitions.
#pragma once
#include <string>
#include <vector>

#include "analysis/branch.hpp"

namespace phy::analysis {

/// A number of both curves. NaN where a curve does not hold it; `note` says why.
struct ComparedNumber {
  std::string name, unit;  ///< unit as it is shown
  double ours = 0.0, theirs = 0.0;
  std::string note;
  /// theirs / ours - 1
  double difference() const { return theirs / ours - 1.0; }
};

/// E (tangent at 40 - 60 % and secant at 50 % of the strength, strain between the platens), stress at the
/// first row with a crack, strength, strain there. [GPa], [MPa], [%]. `stop`: of our recipe, for both.
std::vector<ComparedNumber> compared_numbers(const History& ours, const History& theirs,
                                             const StopRule& stop);

/// Root mean square of the difference of the stresses at the strains of our rows, up to the smaller of both
/// peak strains, over our strength. NaN where one of them has no loading branch.
double distance_of_curves(const History& ours, const History& theirs, const StopRule& stop);

}  // namespace phy::analysis
