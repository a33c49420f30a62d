// A parsed TOML file as plain values with line numbers. Its source is the only place that sees toml++. Values
// that stand in no file (keys given to a function) are such a tree, too, with line 0.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/check.hpp"

namespace phy::io {

struct TomlValue {
  enum class Kind { text, integer, number, boolean, list, table, date };
  struct Key {
    std::string name;
    std::size_t line = 0;
  };
  Kind kind = Kind::date;
  std::string text;     ///< of a text; of an integer as written
  double number = 0.0;  ///< also of an integer; a boolean is 0 or 1
  std::size_t line = 0;
  std::vector<Key> keys;         ///< of a table
  std::vector<TomlValue> items;  ///< of a list, or the values belonging to `keys`

  /// The value of a key of a table; nullptr if it is not there.
  const TomlValue* find(std::string_view key) const;
};

/// The root table. Lines that are no TOML are reported in `problems` and left out; throws InputError where
/// nothing can be read.
TomlValue parse_toml(std::string_view text, const std::string& where, std::vector<Problem>& problems);

/// The value as it stands in the file, for messages.
std::string as_written(const TomlValue& value);
/// What "1/1.5" comes to; nothing for any other text.
std::optional<double> fraction(std::string_view text);
/// "recipe.toml:12"; of line 0 `where` alone.
std::string at_line(const std::string& where, std::size_t line);

}  // namespace phy::io
