// Rock files: a small TOML file that names a table of laboratory tests (docs/formats.md, "Rock").
#pragma once
#include <optional>
#include <string>
#include <string_view>

#include "io/document.hpp"
#include "records/rock.hpp"

namespace phy::rock {

/// Reads a rock file with its table and, where it names one, its recipe (both beside the rock file). Throws
/// IoError, or InputError with every problem of all files.
Rock read_rock(const std::string& path);

/// What a caller holds in place of the files that the keys `data` and `recipe` name; the names stay in
/// messages.
struct RockParts {
  std::optional<std::string> table;  ///< the text of the table
  std::optional<Recipe> recipe;
};
/// As read_rock, from the text of a rock file that is or will be at `path`.
Rock parse_rock(std::string_view text, const std::string& path, const RockParts& parts);
/// As read_rock, from keys that stand in no file; the files that they name count from the working directory.
Rock rock_of(io::TomlValue keys, const std::string& where, const RockParts& parts);

}  // namespace phy::rock
