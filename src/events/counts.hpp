// Counts of events over strain, of a test and of a laboratory. A laboratory counts what its sensors hear, so
// numbers cannot be compared, but the course of the counts up to the peak can.
#pragma once
#include <span>
#include <vector>

#include "base/nan.hpp"
#include "records/acoustic_event.hpp"
#include "records/result.hpp"

namespace phy::events {

/// Events up to a strain; strains ascend.
struct Counts {
  std::vector<double> strain, n;
  double peak = nan;  ///< strain at the largest stress
  /// Events up to `part` of the strain at the peak over those up to the peak. NaN: there are none, or no
  /// peak.
  double share(double part) const;
};
/// `sign` makes recorded strains grow.
Counts counts_of(std::span<const AcousticEvent> events, double sign, double peak);
/// Of a curve whose rows count (HistoryRow::n_cracks); rows before its largest strain so far are passed over.
Counts counts_of(const History& history);

/// Largest difference of the shares of both over the way to the peak, and where: the distance of Kolmogorov
/// and Smirnov. NaN where one has no events before its peak.
struct CountsCompared {
  double difference = nan;  ///< ours minus theirs
  double part = nan;        ///< of the strain at the peak
  bool peaks = true;        ///< both have a peak to compare up to
};
CountsCompared compared(const Counts& ours, const Counts& theirs);

}  // namespace phy::events
