// The methods section of a paper, written from the completed recipe of a run, or from a calibration.
#pragma once
#include <string>
#include <vector>

#include "records/calibration.hpp"
#include "records/specimen_record.hpp"

namespace phy::report {

/// Paragraphs on model, specimens, loading and definitions, with the literature; ready to cite.
std::vector<std::string> methods_text(const RunRecord& run);

/// The same of a calibrated model: what it is, what it was fitted to and with how many tests, how well.
std::vector<std::string> methods_text(const Calibration& calibration, const std::string& version);

}  // namespace phy::report
