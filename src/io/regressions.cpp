#include "io/regressions.hpp"

#include <cmath>
#include <optional>

#include "base/nan.hpp"
#include "base/quote.hpp"
#include "base/units.hpp"
#include "io/file.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"

namespace phy::io {
namespace {

constexpr Dimension dimensions[] = {Dimension::none,      Dimension::length, Dimension::pressure,
                                    Dimension::stiffness, Dimension::angle,  Dimension::speed,
                                    Dimension::density};

Fields regression_fields() {
  using K = FieldKind;
  // Published lines may have any sign and size.
  const auto line = [](K kind, const char* key, const char* meaning) {
    return make_field(kind, "line", key, meaning).within(-unbounded, unbounded);
  };
  return {line(K::text, "source", "who found it, and where it stands"),
          line(K::text, "number", "what depends on the key, as results name it: \"K_n\", \"ucs\""),
          line(K::text, "key", "a key of the recipe: \"bedding.k_n\""),
          line(K::number, "slope", "SI units of the number per SI unit of the key"),
          line(K::value, "intercept", "where the key is 0, with its unit"),
          line(K::number, "R2", "its coefficient of determination, where it is given").within(0.0, 1.0)};
}

/// A number with any unit.
std::optional<double> take_any_unit(const TomlValue& v, std::string& unit) {
  // The unit of a result is not known here, so the first dimension that accepts the text decides.
  for (const Dimension d : dimensions) {
    const Quantity q = parse_quantity(v.kind == TomlValue::Kind::text ? v.text : as_written(v), d);
    if (q.ok) return unit = inner_unit(d), q.value;
  }
  return std::nullopt;
}

Regression read_line(Document& file, const TomlValue& table, const std::string& path) {
  Regression line;
  // Every key is needed: a line without its source or unit cannot be compared.
  for (const char* key : {"source", "number", "key", "slope", "intercept"})
    if (table.find(key) == nullptr)
      file.report_problem(table, path + key, "a line with source, number, key, slope and intercept", "");
  line.source = file.text(path + "source", ""), line.number = file.text(path + "number", "");
  line.key = file.text(path + "key", "");
  line.slope = file.number(path + "slope", 0.0);
  line.R2 = file.number(path + "R2", nan);
  if (!line.key.empty() && find_field(recipe_fields(), line.key) == nullptr)
    file.report_problem(*file.find(path + "key"), path + "key", "a key of the recipe",
                        recipe_key_hint(line.key));
  if (const TomlValue* intercept = file.find(path + "intercept")) {
    const std::optional<double> value = take_any_unit(*intercept, line.unit);
    if (!value)
      file.report_problem(*intercept, path + "intercept", "a number with its unit",
                          "for example \"312.4 GPa/m\"");
    line.intercept = value.value_or(0.0);
  }
  return line;
}

}  // namespace

const Schema& regression_schema() {
  static const Fields fields = regression_fields();
  static const Schema schema{"file of regressions", "study", fields, {{"line", 100}}, ""};
  return schema;
}

std::vector<Regression> read_regressions(const std::string& path) {
  Document file(read_file(path, largest_document), path, regression_schema());
  std::vector<Regression> lines;
  for (const TomlValue* table : file.tables("line"))
    lines.push_back(read_line(file, *table, "line[" + std::to_string(lines.size()) + "]."));
  if (lines.empty() && file.problems.empty())
    file.problems.push_back({path, "line", "", "at least one line", "write [[line]] above the keys of each"});
  file.check();
  return lines;
}

std::string write_regressions(const std::vector<Regression>& regressions) {
  std::string text;
  for (const Regression& r : regressions) {
    const std::string intercept = print_number(r.intercept);
    text += "[[line]]\nsource = " + toml_string(r.source) + "\nnumber = " + toml_string(r.number) +
            "\nkey = " + toml_string(r.key) + "\nslope = " + print_number(r.slope) +
            // A pure number stays bare: quotes are for quantities with a unit.
            "\nintercept = " + (r.unit == "1" ? intercept : toml_string(intercept + " " + r.unit)) + "\n";
    if (std::isfinite(r.R2)) text += "R2 = " + print_number(r.R2) + "\n";
  }
  return text;
}

}  // namespace phy::io
