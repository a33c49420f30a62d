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
  Evidence evidence;                               ///< by the first model of those that may be tried
  Evidence as_read;                                ///< as the file leaves the model open
  std::vector<Finding> doubts = {};                ///< what to look at before anything else
  std::vector<Finding> statements = {};            ///< what the table says by itself: closed forms
  std::vector<ParameterEstimate> parameters = {};  ///< of which intervals are known before the fit, and why
  std::vector<std::string> models = {};            ///< which models calibrate would compare
  std::vector<Finding> limits = {};                ///< what the table lacks, or no model has
  std::vector<std::string> in_maps = {};           ///< where the table lies in the maps of what models reach
  std::vector<Finding> forecast = {};              ///< of the verdict, its end first; empty: there is none
  std::optional<Finding> neighbour = {};           ///< the measured rocks that are nearest
};
RockCheck check(const Rock& read);

}  // namespace phy::jobs
