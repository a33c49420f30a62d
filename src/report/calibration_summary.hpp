// Views of a calibration that several texts share: the row by which a value is judged, the parameters that
// the data leave open.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "records/calibration.hpp"

namespace phy::report {

/// The row by which a value is judged: on unseen packings where there are some, else on those of the fit.
const Comparison& judged(const Calibration& calibration, const Comparison& fitted);

/// "k_n and k_s": those that the data leave open; may be empty.
std::string open_parameters(const Calibration& calibration);

/// Of the words for tests in tension, in bending, and of bedding, those for the tests beside compression.
std::vector<std::string> other_tests(const Calibration& calibration, const std::array<const char*, 3>& words);

/// Parameters that the data leave open, those with the same next test together.
std::vector<std::string> open_lines(const Calibration& calibration);

}  // namespace phy::report
