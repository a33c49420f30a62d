// One value of a key, and what to do where it is none that the key can have.
#include <algorithm>
#include <cmath>

#include "base/quote.hpp"
#include "base/spelling.hpp"
#include "io/document.hpp"
#include "records/recipe_schema.hpp"

namespace phy::io {
namespace {

using Kind = TomlValue::Kind;

/// The value that a key of the recipe has by default.
double usual_of(const Field& field) {
  Recipe recipe;
  // Keys of bedding have no default in a recipe without any.
  recipe.bedding.resize(1);
  return field.get ? field.get(recipe, 0) : 0.0;
}

/// The number of `written` with the unit that brings it into the range, nearest to the usual value; empty
/// where none brings it near.
std::string in_likelier_unit(const Field& f, const std::string& written) {
  // A hundred times off what is usual a guess is no likelier than what was written.
  constexpr double near = 2.0;  // orders of magnitude
  const double usual = usual_of(f);
  const std::string number = written.substr(0, written.find_first_not_of("+-.0123456789eE"));
  std::string best;
  double least = near;
  for (const UnitRow& unit : unit_rows()) {
    const std::string text = number + " " + unit.name;
    const Quantity q = parse_quantity(text, f.dimension);
    if (unit.dimension != f.dimension || !q.ok || !within_range(f, q.value)) continue;
    const double farness = std::fabs(std::log10(std::fabs(q.value / usual)));
    if (farness < least) least = farness, best = text;
  }
  return best;
}

/// A number without a unit for a key that has no usual value to guess it from.
std::string as_pfc_reads(const Field& f, const std::string& written) {
  return "has no unit; in PFC it would be " + toml_string(written + " " + inner_unit(f.dimension));
}

bool take_quantity(const Field& f, const TomlValue& v, double& number, std::string& remedy) {
  const bool numeric = v.kind == Kind::integer || v.kind == Kind::number;
  const std::string written = v.kind == Kind::text ? v.text : as_written(v);
  if (!numeric && v.kind != Kind::text) return remedy = "is no quantity", false;
  const double usual = usual_of(f);
  const Quantity q = parse_quantity(written, f.dimension, usual);
  const bool bare = parse_quantity(written, Dimension::none).ok;
  // A bare number goes through the same parser: its message says which unit is missing.
  if (!q.ok) {
    remedy = bare && usual == 0.0 && !f.pfc_name.empty() ? as_pfc_reads(f, written) : q.problem;
    return false;
  }
  number = q.value;
  if (within_range(f, number)) return true;
  // The caller prints the range, which says the rest.
  if (const std::string likelier = in_likelier_unit(f, written); !likelier.empty())
    remedy = "did you mean " + toml_string(likelier) + "?";
  return false;
}

bool take_choice(const Field& f, const TomlValue& v, double& number, std::string& remedy) {
  // A value that is not text fails too: no choice is empty.
  const std::string word = v.kind == Kind::text ? v.text : "";
  const auto it = std::find(f.choices.begin(), f.choices.end(), word);
  number = static_cast<double>(it - f.choices.begin());
  if (it != f.choices.end()) return true;
  const std::string near = nearest(word, f.choices);
  if (!near.empty()) remedy = "did you mean \"" + near + "\"?";
  return false;
}

}  // namespace

bool take_value(const Field& field, const TomlValue& value, double& number, std::string& remedy) {
  const bool text = value.kind == Kind::text, whole = value.kind == Kind::integer;
  const bool numeric = whole || value.kind == Kind::number;
  // A value of the wrong kind is reported by the caller, with the range; the remedy stays empty.
  if (field.kind == FieldKind::boolean) return number = value.number, value.kind == Kind::boolean;
  if (field.kind == FieldKind::choice) return take_choice(field, value, number, remedy);
  const bool wants_whole = field.kind == FieldKind::integer || field.kind == FieldKind::integers;
  if (field.dimension != Dimension::none) return take_quantity(field, value, number, remedy);
  if (!whole && !(numeric && !wants_whole)) {
    const std::optional<double> quotient = text && !wants_whole ? fraction(value.text) : std::nullopt;
    remedy = wants_whole ? "write a whole number"
             : quotient  ? "write it as a number: " + print_number(rounded(*quotient, 6))
                         : "write a bare number";
    return false;
  }
  // Dimensionless: TOML's own numbers; text such as "0.5" is refused. A whole number may stand for a real
  // one.
  number = value.number == 0.0 ? 0.0 : value.number;  // not -0
  // Out of range: the caller prints the range, which says all.
  return within_range(field, number);
}

}  // namespace phy::io
