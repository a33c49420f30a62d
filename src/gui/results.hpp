// What has come of a rock, for the page to draw: figures over all its tests, and specimens as they broke.
#pragma once
#include <string>

#include "gui/table_check.hpp"

namespace phy::gui {

/// Figures of laboratory, calibration and tests. `calibration`: its folder; one without results is left out.
Json results_answer(const std::string& rock, const std::string& calibration);

/// The specimens of a test with their scenes, as a report carries them. Throws IoError, InputError.
Json broken_answer(const std::string& rock, const std::string& test);

}  // namespace phy::gui
