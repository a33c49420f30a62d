// The specimen that the page shows before any test: its discs, and its moduli at the angle to which somebody
// has turned the bedding.
#pragma once
#include <optional>
#include <string>

#include "gui/table_check.hpp"

namespace phy::gui {

/// Discs and planes of the model that a rock file describes. Throws InputError where it has problems.
Json discs_answer(const std::string& name, const std::string& toml, const std::optional<std::string>& table);

/// E and nu of a calibrated rock [`recipe`, a file] at an inclination of its bedding [deg], by the direct
/// solution; null where it has no answer.
Json moduli_answer(const std::string& recipe, double theta);

}  // namespace phy::gui
