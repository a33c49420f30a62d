#include "records/field.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>

namespace phy {
namespace {

std::string bound(const Field& f, double value) {
  const bool whole = f.kind == FieldKind::integer || f.kind == FieldKind::integers;
  return whole ? std::to_string(static_cast<std::int64_t>(value)) : print_quantity(value, f.dimension);
}

std::string interval(const Field& f) {
  // 1e300 is no bound that anybody should read.
  if (f.max >= unbounded) return "numbers";
  return bound(f, f.min) + (f.above_min ? " < value" : " <= value") + (f.below_max ? " < " : " <= ") +
         bound(f, f.max);
}

}  // namespace

std::string range_text(const Field& f) {
  switch (f.kind) {
    case FieldKind::text: return "text";
    case FieldKind::boolean: return "true or false";
    case FieldKind::value: return "a value";
    case FieldKind::values: return "a list of values";
    case FieldKind::quantities: return "a list of " + interval(f);
    case FieldKind::integers: return "a list of different whole numbers, " + interval(f);
    case FieldKind::choice: {
      std::string s = "one of";
      for (const std::string& c : f.choices) s += " \"" + c + "\"";
      return s;
    }
    default: return f.max >= unbounded ? "a number" : interval(f);
  }
}

bool within_range(const Field& f, double value) {
  return (f.above_min ? value > f.min : value >= f.min) && (f.below_max ? value < f.max : value <= f.max);
}

bool has_pfc_name(const Field& f, const std::string& word) {
  // A field may have several names there, "emod, E_c": the word must be one of them, not a part of one.
  const std::size_t at = word.empty() ? std::string::npos : f.pfc_name.find(word);
  if (at == std::string::npos) return false;
  const auto part_of_name = [&](std::size_t i) {
    return i < f.pfc_name.size() &&
           (std::isalnum(static_cast<unsigned char>(f.pfc_name[i])) != 0 || f.pfc_name[i] == '_');
  };
  return (at == 0 || !part_of_name(at - 1)) && !part_of_name(at + word.size());
}

const Field* find_field(const Fields& fields, const std::string& path) {
  const auto it =
      std::find_if(fields.begin(), fields.end(), [&](const Field& f) { return f.path() == path; });
  return it == fields.end() ? nullptr : &*it;
}

Field make_field(FieldKind kind, const char* table, const char* key, const char* meaning) {
  Field f;
  f.kind = kind, f.table = table, f.key = key, f.meaning = meaning;
  return f;
}

}  // namespace phy
