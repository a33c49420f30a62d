// Tables of a calibration for the terminal, plain ASCII, no wider than it is (0: no limit).
// Reads records only.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "records/calibration.hpp"

namespace phy::report {

/// The laboratory's table as it was understood: means, scatter, specimens, one row per angle, of rock
/// without bedding one per stress on the sides.
std::string target_table(const std::vector<Target>& targets, bool bedded, int terminal_width);

/// What the data determine before anything has run (survey/identifiability.hpp).
std::string identifiability_table(const std::vector<ParameterEstimate>& estimates, int terminal_width);

/// Micro-parameters in the order of the paper's Tables 1 and 2, with 95 % intervals.
struct ParameterTable {
  std::string title;                                      ///< "Table 1. Intact rock"; empty: goes on
  std::string head;                                       ///< "balls"
  std::vector<std::pair<std::string, std::string>> rows;  ///< name with unit, value in words
};
std::vector<ParameterTable> parameter_rows(const Calibration& calibration);
std::string parameter_tables(const Calibration& calibration, int terminal_width);

/// Laboratory, model and error, angles across.
std::string angle_table(const Calibration& calibration, int terminal_width);

/// How specimens of the model fail, on unseen packings where there are: a line per test. Empty where nothing
/// is known.
std::string failure_table(const Calibration& calibration, int terminal_width);

/// Errors of each property, and what simpler rules miss the same cells by (report/baselines.hpp).
std::string error_table(const Calibration& calibration, int terminal_width);

/// Every cell with standard error, interval, fit and unseen packings.
std::string macro_table(const Calibration& calibration, int terminal_width);

/// Eq. 2 on the packings of the fit, and with other planes; empty where Eq. 1 is not of the model.
std::string eq2_table(const Calibration& calibration, int terminal_width);

/// The verdict in one sentence.
std::string sentence_text(const Calibration& calibration, int terminal_width);

/// Verdict with all findings, which parameters the data leave open, and notes.
std::string verdict_text(const Calibration& calibration, int terminal_width);

/// Numbers of tests.
std::string budget_text(const Calibration& calibration, int terminal_width);

}  // namespace phy::report
