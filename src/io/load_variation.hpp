// Studies (results.csv) and sweeps of the elastic solution (fig4.csv, moduli.csv) read back for pictures
// (docs/formats.md).
#pragma once
#include <string>
#include <vector>

#include "records/variation.hpp"

namespace phy::io {

/// True if the folder holds what read_variations reads.
bool holds_variations(const std::string& folder);

/// Of a study: one. Of a sweep: one per recipe and bedding rule, as the linear contacts push only, the gauge
/// reads and Eq. 1 is fitted in compliance with the E of the intact specimen. Throws IoError, or InputError
/// when a table is not one of ours. No parameters where nothing varies one at a time (sampled designs).
std::vector<Variation> read_variations(const std::string& folder);

}  // namespace phy::io
