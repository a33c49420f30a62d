// Figures of the acoustic events of a run (test.events).
#pragma once
#include <string>

#include "records/specimen_record.hpp"
#include "report/figure.hpp"

namespace phy::report {

/// A laboratory's counts of events; none: no rows.
struct LaboratoryCounts {
  History curve;     ///< events so far in HistoryRow::n_cracks
  std::string name;  ///< of its file
};

/// Per specimen with events: how many are at least as large, with the line of the b-value. With counts of a
/// laboratory also both over the strain to the peak. No panel: no events.
Figure events_figure(const RunRecord& run, const LaboratoryCounts& laboratory);
/// Per specimen with events: where they were, by source and magnitude.
Figure event_places_figure(const RunRecord& run);

}  // namespace phy::report
