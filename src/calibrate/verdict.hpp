// The verdict: does the model have the values of the table, on packings that it was not fitted to?
#pragma once
#include "calibrate/elastic_fit.hpp"
#include "calibrate/evidence.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

/// Adds findings and status to a result with `fitted` and `verification`. `table`: with the moduli that the
/// elastic stage went by; `softened`: these are not the table's own readings.
void judge(Calibration& result, ElasticFit elastic, const Evidence& table, bool softened);

}  // namespace phy::calibrate
