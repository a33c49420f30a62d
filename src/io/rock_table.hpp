// The table of laboratory tests behind a rock file: CSV with units in its header (docs/formats.md, "Rock").
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/check.hpp"
#include "records/rock.hpp"

namespace phy::io {

/// Laboratory values from the text of a table. `where` names it in messages. `confining` [Pa]: of the rows of
/// a table with several confining pressures only these; NaN: all. Appends what could not be understood to
/// `problems` and how the rest was understood to `notes`; sets `bedded` to whether there is a column of
/// angles.
std::vector<RockReading> parse_readings(std::string_view text, const std::string& where, double confining,
                                        bool& bedded, std::vector<Problem>& problems,
                                        std::vector<std::string>& notes);

}  // namespace phy::io
