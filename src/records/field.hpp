// A key of a file that the user writes. Every kind of file (recipe, rock, study, regressions) has one list of
// these; its reader, its messages, `--explain` and docs/reference.md come from that list: a key that is not
// in it does not exist.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "base/units.hpp"

namespace phy {

struct Recipe;

/// `quantities`: a list of numbers, with units where there is a dimension; `integers`: a list of different
/// whole numbers; `value` and `values`: what another key may have, or a list of that.
enum class FieldKind {
  quantity,
  number,
  integer,
  boolean,
  choice,
  text,
  quantities,
  integers,
  value,
  values
};

/// Bounds of what has none.
constexpr double unbounded = 1e300;

/// One key. Numbers, integers, booleans (0, 1) and choices (their place in the list) all travel as double.
struct Field {
  std::string table;  ///< "" = top level, "bedding" = [[bedding]]
  std::string key;    ///< in quotes: any key
  FieldKind kind = FieldKind::number;
  Dimension dimension = Dimension::none;
  double min = 0.0, max = 0.0;
  bool above_min = false;  ///< the lower bound itself is excluded
  bool below_max = false;  ///< the upper bound itself is excluded
  std::vector<std::string> choices;
  std::string meaning;
  std::string pfc_name;
  std::string former;     ///< its name in earlier versions: accepted, with a note
  std::string otherwise;  ///< the default, as in a file; empty: there is none, or `meaning` tells

  // Of a key of the recipe: the one laboratory test that has it (recipes of other tests are written, and told
  // apart, without it; empty: every recipe has it), and its place there.
  std::string only_of;
  // Of a key that recipes had not from the start: written only where it is not as by default.
  bool quiet = false;
  std::function<double(const Recipe&, std::size_t)> get;
  std::function<void(Recipe&, std::size_t, double)> set;
  std::function<std::string(const Recipe&)> get_text;
  std::function<void(Recipe&, const std::string&)> set_text;
  std::function<std::vector<double>&(Recipe&)> list;

  std::string path() const { return path_of(key); }
  std::string path_of(const std::string& name) const { return table.empty() ? name : table + "." + name; }
};
using Fields = std::vector<Field>;

/// "0 deg <= value < 180 deg", "one of zone, crossing", ...
std::string range_text(const Field& field);
/// False for NaN too.
bool within_range(const Field& field, double value);
/// True if `word` is one of the names of the field in PFC.
bool has_pfc_name(const Field& field, const std::string& word);
/// The field of that path, or whose former path it is; nullptr if there is none.
const Field* find_field(const Fields& fields, const std::string& path);

}  // namespace phy
