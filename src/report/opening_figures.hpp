// Figures of openings under stress (lab/opening).
#pragma once
#include "records/specimen_record.hpp"
#include "report/figure.hpp"

namespace phy::report {

/// The stress that every opening bears over its closure; then per specimen the hoop stress around it when it
/// stood, beside Kirsch's of isotropic rock, and how deep its wall has broken out. No panel: no opening.
Figure opening_figure(const RunRecord& run);

}  // namespace phy::report
