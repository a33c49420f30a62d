// Tables of a calibration for the terminal, plain ASCII, no wider than it is (0: no limit).
// Reads records only.
#pragma once
#include <string>
#include <vector>

#include "records/calibration.hpp"

namespace phy::report {

/// The laboratory's table as it was understood: means, scatter, specimens, one row per angle.
std::string target_table(const std::vector<Target>& targets, int terminal_width);

/// What the data determine before anything has run (calibrate/identifiability.hpp).
std::string identifiability_table(const std::vector<ParameterEstimate>& estimates, int terminal_width);

/// Micro-parameters in the order of the paper's Tables 1 and 2, with 95 % intervals.
std::string parameter_tables(const Calibration& calibration, int terminal_width);

/// Laboratory, model, interval and error, one row per angle and property; root mean squares below.
std::string macro_table(const Calibration& calibration, int terminal_width);

/// Verdict with its findings, and which parameters the data leave open.
std::string verdict_text(const Calibration& calibration, int terminal_width);

/// Numbers of tests.
std::string budget_text(const Calibration& calibration, int terminal_width);

}  // namespace phy::report
