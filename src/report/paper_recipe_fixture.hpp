// The paper's recipe with its bedding at 30 degrees, for tests of what other programs are told.
#pragma once
#include "records/recipe.hpp"

namespace phy::report {

inline Recipe paper() {
  Recipe r;
  r.bedding.resize(1);
  r.bedding[0].theta = 30.0;
  return r;
}

}  // namespace phy::report
