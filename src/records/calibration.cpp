#include "records/calibration.hpp"

namespace phy {

const Comparison* row_of(const std::vector<Comparison>& rows, const Target& t) {
  for (const Comparison& c : rows)
    if (c.target.property == t.property && c.target.theta == t.theta && c.target.diameter == t.diameter)
      return &c;
  return nullptr;
}

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
