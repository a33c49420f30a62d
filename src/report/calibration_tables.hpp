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

/// Micro-parameters in the layout of the paper's Tables 1 and 2, with 95 % intervals.
std::string parameter_tables(const Calibration& calibration);

/// Laboratory, model, interval and error, one row per angle and property; root mean squares below.
std::string macro_table(const Calibration& calibration);

/// Verdict with its findings, and which parameters the data leave open.
std::string verdict_text(const Calibration& calibration);

/// Numbers of tests.
std::string budget_text(const Calibration& calibration);

}  // namespace phy
