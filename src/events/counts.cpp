#include "events/counts.hpp"

#include <algorithm>
#include <cmath>

namespace phy::events {

double Counts::share(double part) const {
  // Straight between rows: a laboratory writes a few.
  const auto up_to = [&](double limit) {
    const auto behind =
        static_cast<std::size_t>(std::upper_bound(strain.begin(), strain.end(), limit) - strain.begin());
    if (behind == 0) return 0.0;
    if (behind == strain.size()) return n.back();
    const double way = (limit - strain[behind - 1]) / (strain[behind] - strain[behind - 1]);
    return n[behind - 1] + way * (n[behind] - n[behind - 1]);
  };
  // A test that stopped early has no peak, and all its events are none up to there.
  if (!std::isfinite(peak)) return nan;
  const double all = up_to(peak);
  return all > 0.0 ? up_to(part * peak) / all : nan;
}

Counts counts_of(std::span<const AcousticEvent> events, double sign, double peak) {
  Counts counts;
  counts.peak = peak;
  for (const AcousticEvent& e : events) counts.strain.push_back(sign * e.strain);
  // Events come by time, and strains of the bodies may swing.
  std::sort(counts.strain.begin(), counts.strain.end());
  for (std::size_t i = 1; i <= events.size(); ++i) counts.n.push_back(static_cast<double>(i));
  return counts;
}

Counts counts_of(const History& history) {
  Counts counts;
  double highest = -HUGE_VAL;
  for (const HistoryRow& row : history.rows) {
    if (row.axial_stress > highest) highest = row.axial_stress, counts.peak = row.axial_strain;
    if (!std::isfinite(row.n_cracks) || (!counts.strain.empty() && row.axial_strain <= counts.strain.back()))
      continue;
    // Of a curve that unloads only the way forward counts.
    counts.strain.push_back(row.axial_strain), counts.n.push_back(row.n_cracks);
  }
  return counts;
}

CountsCompared compared(const Counts& ours, const Counts& theirs) {
  constexpr int steps = 200;
  CountsCompared found;
  found.peaks = std::isfinite(ours.peak) && std::isfinite(theirs.peak);
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps, difference = ours.share(part) - theirs.share(part);
    // Negated: the first number takes the place of NaN.
    if (!std::isfinite(difference) || std::fabs(difference) <= std::fabs(found.difference)) continue;
    found.difference = difference, found.part = part;
  }
  return found;
}

}  // namespace phy::events
