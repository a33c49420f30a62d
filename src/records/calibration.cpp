#include "records/calibration.hpp"

namespace phy {

const char* to_string(VerdictStatus status) {
  switch (status) {
    case VerdictStatus::calibrated: return "calibrated";
    case VerdictStatus::calibrated_except: return "calibrated except";
    case VerdictStatus::out_of_reach: return "out of reach";
    case VerdictStatus::interrupted: break;
  }
  return "interrupted";
}

}  // namespace phy
