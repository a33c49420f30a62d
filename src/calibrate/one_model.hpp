// A calibration by one model: moduli, strengths, softening, verification, verdict, one after the other.
// calibration.hpp chooses the model, and may try others.
#pragma once
#include <cstdint>
#include <vector>

#include "calibrate/calibration.hpp"

namespace phy::calibrate {

/// The tests of a verification whose specimens are shown. Not at once: another model may have to show its
/// own.
struct Pictures {
  bool at_once = true;
  Recipe recipe;
  std::vector<Target> tests;
  std::int64_t packing = 0;
};

struct Attempt {
  Calibration calibration;
  Pictures pictures;
};

/// Fewest tests in compression; none where no strengths are fitted.
std::int64_t least_tests(const Evidence& evidence, const CalibrationOptions& options);

/// Throws InputError where nothing of the table can be fitted, or the budget is too small for any search.
void check_budget(const Evidence& evidence, const CalibrationOptions& options);

/// Throws InputError where a model cannot be with its rock.
void check_model(const Evidence& evidence);

Verdict stopped_by_user();

/// By the model of the rock, on top of what its choice has told.
Attempt calibrate_by(const Evidence& model, const Calibration& choice, const CalibrationOptions& options,
                     Simulator& simulator, bool pictures_at_once);

/// Specimens for a verification that has kept none.
void press_pictures(const Pictures& pictures, Calibration& result, Simulator& simulator);

}  // namespace phy::calibrate
