// What the data of a rock can and cannot determine, before anything runs.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "calibrate/evidence.hpp"
#include "records/calibration.hpp"

namespace phy::jobs {

struct RockCheck {
  calibrate::Evidence evidence;
  /// What to look at before anything else: the sense of the angles, units and ratios, outliers.
  std::vector<std::string> doubts;
  std::vector<std::string> notes;  ///< how the files were understood, less what is among the doubts
  std::vector<std::string> says;   ///< what the table says by itself: closed forms
  std::vector<ParameterEstimate> parameters;  ///< of which intervals are known before the fit, and why
  std::vector<std::string> advice;
  std::optional<std::string> forecast;  ///< the verdict foretold
};
RockCheck check(const Rock& read);

/// Doubts about the table, how it was understood, what it says by itself, what it would determine, the
/// verdict foretold. All of it as text. `path`: the file of the rock, as named to its user.
std::string rock_check(const Rock& read, const std::string& path, int width);

}  // namespace phy::jobs
