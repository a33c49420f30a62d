// Who follows a calibration while it runs. Nothing that is heard changes what is found.
#pragma once
#include <functional>
#include <vector>

#include "records/calibration.hpp"
#include "records/finding.hpp"

namespace phy::calibrate {

struct Outlook;

struct Listener {
  /// What lies ahead, before anything runs and again before each model.
  std::function<void(const Outlook&)> outlook = [](const Outlook&) {};
  std::function<void(const Finding&)> begins = [](const Finding&) {};  ///< a stage (finding_of_course.def)
  /// What is known by now of the parameters of a stage; after every batch of the strengths anew.
  /// Nothing: another model begins.
  std::function<void(const std::vector<ParameterEstimate>&)> estimates =
      [](const std::vector<ParameterEstimate>&) {};
};

}  // namespace phy::calibrate
