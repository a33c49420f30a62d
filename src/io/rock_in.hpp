// Rock files: a small TOML file that names a table of laboratory tests (docs/formats.md, "Rock").
#pragma once
#include <string>
#include <string_view>

#include "base/check.hpp"
#include "records/rock.hpp"

namespace phy {

/// Reads a rock file with its table and, where it names one, its recipe (both beside the rock file). Throws
/// IoError, or InputError with every problem of all files.
Rock read_rock(const std::string& path);

/// Laboratory values from the text of a table. `where` names it in messages. `confining` [Pa]: of the rows of
/// a table with several confining pressures only these; NaN: all. Appends what could not be understood to
/// `problems` and how the rest was understood to `notes`; sets `bedded` to whether there is a column of
/// angles.
std::vector<RockReading> parse_readings(std::string_view text, const std::string& where, double confining,
                                        bool& bedded, std::vector<Problem>& problems,
                                        std::vector<std::string>& notes);

/// A commented rock file and the table that it names, to be filled in.
std::string rock_template(const std::string& name);
std::string rock_table_template();

}  // namespace phy
