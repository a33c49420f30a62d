// Options of a calibration on the page: each a control, made from the one list
// (jobs/calibration_options.hpp).
#pragma once
#include "gui/recipes.hpp"
#include "jobs/calibration_options.hpp"

namespace phy::gui {

/// Every option as the page shows it. `on_page`: it has a control; what else there is, the page decides by
/// itself.
Json options_json();

/// What the page has asked for: `options` an object of values by key. Throws InputError.
jobs::CalibrationRequest request_from(const Json& options);

}  // namespace phy::gui
