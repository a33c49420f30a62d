// What a user asks of a calibration.
#pragma once
#include <cstdint>

#include "calibrate/effort.hpp"
#include "calibrate/listener.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

struct CalibrationOptions {
  CalibrationMethod method = CalibrationMethod::posterior;
  bool elastic_only = false;
  std::int64_t max_tests = 2000;  ///< in compression, verification included; tests in tension come on top
  Effort effort = normal_effort;  ///< of the search of a posterior
  Listener listener = {};
};

}  // namespace phy::calibrate
