// Figures of a laboratory's table and of a calibration beside it: from the numbers of calibration.json.
#pragma once
#include <vector>

#include "records/calibration.hpp"
#include "report/figure.hpp"

namespace phy::report {

/// A panel per test of the table: laboratory, theory through it, model, interval, and what was predicted
/// unseen.
Figure calibration_figure(const Calibration& calibration);

/// The same without a model: what a table holds, before anything runs.
Figure laboratory_figure(const std::vector<Target>& table);

}  // namespace phy::report
