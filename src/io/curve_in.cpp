#include "io/curve_in.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/nan.hpp"
#include "base/units.hpp"
#include "io/file.hpp"
#include "io/table.hpp"

namespace phy::io {
namespace {

constexpr std::size_t least_rows = 5;
constexpr std::size_t most_reported = 20;  // bad cells; more say nothing new

struct Role {
  std::vector<const char*> names;  ///< in lower case, the first that is there counts
  const char* units;
  double HistoryRow::*value;
  std::optional<double> (*factor)(const std::string& unit);
};

std::optional<double> strain_factor(const std::string& unit) {
  if (unit == "1" || unit == "-" || unit == "mm/mm" || unit == "m/m") return 1.0;
  if (unit == "%") return 1e-2;
  if (unit == "microstrain" || unit == "um/m") return 1e-6;
  return {};
}
std::optional<double> stress_factor(const std::string& unit) {
  const Quantity q = parse_quantity("1 " + unit, Dimension::pressure);
  return q.ok ? std::optional(q.value) : std::nullopt;
}
std::optional<double> count_factor(const std::string& unit) {
  return unit.empty() || unit == "1" || unit == "-" ? std::optional(1.0) : std::nullopt;
}

const std::vector<Role>& roles() {
  static const std::vector<Role> list = {
      {{"axial_strain", "strain", "epsilon"},
       "[1], [%] or [microstrain]",
       &HistoryRow::axial_strain,
       strain_factor},
      {{"axial_stress", "stress", "sigma"},
       "[Pa], [kPa], [MPa] or [GPa]",
       &HistoryRow::axial_stress,
       stress_factor},
      {{"n_cracks", "cracks"}, "[1]", &HistoryRow::n_cracks, count_factor}};
  return list;
}

struct CurveColumn {
  const Role* role;
  std::size_t cell;
  double factor;
};

class CurveReader {
 public:
  CurveReader(std::string_view text, std::string where)
      : where_(std::move(where)), table_(parse_table(text, where_)), problems_(table_.problems) {}

  ForeignCurve read() {
    curve_.notes = table_.notes;
    if (problems_.empty()) find_columns();
    if (problems_.empty()) read_rows();
    if (!problems_.empty()) throw InputError(problems_);
    turn();
    return std::move(curve_);
  }

 private:
  std::string where_;
  Table table_;
  std::vector<Problem> problems_;
  std::vector<CurveColumn> columns_;
  ForeignCurve curve_;

  std::string at(int line) const { return where_ + ":" + std::to_string(line); }

  /// "Axial strain (%)" -> name "axial_strain", unit "%".
  static std::pair<std::string, std::string> split(const std::string& head) {
    const std::size_t open = head.find_first_of("[(");
    std::string name = head.substr(0, open), unit;
    if (open != head.npos) unit = head.substr(open + 1, head.find_first_of("])", open) - open - 1);
    while (name.ends_with(' ') || name.ends_with('_')) name.pop_back();
    for (char& c : name) c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return {name, unit};
  }

  void find_columns() {
    for (const Role& role : roles()) {
      const bool needed = role.value != &HistoryRow::n_cracks;
      std::size_t cell = table_.header.size();
      for (const char* name : role.names)
        for (std::size_t i = 0; cell == table_.header.size() && i < table_.header.size(); ++i)
          if (split(table_.header[i]).first == name) cell = i;
      if (cell == table_.header.size()) {
        if (needed)
          problems_.push_back(
              {at(table_.header_line), role.names.front(), "",
               fmt::format("a column of this name with its unit, {}", role.units),
               fmt::format("its columns are {}; name the one that it is", fmt::join(table_.header, ", "))});
        continue;
      }
      const std::string unit = split(table_.header[cell]).second;
      if (const auto factor = role.factor(unit))
        columns_.push_back({&role, cell, *factor});
      else
        problems_.push_back({at(table_.header_line), table_.header[cell], unit,
                             fmt::format("a unit behind the name, {}", role.units),
                             "write it into the header"});
    }
  }

  void read_rows() {
    for (const TableRow& row : table_.rows) {
      HistoryRow r;
      r.n_cracks = nan;  // where no column counts them
      for (const CurveColumn& c : columns_) {
        const std::string& cell = row.cells[c.cell];
        double value = 0.0;
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
          if (problems_.size() < most_reported)
            problems_.push_back(
                {at(row.line), table_.header[c.cell], cell, "a number", "leave rows without a reading out"});
          continue;
        }
        r.*(c.role->value) = c.factor * value;
      }
      curve_.history.rows.push_back(r);
    }
    if (problems_.empty() && curve_.history.rows.size() < least_rows)
      problems_.push_back({where_, "", fmt::format("{} rows", curve_.history.rows.size()),
                           fmt::format("at least {} rows", least_rows), "write the curve more often"});
  }

  /// Compression counts positive here.
  void turn() {
    auto& rows = curve_.history.rows;
    const HistoryRow& top =
        *std::max_element(rows.begin(), rows.end(), [](const HistoryRow& a, const HistoryRow& b) {
          return std::abs(a.axial_stress) < std::abs(b.axial_stress);
        });
    const bool stress = top.axial_stress < 0.0, strain = top.axial_strain < 0.0;
    for (HistoryRow& r : rows) {
      if (stress) r.axial_stress = -r.axial_stress;
      if (strain) r.axial_strain = -r.axial_strain;
    }
    if (stress || strain)
      curve_.notes.push_back(fmt::format("compression is negative there: the sign of {} was turned",
                                         stress && strain ? "strain and stress"
                                         : stress         ? "the stress"
                                                          : "the strain"));
  }
};

}  // namespace

ForeignCurve parse_curve(std::string_view text, const std::string& where) {
  return CurveReader(text, where).read();
}

ForeignCurve read_curve(const std::string& path) { return parse_curve(read_file(path), path); }

}  // namespace phy::io
