// A key of a file that the user writes. Every kind of file (recipe, rock, study, regressions) has one list of
// these; its reader, its messages, `--explain` and docs/reference.md come from that list: a key that is not
// in it does not exist.
#pragma once
#include <functional>
#include <string>
#include <utility>
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
  std::string default_text;  ///< as in a file; empty: there is none, or `meaning` says it

  // Of a key of the recipe: the one laboratory test that has it (recipes of other tests are written, and told
  // apart, without it; empty: every recipe has it), whether it is left out of a file where it is as by
  // default, and its place in the recipe.
  std::string test;
  /// Kinds of laboratory test that alone read it, for whoever offers keys by the test; empty: all do.
  std::vector<std::string> read_by;
  bool omit_default = false;
  std::function<double(const Recipe&, std::size_t)> get;
  std::function<void(Recipe&, std::size_t, double)> set;
  std::function<std::string(const Recipe&)> get_text;
  std::function<void(Recipe&, const std::string&)> set_text;
  std::function<std::vector<double>&(Recipe&)> list;

  std::string path() const { return table.empty() ? key : table + "." + key; }

  // For the lists, where one statement gives a key all that it has.
  Field& within(double low, double high) { return min = low, max = high, *this; }
  Field& one_of(std::vector<std::string> words) { return choices = std::move(words), max = unbounded, *this; }
  Field& of_tests(std::vector<std::string> kinds) { return read_by = std::move(kinds), *this; }
  Field& by_default(std::string text) { return default_text = std::move(text), *this; }
};
using Fields = std::vector<Field>;

/// A key without bounds, of the top level where `table` is "".
Field make_field(FieldKind kind, const char* table, const char* key, const char* meaning);

/// "0 deg <= value < 180 deg", "one of zone, crossing", ...
std::string range_text(const Field& field);
/// False for NaN too.
bool within_range(const Field& field, double value);
/// True if `word` is one of the names of the field in PFC.
bool has_pfc_name(const Field& field, const std::string& word);
/// The field of that path; nullptr if there is none.
const Field* find_field(const Fields& fields, const std::string& path);

}  // namespace phy
