// Tables of a calibration for the terminal, plain ASCII, at most 100 columns. Reads records only.
#pragma once
#include <string>
#include <vector>

#include "records/calibration.hpp"

namespace phy {

/// The laboratory's table as it was understood: means, scatter, specimens, one row per angle.
std::string target_table(const std::vector<Target>& targets);

/// What the data determine before anything has run (calibrate/foresee.hpp).
std::string foresight_table(const std::vector<ParameterEstimate>& estimates);

}  // namespace phy
