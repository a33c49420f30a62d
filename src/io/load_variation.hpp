// Studies (results.csv) read back for pictures (docs/formats.md).
#pragma once
#include <string>

#include "records/variation.hpp"

namespace phy::io {

/// True if the folder holds what read_variation reads.
bool holds_variation(const std::string& folder);

/// Throws IoError, or InputError when a table is not one of ours. No parameters where nothing varies one at a
/// time (sampled designs).
Variation read_variation(const std::string& folder);

}  // namespace phy::io
