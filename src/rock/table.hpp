// The table of laboratory tests behind a rock file: CSV or a workbook (docs/formats.md, "Rock").
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/check.hpp"
#include "records/rock.hpp"
#include "rock/heads.hpp"

namespace phy::rock {

struct Readings {
  std::vector<RockReading> values;
  bool bedded = false;                 ///< there is a column of angles
  bool counts_from_load = false;       ///< they are beta
  bool asked_for_angles = false;       ///< a column may hold them: that is among the problems
  std::optional<ModulusReading> E_is;  ///< what the header of E says
  std::string E_title;                 ///< that header
};

/// Laboratory values from the bytes of a table. `where` names it in messages. Appends what could not be
/// understood to `problems` and how the rest was understood to `notes`.
Readings parse_readings(std::string_view bytes, const std::string& where, const TableKeys& keys,
                        std::vector<Problem>& problems, std::vector<std::string>& notes);

}  // namespace phy::rock
