// Who follows a calibration while it runs. Nothing that is heard changes what is found.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "records/calibration.hpp"

namespace phy::calibrate {

struct Listener {
  std::function<void(const std::string&)> say = [](const std::string&) {};  ///< what begins, one line
  /// What is known by now of the parameters of a stage; after every batch of the strengths anew.
  /// Nothing: another model begins.
  std::function<void(const std::vector<ParameterEstimate>&)> estimates =
      [](const std::vector<ParameterEstimate>&) {};
};

}  // namespace phy::calibrate
