// What the data of a rock can and cannot determine, before anything runs.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "records/calibration.hpp"
#include "records/evidence.hpp"
#include "records/finding.hpp"

namespace phy::jobs {

struct RockCheck {
  Evidence evidence;
  std::vector<Finding> doubts;                ///< what to look at before anything else
  std::vector<Finding> statements;            ///< what the table says by itself: closed forms
  std::vector<ParameterEstimate> parameters;  ///< of which intervals are known before the fit, and why
  std::vector<std::string> models;            ///< which models calibrate would compare
  std::vector<Finding> limits;                ///< what the table lacks, or no model has
  std::vector<std::string> in_maps;           ///< where the table lies in the maps of what models reach
  std::optional<std::string> forecast;        ///< of the verdict
};
RockCheck check(const Rock& read);

/// Doubts about the table, how it was understood, what it says by itself, what it would determine, a forecast
/// of the verdict. All of it as text. `path`: the file of the rock, as named to its user.
std::string rock_check(const Rock& read, const std::string& path, int width);

}  // namespace phy::jobs
