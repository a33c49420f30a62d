#include "io/load_variation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "base/units.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/regressions.hpp"
#include "io/table.hpp"
#include "io/toml_in.hpp"
#include "io/toml_tree.hpp"
#include "records/jointed.hpp"
#include "records/recipe_schema.hpp"
#include "records/result.hpp"

namespace phy::io {
namespace {

namespace fs = std::filesystem;
using Rows = std::vector<const TableRow*>;

double number_of(const std::string& cell) {
  const Quantity q = parse_quantity(cell, Dimension::none);
  return q.ok ? q.value : nan;
}

/// A table whose columns are asked for by name.
class Named {
 public:
  explicit Named(const std::string& file) : file_(file), table_(parse_table(read_written(file), file)) {
    if (!table_.problems.empty()) throw InputError(table_.problems);
  }
  std::size_t column(const std::string& name) const {
    const std::optional<std::size_t> found = maybe(name);
    if (!found)
      throw InputError(
          Problem{file_, name, "", "a column of this name", "write the table anew with this program"});
    return *found;
  }
  /// Where nothing has been finished, numbers have no columns yet.
  std::optional<std::size_t> maybe(const std::string& name) const {
    const auto it = std::find(table_.header.begin(), table_.header.end(), name);
    if (it == table_.header.end()) return std::nullopt;
    return static_cast<std::size_t>(it - table_.header.begin());
  }
  const std::string& at(const TableRow& row, const std::string& name) const {
    return row.cells[column(name)];
  }
  Rows rows(const std::function<bool(const TableRow&)>& wanted) const {
    Rows out;
    for (const TableRow& row : table_.rows)
      if (wanted(row)) out.push_back(&row);
    return out;
  }
  const Table& table() const { return table_; }
  const std::string& file() const { return file_; }

 private:
  std::string file_;
  Table table_;
};

/// What a study knows of E: the tangent of a test, or the direct solution read by the gauge.
std::optional<std::size_t> modulus_column(const Named& table) {
  // A tangent where there is one: a column of this name comes only from tests in time.
  const std::optional<std::size_t> tangent = table.maybe("E_tangent [Pa]");
  return tangent ? tangent : table.maybe("E_gauge [Pa]");
}

/// A column over the inclination: mean and interval of all rows of one angle.
std::vector<AngleValue> over_angles(const Rows& rows, std::size_t theta, std::optional<std::size_t> value) {
  // Replicates of one angle fall into one sample.
  std::map<double, std::vector<double>> found;
  for (const TableRow* row : rows)
    if (const double angle = number_of(row->cells[theta]), v = value ? number_of(row->cells[*value]) : nan;
        std::isfinite(angle) && std::isfinite(v))
      found[angle].push_back(v);
  std::vector<AngleValue> out;
  for (const auto& [angle, values] : found) out.push_back({angle, summarise(values)});
  return out;
}

/// The same for every packing and bond seed by itself.
std::vector<std::vector<AngleValue>> each_over_angles(const Named& table, const Rows& rows) {
  std::map<std::pair<std::string, std::string>, Rows> replicates;
  // Replicates are told apart by the two seeds, compared as text.
  for (const TableRow* row : rows)
    replicates[{table.at(*row, "packing"), table.at(*row, "bond_seed")}].push_back(row);
  std::vector<std::vector<AngleValue>> out;
  for (const auto& [seeds, own] : replicates)
    out.push_back(over_angles(own, table.column("theta [deg]"), modulus_column(table)));
  return out;
}

double mean_of(const Rows& rows, std::optional<std::size_t> value) {
  std::vector<double> values;
  for (const TableRow* row : rows)
    if (const double v = value ? number_of(row->cells[*value]) : nan; std::isfinite(v)) values.push_back(v);
  return values.empty() ? 0.0 : summarise(values).mean;
}

/// A value as the recipe would print it: "840 GPa/m". `column`: "bedding.k_n [Pa/m]".
std::string value_text(const std::string& column, const std::string& cell) {
  const double value = number_of(cell);
  const Field* field = find_field(recipe_fields(), without_index(column.substr(0, column.find(' '))));
  if (field == nullptr || !std::isfinite(value)) return cell;
  return print_quantity(rounded(value, 6),
                        field->dimension);  // no last digits of a product
}

/// Different cells of a column, ascending by their numbers.
std::vector<std::string> levels_in(const Rows& rows, std::size_t column) {
  std::vector<std::string> levels;
  // Compared as text: equal settings are printed equally.
  for (const TableRow* row : rows)
    if (std::find(levels.begin(), levels.end(), row->cells[column]) == levels.end())
      levels.push_back(row->cells[column]);
  std::stable_sort(levels.begin(), levels.end(),
                   [](const std::string& a, const std::string& b) { return number_of(a) < number_of(b); });
  return levels;
}

/// The varied keys are the columns after `intact` whose names have a full stop.
std::vector<std::size_t> varied_columns(const Named& table) {
  // A key has its table in front ("bedding.k_n"), a number has none ("ucs").
  std::vector<std::size_t> columns;
  for (std::size_t i = table.column("intact") + 1; i < table.table().header.size(); ++i)
    if (table.table().header[i].substr(0, table.table().header[i].find(' ')).find('.') != std::string::npos)
      columns.push_back(i);
  return columns;
}

/// The largest stress of a test without a peak is not a strength: such tests are left out.
bool has_answer(const Named& table, const TableRow& row) {
  const std::optional<Status> status = status_of(table.at(row, "status"));
  return status && phy::has_answer(*status);
}

/// One column through its levels while the others stay as in `base`.
VariedParameter vary_one(const Named& table, const std::vector<std::size_t>& columns, std::size_t column,
                         const TableRow& base) {
  const std::string& head = table.table().header[column];
  VariedParameter parameter{head.substr(0, head.find(' ')), {}};
  // Bedded specimens whose other varied keys are as in the base.
  const Rows alike = table.rows([&](const TableRow& row) {
    return table.at(row, "intact") == "0" && std::all_of(columns.begin(), columns.end(), [&](std::size_t c) {
             return c == column || row.cells[c] == base.cells[c];
           });
  });
  const std::size_t theta = table.column("theta [deg]");
  for (const std::string& level : levels_in(alike, column)) {
    Rows rows;
    std::copy_if(alike.begin(), alike.end(), std::back_inserter(rows),
                 [&](const TableRow* row) { return row->cells[column] == level && has_answer(table, *row); });
    // As a multiple of the base value; without meaning where that is 0.
    const double base_value = number_of(base.cells[column]);
    parameter.settings.push_back(
        {value_text(head, level), number_of(level), base_value != 0.0 ? number_of(level) / base_value : nan,
         level == base.cells[column], over_angles(rows, theta, modulus_column(table)),
         over_angles(rows, theta, table.maybe("ucs [Pa]")), each_over_angles(table, rows)});
  }
  return parameter;
}

/// Of its study file, where that has one.
std::string name_of_study(const std::string& folder, const std::string& otherwise) {
  const fs::path file = fs::path(folder) / "study.toml";
  if (!fs::exists(file)) return otherwise;
  std::vector<Problem> problems;
  const TomlValue study = parse_toml(read_file(file.string(), largest_document), file.string(), problems);
  if (!problems.empty()) throw InputError(std::move(problems));
  const TomlValue* name = study.find("name");
  return name == nullptr || name->text.empty() ? otherwise : name->text;
}

}  // namespace

Variation read_variation(const std::string& folder) {
  const Named table((fs::path(folder) / "results.csv").string());
  const Recipe recipe = read_recipe((fs::path(folder) / "recipe.toml").string());
  if (table.table().rows.empty()) throw InputError(Problem{table.file(), "", "", "rows", "run the study"});
  Variation v;
  v.name = name_of_study(folder, recipe.name);
  // Without weak planes there is no spacing, and pictures leave Eq. 1 out.
  if (has_weak_planes(recipe)) v.spacing = recipe.bedding[0].spacing;
  const Rows intact = table.rows(
      [&](const TableRow& row) { return table.at(row, "intact") == "1" && has_answer(table, row); });
  v.E_intact = mean_of(intact, modulus_column(table));
  const std::vector<std::size_t> columns = varied_columns(table);
  // The first row belongs to the first point, which is the base in a one_at_a_time study.
  for (const std::size_t c : columns)
    // A key with a single level was not varied alone.
    if (VariedParameter p = vary_one(table, columns, c, table.table().rows.front()); p.settings.size() > 1)
      v.parameters.push_back(std::move(p));
  // A ratio that varies away from 1 leaves no isotropic rock between the planes.
  for (const VariedParameter& p : v.parameters)
    if (p.key == "matrix.stiffness_ratio" || p.key == "matrix.tension_ratio" ||
        p.key == "matrix.cohesion_ratio" || p.key == "matrix.cohesion_oblique")
      v.spacing = 0.0;
  if (const std::string found = (fs::path(folder) / regressions_file).string(); fs::exists(found))
    v.regressions = read_regressions(found);
  return v;
}

bool holds_variation(const std::string& folder) {
  std::error_code none;
  return fs::exists(fs::path(folder) / "results.csv", none);
}

}  // namespace phy::io
