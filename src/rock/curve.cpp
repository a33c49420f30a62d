#include "rock/curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/nan.hpp"
#include "base/trimmed.hpp"
#include "base/units.hpp"
#include "io/file.hpp"
#include "io/repeated.hpp"
#include "io/table.hpp"
#include "io/table_cells.hpp"

namespace phy::rock {
namespace {

constexpr std::size_t least_rows = 5;
constexpr std::size_t most_listed = 12;  // columns in a message
// Strains and stresses that the load does not act along: they must not be offered in place of the axial ones.
constexpr std::array across = {"lateral", "radial",     "transvers", "circumferential",
                               "hoop",    "volumetric", "shear"};

/// What a column may be. `others`: words of columns that it can be computed from, with how.
struct Role {
  std::vector<const char*> names;  ///< in lower case, the first that is there counts; "_" does not
  Dimension dimension;
  const char* units;
  double HistoryRow::*value;
  std::vector<const char*> others;
  const char* how;
};

const std::vector<Role>& roles() {
  static const std::vector<Role> list = {
      // The most certain name first: beside "axial_strain" a "strain" may be any other.
      {{"axial_strain", "strain", "epsilon", "ε", "epsilon_1", "ε_1", "ε₁"},
       Dimension::strain,
       "[1], [%] or [microstrain]",
       &HistoryRow::axial_strain,
       {"displacement", "deformation", "extension", "shortening", "elongation", "stroke", "lvdt"},
       "axial_strain [1] is the shortening over the height of the specimen (over its gauge length)"},
      {{"axial_stress", "stress", "sigma", "σ", "sigma_1", "σ_1", "σ₁"},
       Dimension::pressure,
       "[Pa], [kPa], [MPa] or [GPa]",
       &HistoryRow::axial_stress,
       {"load", "force"},
       "axial_stress [MPa] is the load in N over the cross-section of the specimen in mm2"},
      // Beside cumulative counts a column "counts" holds those of each row.
      {{"n_cracks", "cracks", "cumulative_counts", "counts", "hits", "events"},
       Dimension::none,
       "[1]",
       &HistoryRow::n_cracks,
       {},
       ""}};
  return list;
}

/// One of a unit in SI; nothing: it is none of this dimension.
std::optional<double> factor_of(const std::string& unit, Dimension dimension) {
  if (dimension == Dimension::none)
    return unit.empty() || unit == "1" || unit == "-" ? std::optional(1.0) : std::nullopt;
  const Quantity q = parse_quantity("1 " + unit, dimension);
  return !unit.empty() && q.ok ? std::optional(q.value) : std::nullopt;
}

struct CurveColumn {
  const Role* role;
  std::size_t cell;
  double factor;
};

/// The 1 of "Axial strain 1", which is no unit there.
bool is_number_of_column(const std::string& tail) { return tail == "1" || tail == "-"; }

/// A header in parts: "Axial strain (%)", "Axial strain, %" are "axial_strain" in "%".
struct CurveHead {
  std::string name, unit;
};
CurveHead curve_head(const std::string& head) {
  CurveHead made;
  std::size_t end = head.find_first_of("[(");
  // A header that begins with a bracket would have no name left.
  if (end == 0) end = head.npos;
  const std::size_t close = head.find_last_of("])"), tail = head.find_last_of(" ,");
  if (end != head.npos) {
    made.unit =
        trimmed(head.substr(end + 1, close == head.npos || close < end ? head.npos : close - end - 1));
  } else if (tail != head.npos && !is_number_of_column(head.substr(tail + 1)) &&
             find_unit(head.substr(tail + 1))) {
    made.unit = head.substr(tail + 1), end = tail;
  }
  made.name = trimmed(std::string_view(head).substr(0, end), " ,_");
  for (char& c : made.name)
    c = c == ' ' || c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return made;
}

class CurveReader {
 public:
  CurveReader(std::string_view text, std::string where)
      : where_(std::move(where)), table_(io::parse_table(text, where_)), problems_(table_.problems) {
    where_ = table_.where;
    for (const std::string& head : table_.header) heads_.push_back(curve_head(head));
  }

  ForeignCurve read() {
    curve_.notes = table_.notes;
    if (problems_.empty()) take_row_of_units();
    if (problems_.empty()) find_columns();
    if (problems_.empty()) read_rows();
    if (!problems_.empty()) throw InputError(problems_);
    turn();
    return std::move(curve_);
  }

 private:
  std::string where_;
  io::Table table_;
  std::vector<Problem> problems_;
  std::vector<CurveHead> heads_;
  std::vector<CurveColumn> columns_;
  ForeignCurve curve_;
  bool listed_ = false;  // what columns there are

  std::string at(int line) const { return where_ + ":" + std::to_string(line); }

  /// Units in a row of their own: some units, and nothing that could be measured.
  void take_row_of_units() {
    if (table_.rows.empty()) return;
    const io::TableRow row = table_.rows.front();
    // 1 is a number and the unit of ratios: alone it decides nothing.
    const auto is_value = [](const std::string& cell) { return cell != "1" && io::looks_measured(cell); };
    const auto is_unit = [](const std::string& cell) {
      return !io::looks_measured(cell) && find_unit(bare(cell));
    };
    if (std::any_of(row.cells.begin(), row.cells.end(), is_value) ||
        std::none_of(row.cells.begin(), row.cells.end(), is_unit))
      return;
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      std::string& unit = heads_[i].unit;
      if (!unit.empty() && !row.cells[i].empty() && unit != bare(row.cells[i]))
        problems_.push_back({at(row.line), table_.header[i], row.cells[i], "one unit",
                             "the header has another: correct one"});
      if (unit.empty()) unit = bare(row.cells[i]);
    }
    table_.rows.erase(table_.rows.begin());
    curve_.notes.emplace_back("units stand in a row of their own");
  }
  static std::string bare(const std::string& cell) { return std::string(trimmed(cell, "[]() ")); }

  void find_columns() {
    for (const Role& role : roles()) {
      std::size_t cell = heads_.size();
      for (const char* name : role.names)
        for (std::size_t i = 0; cell == heads_.size() && i < heads_.size(); ++i)
          if (without_joints(heads_[i].name) == without_joints(name)) cell = i;
      if (cell == heads_.size()) {
        // Few laboratories count: a curve without counts is read all the same.
        if (role.dimension != Dimension::none) tell_missing(role);
      } else if (const auto factor = factor_of(heads_[cell].unit, role.dimension)) {
        columns_.push_back({&role, cell, *factor});
      } else {
        problems_.push_back({at(table_.header_line), table_.header[cell], heads_[cell].unit,
                             fmt::format("a unit behind the name, {}", role.units),
                             "write it into the header"});
      }
    }
  }
  static std::string without_joints(std::string name) {
    std::erase(name, '_');
    return name;
  }
  /// Columns along the load with one of these words in their names.
  template <class Words>
  std::vector<std::string> columns_with(const Words& words) const {
    std::vector<std::string> found;
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      const auto in_name = [&](const char* word) { return heads_[i].name.find(word) != std::string::npos; };
      if (std::any_of(words.begin(), words.end(), in_name) &&
          std::none_of(across.begin(), across.end(), in_name))
        found.push_back(shown(i));
    }
    return found;
  }
  /// What there is instead: columns with a word of its name, columns that it follows from.
  void tell_missing(const Role& role) {
    const std::vector<std::string> others = columns_with(role.others),
                                   alike = columns_with(std::array{role.names[1]});
    std::string remedy = "rename the one that it is";
    if (!alike.empty())
      remedy = fmt::format("rename the one that it is: {}{}", fmt::join(alike, ", "),
                           alike.size() > 1 ? "; or add a column of their mean" : "");
    else if (!others.empty())
      remedy = fmt::format("compute it from {}: {}", fmt::join(others, ", "), role.how);
    problems_.push_back({at(table_.header_line), role.names.front(), "",
                         fmt::format("a column of this name with its unit, {}", role.units),
                         (listed_ ? "" : "its columns are " + columns() + "; ") + remedy});
    listed_ = true;
  }
  std::string shown(std::size_t i) const {
    const std::string &head = table_.header[i], &unit = heads_[i].unit;
    return unit.empty() || head.find(unit) != head.npos ? head : fmt::format("{} [{}]", head, unit);
  }
  std::string columns() const {
    std::vector<std::string> some;
    for (std::size_t i = 0; i < std::min(most_listed, heads_.size()); ++i) some.push_back(shown(i));
    return fmt::format("{}", fmt::join(some, ", ")) +
           (heads_.size() > most_listed ? fmt::format(" and {} more", heads_.size() - most_listed) : "");
  }

  void read_rows() {
    // One message per column: ten thousand cells of text are one mistake.
    std::vector<io::RepeatedProblem> bad(columns_.size());
    io::RepeatedProblem falling;
    double counted = 0.0;
    for (const io::TableRow& row : table_.rows) {
      HistoryRow r;
      r.n_cracks = nan;  // where no column counts them
      for (std::size_t i = 0; i < columns_.size(); ++i) {
        const CurveColumn& c = columns_[i];
        const std::string& cell = row.cells[c.cell];
        double value = 0.0;
        const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
        // The whole cell, or "1,5" would be 1.
        if (error == std::errc() && end == cell.data() + cell.size() && std::isfinite(value))
          r.*(c.role->value) = c.factor * value;
        else
          bad[i].add(
              {at(row.line), table_.header[c.cell], cell, "a number", "leave rows without a reading out"});
      }
      // NaN, where no column counts, is not less.
      if (r.n_cracks < counted)
        falling.add({at(row.line), "counts", fmt::format("{:g}", r.n_cracks),
                     fmt::format("counts so far, at least {:g}", counted),
                     "sum up what each row counts, without negative numbers"});
      else if (std::isfinite(r.n_cracks))
        counted = r.n_cracks;
      curve_.history.rows.push_back(r);
    }
    for (const io::RepeatedProblem& p : bad) p.tell(problems_);
    falling.tell(problems_);
    if (problems_.empty() && curve_.history.rows.size() < least_rows)
      problems_.push_back({where_, "", fmt::format("{} rows", curve_.history.rows.size()),
                           fmt::format("at least {} rows", least_rows), "write the curve more often"});
  }

  /// Compression counts positive here.
  void turn() {
    auto& rows = curve_.history.rows;
    const HistoryRow& top =
        // At the largest stress both signs are certain; at the start noise and seating decide them.
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

std::vector<std::string> names_of_counts() {
  const std::vector<const char*>& names = roles().back().names;
  return {names.begin(), names.end()};
}

ForeignCurve parse_curve(std::string_view text, const std::string& where) {
  return CurveReader(text, where).read();
}

ForeignCurve read_curve(const std::string& path) { return parse_curve(io::read_file(path), path); }

}  // namespace phy::rock
