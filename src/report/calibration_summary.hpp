// What a calibration has found in few lines: cells of one property together, what is open in one line. All
// details are kept where there is room (tables.txt, calibration.json, the folded part of the report).
#pragma once
#include <string>
#include <vector>

#include "records/calibration.hpp"

namespace phy::report {

/// The row by which a value is judged: on unseen packings where there are some, else on those of the fit.
const Comparison& judged(const Calibration& calibration, const Comparison& fitted);

/// What the sentence of the verdict leaves out: gathered findings, and the parameters that the data leave
/// open.
std::vector<std::string> summary_lines(const Calibration& calibration);

/// The same on at most ten lines of the terminal; what does not fit is counted.
std::string summary_text(const Calibration& calibration, int terminal_width);

/// "k_n and k_s": those that the data leave open; may be empty.
std::string open_parameters(const Calibration& calibration);

/// Parameters that the data leave open, those with the same next test together.
std::vector<std::string> open_lines(const Calibration& calibration);

}  // namespace phy::report
