// A cell of a laboratory table, for tests: mean of three specimens that scatter by 5 %.
#pragma once
#include "records/calibration.hpp"

namespace phy {

inline RockReading reading(Property property, double theta, double value) {
  RockReading r;
  r.property = property, r.theta = theta, r.value = value, r.sd = 0.05 * value, r.n = 3;
  return r;
}

}  // namespace phy
