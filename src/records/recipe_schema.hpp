// THE list of recipe keys. The reader, the writer, `phyllite recipe --explain`, the template and
// docs/reference.md all come from it: a key that is not here does not exist.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "base/check.hpp"
#include "base/units.hpp"
#include "records/recipe.hpp"

namespace phy {

enum class FieldKind { quantity, number, integer, boolean, choice, text, quantities };

/// One key. Numbers, integers, booleans (0, 1) and choices (their place in the list) all travel as double.
struct Field {
  std::string table;  ///< "" = top level, "bedding" = [[bedding]]
  std::string key;
  FieldKind kind = FieldKind::number;
  Dimension dimension = Dimension::none;
  double min = 0.0, max = 0.0;
  bool above_min = false;  ///< the lower bound itself is excluded
  bool below_max = false;  ///< the upper bound itself is excluded
  std::vector<std::string> choices;
  std::string meaning;
  std::string pfc_name;
  /// The one laboratory test that has this key: recipes of other tests are written, and told apart, without
  /// it. Empty: every recipe has it.
  std::string only_of;
  std::function<double(const Recipe&, std::size_t)> get;
  std::function<void(Recipe&, std::size_t, double)> set;
  std::function<std::string(const Recipe&)> get_text;
  std::function<void(Recipe&, const std::string&)> set_text;
  std::function<std::vector<double>&(Recipe&)> list;

  std::string path() const { return table.empty() ? key : table + "." + key; }
};

/// 32 bit contact numbers and memory; hours of computing.
constexpr std::int64_t max_recipe_grains = 200000;

const std::vector<Field>& recipe_fields();

/// "0 deg <= value < 180 deg", "one of zone, crossing", ...
std::string range_text(const Field& field);
/// A value as it is written in a file.
std::string print_field(const Field& field, const Recipe& recipe, std::size_t index);
/// Problems between keys (thickness against spacing, ...). `where(path)` tells file and line of a key; a
/// check is left out if one of its keys has a value that nobody means (`is_known(path)` is false).
std::vector<Problem> cross_checks(
    const Recipe& recipe, const std::function<std::string(const std::string&)>& where,
    const std::function<bool(const std::string&)>& is_known = [](const std::string&) { return true; });
/// True if `word` is one of the names of the field in PFC.
bool has_pfc_name(const Field& field, const std::string& word);
/// What to do about an unknown key of a table ("" = top level): where it belongs, PFC's name for what, or the
/// nearest.
std::string unknown_key_hint(const std::string& word, const std::string& table);

}  // namespace phy
