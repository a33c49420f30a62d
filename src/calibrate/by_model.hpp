// A calibration by one model: its stages in order, and what they found put together.
#pragma once
#include <optional>

#include "calibrate/verification.hpp"

namespace phy::calibrate {

struct Attempt {
  Calibration calibration;
  Pictures pictures;
  std::int64_t n_tests = 0;  ///< in compression
};

/// Throws InputError where a model cannot be with its rock.
void check_model(const Evidence& evidence);

/// By the model of the rock, on top of what is known from its choice. Where the user stops, the verdict is
/// interrupted and everything else as far as it came.
Attempt calibrate_by(const Evidence& model, const Calibration& choice, const CalibrationOptions& options,
                     Simulator& simulator, bool pictures_at_once);

}  // namespace phy::calibrate
