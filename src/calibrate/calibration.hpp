// The whole calibration: elastic stage, strength stage, verification, verdict (docs/calibration.md).
//
// The order is the paper's - moduli first, then strengths - because strengths hardly move moduli. Everything
// that a run of the press answers goes into the simulator's store; all choices follow from the rock, the
// options and the answers alone. A calibration that was interrupted therefore takes the same way again and
// finds its answers in the store: it ends with the identical result.
#pragma once
#include "calibrate/options.hpp"
#include "calibrate/simulator.hpp"
#include "records/calibration.hpp"
#include "records/evidence.hpp"

namespace phy::calibrate {

/// What the physics do is never thrown: the verdict says it. InputError where there is nothing to fit, the
/// budget is too small, the method cannot work with the rock (method.hpp) or the recipe's joints dilate too
/// much. An interrupted calibration has VerdictStatus::interrupted.
Calibration calibrate(const Evidence& evidence, const CalibrationOptions& options, Simulator& simulator);

}  // namespace phy::calibrate
