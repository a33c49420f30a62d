// What somebody may have meant by a key that there is not.
#include <algorithm>

#include "base/quote.hpp"
#include "base/spelling.hpp"
#include "io/document.hpp"
#include "records/foreign_words.hpp"
#include "records/recipe_schema.hpp"

namespace phy::io {
namespace {

bool is_of_recipe(const std::string& word) {
  return std::any_of(recipe_fields().begin(), recipe_fields().end(),
                     [&](const Field& f) { return f.key == word || f.table == word; });
}

/// The value of a key that another program's word and value mean, as in a file; empty where it is none that
/// the key can have.
std::string value_from(const ForeignWord& word, const TomlValue& value) {
  const Field& f = *word.field;
  double theirs = value.number;
  if (value.kind == TomlValue::Kind::text) {
    const Quantity q = parse_quantity(value.text, f.dimension);
    if (!q.ok) return "";
    theirs = q.value;
  } else if (value.kind != TomlValue::Kind::integer && value.kind != TomlValue::Kind::number) {
    return "";
  }
  // 1/kratio of 3.333 should not be advised with sixteen digits.
  const double ours = rounded(value_of(word, theirs), 6);
  if (!within_range(f, ours)) return "";
  return f.kind == FieldKind::quantity ? toml_string(print_quantity(ours, f.dimension)) : print_number(ours);
}

std::string foreign_word_hint(const Schema& schema, const ForeignWord& foreign, const std::string& word,
                              const std::string& table, const TomlValue& value) {
  const Field& f = *foreign.field;
  const std::string ours = value_from(foreign, value);
  std::string hint = "PFC's \"" + word + "\" is given by " + f.path();
  if (foreign.formula != word) hint += " (" + foreign.formula + ")";
  if (ours.empty()) return hint;
  return hint + ": write " + f.key + " = " + ours +
         (f.table == table ? "" : " under " + schema.in_brackets(f.table));
}

}  // namespace

/// The order decides which hint is given where several fit: a recipe key at the top level, a known key of
/// another table, a name of PFC, and last a similar spelling.
std::string unknown_key_hint(const Schema& schema, const std::string& word, const std::string& table,
                             const TomlValue& value) {
  if (!schema.of_recipe.empty() && table.empty() && is_of_recipe(word)) return schema.of_recipe;
  std::vector<std::string> known;
  for (const Field& f : schema.fields) {
    if (f.table == table) known.push_back(f.key);
    // At the top level the names of tables are what could have been meant.
    if (table.empty() && !f.table.empty()) known.push_back(f.table);
  }
  for (const Field& f : schema.fields)
    if (f.key == word) return "it belongs to " + schema.in_brackets(f.table);
  const ForeignWord foreign = foreign_word(schema.fields, word, table);
  if (foreign.field != nullptr) return foreign_word_hint(schema, foreign, word, table, value);
  if (!foreign.instead.empty()) return foreign.instead;
  const std::string near = nearest(word, known);
  if (!near.empty()) return "did you mean \"" + near + "\"?";
  return schema.verb.empty() ? "another version may have written it"
                             : "`phyllite " + schema.verb + " --reference` lists all keys";
}

}  // namespace phy::io
