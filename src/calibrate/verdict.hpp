// The verdict: does the model have the values of the table, on packings that it was not fitted to?
//
// Every value is judged by itself (margin.hpp): within its margin or not. Without a miss the model is
// calibrated, if every margin is fine enough to tell; else the table does not resolve the question, and the
// verdict says what a row would let pass and how many specimens more would change that. With misses it is
// calibrated except for these. Out of reach: E misses by more than 6 % in the fit, or the strengths together
// by more than 10 % and twice what chance explains, or by 20 %, or something has no answer at all.
#pragma once
#include "calibrate/elastic_fit.hpp"
#include "calibrate/evidence.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

/// Adds findings and status to a result with `fitted` and `verification`; where it is out of reach, takes
/// away intervals that leave out what was measured. `table`: with the moduli that the elastic stage went by;
/// `softened`: these are not the table's own readings.
void judge(Calibration& result, ElasticFit elastic, const Evidence& table, bool softened);

}  // namespace phy::calibrate
