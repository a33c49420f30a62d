// docs/calibration-tables.md: parameters, models, efforts, packings, options and keys of a calibration, from
// the lists that the calibration uses.
#pragma once
#include <string>

namespace phy::jobs {

/// The page, in Markdown.
std::string calibration_reference();

}  // namespace phy::jobs
