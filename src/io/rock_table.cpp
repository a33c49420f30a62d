#include "io/rock_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <vector>

#include "base/nan.hpp"
#include "base/trimmed.hpp"
#include "base/units.hpp"
#include "io/rock_columns.hpp"
#include "io/table.hpp"
#include "io/workbook.hpp"
#include "theory/jaeger.hpp"

namespace phy::io {
namespace {

constexpr double most_apart = 5.0;  // standard deviations between two rows of one cell
constexpr int least_with_sd = 2;    // specimens
constexpr int least_of_envelope = 3;
constexpr double least_over_sides = 1.1;  // sigma_1 over sigma_3; a friction angle of 3 degrees has as much

/// What can be computed with at all. Values that are merely doubtful are a matter of
/// records/rock_warnings.hpp.
struct Range {
  double low, high;
  const char* text;
};
Range range_of(const Head& h) {
  switch (h.kind) {
    case Column::theta:
    case Column::beta: return {0.0, 90.0, "0 deg <= angle <= 90 deg"};
    case Column::n: return {1.0, 1e6, "a whole number of specimens, at least 1"};
    case Column::diameter: return {1e-3, 10.0, "1 mm <= diameter of the disc <= 10 m"};
    case Column::confining:
    case Column::least_confining:
    case Column::most_confining: return {0.0, 5e9, "0 Pa <= confining pressure <= 5 GPa"};
    case Column::cohesion: return {0.0, 5e9, "0 Pa <= cohesion <= 5 GPa"};
    case Column::friction: return {0.0, 80.0, "0 deg <= angle of friction <= 80 deg"};
    case Column::scatter:
      return h.property == Property::nu ? Range{0.0, 1.0, "0 <= SD of nu <= 1"}
                                        : Range{0.0, 1e12, "a standard deviation >= 0"};
    default: break;
  }
  if (h.property == Property::E) return {1e6, 1e12, "1 MPa <= E <= 1000 GPa"};
  // Apparent nu of anisotropic rock may be negative or above 0.5.
  if (h.property == Property::nu) return {-0.5, 1.5, "-0.5 <= apparent nu <= 1.5"};
  if (h.property == Property::fracture_toughness)
    return {1e3, 1e8, "1 kPa sqrt(m) <= K_Ic <= 100 MPa sqrt(m)"};
  return {1e3, 5e9, "1 kPa <= strength <= 5 GPa"};
}

/// Reads the cells of a table.
class ReadingReader {
 public:
  ReadingReader(Table& table, const TableKeys& keys, std::vector<Problem>& problems,
                std::vector<std::string>& notes)
      : table_(table), where_(table.where), keys_(keys), problems_(problems), notes_(notes) {}

  Readings read() {
    name_heads();
    take_row_of_units();
    check_heads();
    for (const TableRow& row : table_.rows) read_row(row, keys_.confining);
    check_repeats();
    check_confined();
    check_initiation();
    const bool moduli = std::any_of(readings_.begin(), readings_.end(),
                                    [](const RockReading& r) { return !is_strength(r.property); });
    if (!elsewhere_.empty() && !moduli) {
      std::vector<std::string> others;
      for (const double p : elsewhere_) others.push_back(fmt::format("{:g}", p * 1e-6));
      problems_.push_back({where_, "confining", fmt::format("{:g} MPa", keys_.confining * 1e-6),
                           "E and nu at that pressure",
                           fmt::format("the table has them at {} MPa", fmt::join(others, ", "))});
    }
    if (n_merged_ > 0)
      notes_.push_back(
          fmt::format("{} cell(s) merged with the row above count once, in the first row", n_merged_));
    if (n_envelopes_ > 0)
      notes_.push_back(
          fmt::format("c and phi of {} row(s) are read as two strengths each, inside confining_min to "
                      "confining_max, whose "
                      "errors do not depend on each other (docs/calibration.md)",
                      n_envelopes_));
    if (n_assumed_ > 0)
      notes_.push_back(
          fmt::format("{} of {} values have an SD but no number of specimens (column n), or 1: they count as "
                      "means of {}, "
                      "the fewest that have one",
                      n_assumed_, readings_.size(), least_with_sd));
    Readings made{std::move(readings_), find(Column::theta) || find(Column::beta), {}, {}};
    if (const auto E = find(Column::value, Property::E))
      made.E_is = heads_[*E].E_is, made.E_title = heads_[*E].title;
    return made;
  }

 private:
  Table& table_;
  const std::string& where_;
  const TableKeys& keys_;
  std::vector<Problem>& problems_;
  std::vector<std::string>& notes_;
  std::vector<Head> heads_;
  std::vector<RockReading> readings_;
  int n_merged_ = 0;            // cells that are one with that above
  int n_assumed_ = 0;           // values with an SD of an unknown number of specimens
  int n_envelopes_ = 0;         // rows with c and phi
  std::set<double> elsewhere_;  // pressures of E and nu, others than the one asked for [Pa]

  std::string at(int line) const { return where_ + ":" + std::to_string(line); }
  std::optional<std::size_t> find(Column kind, Property p = Property::E) const {
    // Kinds other than values and scatter occur once, whatever their property.
    for (std::size_t i = 0; i < heads_.size(); ++i)
      if (heads_[i].kind == kind &&
          (heads_[i].property == p || (kind != Column::value && kind != Column::scatter)))
        return i;
    return std::nullopt;
  }
  void report_problem(const std::string& key, const std::string& value, const std::string& expected,
                      const std::string& remedy) {
    problems_.push_back({at(table_.header_line), key, value, expected, remedy});
  }

  /// What the user says of a header: the header, whole or without its unit where no other has that title, and
  /// our name.
  const std::pair<const std::string, std::string>* said_of(const std::string& cell) const {
    if (const auto whole = keys_.columns.find(cell); whole != keys_.columns.end()) return &*whole;
    const std::string title = title_of(cell);
    const auto alike = std::count_if(table_.header.begin(), table_.header.end(),
                                     [&](const std::string& other) { return title_of(other) == title; });
    for (const auto& said : keys_.columns)
      if (alike == 1 && title_of(said.first) == title) return &said;
    return nullptr;
  }

  void name_heads() {
    std::set<std::string> said, used;  // names of ours; headers
    for (const std::string& cell : table_.header) {
      const auto* meant = said_of(cell);
      heads_.push_back(head_of(cell, meant != nullptr ? meant->second : ""));
      if (meant == nullptr) continue;
      used.insert(meant->first), said.insert(heads_.back().name);
      if (heads_.back().unit.empty()) heads_.back().unit = head_of(meant->first).unit;
    }
    // The user's word goes before what a header seems to say.
    for (std::size_t i = 0; i < heads_.size(); ++i)
      if (said_of(table_.header[i]) == nullptr && heads_[i].kind != Column::other &&
          said.contains(heads_[i].name))
        heads_[i].kind = Column::passed;
    for (const auto& [header, name] : keys_.columns)
      if (!used.contains(header))
        report_problem("[columns]", header, "a header of this table",
                       fmt::format("it has: {}", fmt::join(table_.header, ", ")));
  }

  /// Units in a row of their own, below headers that have none: in each column that is read a unit or
  /// nothing, and somewhere a unit.
  void take_row_of_units() {
    if (table_.rows.empty()) return;
    const std::vector<std::string>& cells = table_.rows.front().cells;
    bool any = false;
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      if (heads_[i].kind == Column::passed || heads_[i].kind == Column::other) continue;
      const std::string& cell = cells[i];
      const bool unit = !unit_of_cell(cell).empty();
      any = any || unit;
      if (!unit && !cell.empty() && cell != "-" && cell != "[-]" && cell != "(-)" && cell != "%") return;
    }
    if (!any) return;
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      const std::string known = unit_of_cell(cells[i]), unit = known.empty() && cells[i] == "%" ? "%" : known;
      std::string& of_head = heads_[i].unit;
      if (!unit.empty() && !of_head.empty() && unit != of_head)
        report_problem(table_.header[i], cells[i], "one unit",
                       "the row below the header has another: correct one");
      if (of_head.empty()) of_head = unit;
    }
    table_.rows.erase(table_.rows.begin());
    notes_.push_back(where_ + ": units stand in a row of their own");
  }

  void check_heads() {
    std::vector<std::string> passed, named;
    std::map<std::string, std::size_t> seen;
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      const Head& h = heads_[i];
      const std::string& cell = table_.header[i];
      if (h.kind == Column::passed) {
        passed.push_back(cell);
      } else if (h.kind == Column::other) {
        check_other(i, passed);
      } else if (const auto [it, fresh] = seen.emplace(h.name, i); !fresh) {
        check_second(i, it->second);
      } else {
        check_unit(i);
        if (!h.own) named.push_back(fmt::format("{} is {}", cell, h.name));
      }
    }
    if (find(Column::theta) && find(Column::beta))
      report_problem("beta", "", "one convention of angles", "keep theta or beta, not both");
    if (seen.contains("sigma_1") && seen.contains("deviator"))
      report_problem("deviator", "", "sigma_1 or the deviator stress",
                     "pass one of the two over in the rock file: [columns] \"" +
                         heads_[seen.at("deviator")].title + "\" = \"-\"");
    for (std::size_t i = 0; i < heads_.size(); ++i)
      if (heads_[i].kind == Column::scatter && !find(Column::value, heads_[i].property))
        report_problem(table_.header[i], "", "a column of the values themselves", "");
    const bool any = std::any_of(heads_.begin(), heads_.end(), [](const Head& h) {
      return h.kind == Column::value || h.kind == Column::cohesion;
    });
    if (!any)
      report_problem(
          "header", fmt::format("{}", fmt::join(table_.header, ", ")),
          "at least one of the columns E, nu, UCS, DTS, BTS, sigma_1, c",
          "is this the line of the headers? Take away what stands above it; the rock file can say which "
          "is which: [columns] \"peak stress\" = \"UCS\"");
    check_envelope_columns();
    // Both conventions are in use, so the conversion is mentioned.
    if (find(Column::beta))
      notes_.emplace_back("angles are beta, between load and bedding; theta = 90 deg - beta");
    if (!named.empty())
      notes_.push_back(fmt::format("columns by other names: {} ([columns] in the rock file changes that)",
                                   fmt::join(named, ", ")));
    if (!passed.empty()) notes_.push_back(fmt::format("columns passed over: {}", fmt::join(passed, ", ")));
  }

  /// Numbers that may be meant for the model are not dropped in silence: those of a column that has no name,
  /// or a name that is not understood with the unit of a stress or an angle.
  void check_other(std::size_t i, std::vector<std::string>& passed) {
    const std::string& cell = table_.header[i];
    if (cell.empty()) {
      for (const TableRow& row : table_.rows)
        if (!row.cells[i].empty()) {
          report_problem(fmt::format("column {}", i + 1), "", "a header",
                         fmt::format("line {} has a value there", row.line));
          return;
        }
      return;
    }
    const std::string one = "1 " + heads_[i].unit;
    const bool angle = parse_quantity(one, Dimension::angle).ok;
    if (heads_[i].speaks_of_angles && (angle || (heads_[i].unit.empty() && holds_numbers(i)))) {
      report_problem(
          cell, "", "an angle that says from where it counts",
          fmt::format("name it theta (from the horizontal, load upright) or beta (from the load), with its "
                      "unit, or write it in the rock file: [columns] \"{} [deg]\" = \"beta\"; \"-\" passes "
                      "it over",
                      heads_[i].title));
    } else if (angle || parse_quantity(one, Dimension::pressure).ok ||
               (heads_[i].speaks_of_toughness && holds_numbers(i))) {
      report_problem(
          cell, "", fmt::format("a known column: {}", fmt::join(column_names(), ", ")),
          fmt::format("say in the rock file what it is: [columns] \"{}\" = one of these, or \"-\" to pass it "
                      "over",
                      heads_[i].title));
    } else {
      passed.push_back(cell);
    }
  }
  bool holds_numbers(std::size_t column) const {
    bool any = false;
    for (const TableRow& row : table_.rows) {
      const std::string& cell = row.cells[column];
      double value = 0.0;
      const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (!cell.empty() && (error != std::errc() || end != cell.data() + cell.size())) return false;
      any = any || !cell.empty();
    }
    return any;
  }
  void check_second(std::size_t i, std::size_t first) {
    const Head &a = heads_[first], &b = heads_[i];
    const std::string remedy = a.title != b.title ? fmt::format(
                                                        "{} is read as that too: the rock file chooses, "
                                                        "[columns] \"{}\" = \"{}\" and \"{}\" = \"-\"",
                                                        table_.header[first], b.title, b.name, a.title)
                               : a.unit != b.unit ? "its units are mixed: " + a.unit + " and " + b.unit
                                                  : "two headers are the same: rename one";
    report_problem(table_.header[i], "", "one column of " + b.name, remedy);
  }
  void check_unit(std::size_t i) {
    const Head& h = heads_[i];
    const Dimension d = dimension_of(h);
    const bool bare = h.unit.empty() || h.unit == "-" || h.unit == "1";
    if (d == Dimension::none ? bare : parse_quantity("1 " + h.unit, d).ok) return;
    const std::size_t bracket = h.title.find('[');
    const std::string title(trimmed(std::string_view(h.title).substr(0, bracket), " "));
    const std::string otherwise =
        fmt::format("; if it is something else: [columns] \"{}\" = \"-\" in the rock file", h.title);
    if (d == Dimension::none)
      report_problem(table_.header[i], h.unit, fmt::format("{} without a unit", h.name),
                     "write it as a bare number" + otherwise);
    else
      report_problem(table_.header[i], h.unit,
                     fmt::format("a unit of {} in the header: {}", h.name, unit_names(d)),
                     "write for example " + (d == Dimension::toughness ? h.name : title) +
                         (d == Dimension::angle                                  ? " [deg]"
                          : d == Dimension::toughness                            ? " [MPa sqrt(m)]"
                          : h.property == Property::E && h.kind == Column::value ? " [GPa]"
                                                                                 : " [MPa]") +
                         (bare && bracket == h.title.npos ? "" : " and convert the values") + otherwise);
  }

  std::ptrdiff_t n_envelope_columns() const {
    const Column all[] = {Column::cohesion, Column::friction, Column::least_confining,
                          Column::most_confining};
    return std::count_if(std::begin(all), std::end(all), [&](Column c) { return find(c).has_value(); });
  }
  /// A line over confining stress needs both of its numbers, and where it was measured.
  void check_envelope_columns() {
    if (const std::ptrdiff_t n = n_envelope_columns(); n != 0 && n != 4)
      report_problem("c, phi", "", "the columns c, phi, confining_min and confining_max together",
                     "an envelope is read as strengths, and only inside the pressures that were tested");
  }

  /// One cell in SI units; NaN if it is empty. False: a problem has been reported.
  bool number(const TableRow& row, std::size_t column, double& value) {
    const Head& h = heads_[column];
    const std::string& cell = row.cells[column];
    value = nan;
    if (cell.empty() || cell == "-") return true;
    if (row.merged.contains(column) && h.kind != Column::theta && h.kind != Column::beta &&
        h.kind != Column::confining) {
      ++n_merged_;  // one value over several rows is one specimen's
      return true;
    }
    const Range range = range_of(h);
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
      const bool read = error == std::errc();
      problems_.push_back({at(row.line), h.shown(), cell,
                           "a bare number" + (h.unit.empty() ? "" : " in " + h.unit), remedy_of(cell, read)});
      return false;
    }
    if (const Dimension d = dimension_of(h); d != Dimension::none) {
      const Quantity q = parse_quantity(cell + " " + h.unit, d);
      if (!q.ok) return false;  // the unit of the header has been reported
      value = q.value;
    }
    const bool whole = h.kind != Column::n || value == std::floor(value);
    if (value >= range.low && value <= range.high && whole) return true;
    const bool angle = h.kind == Column::theta || h.kind == Column::beta;
    const bool strength = h.kind == Column::value && is_strength(h.property);
    problems_.push_back({at(row.line), h.shown(), cell + (h.unit.empty() ? "" : " " + h.unit), range.text,
                         angle ? "fold the angle: bedding at 120 deg is the mirror image of 60 deg"
                         : strength && value < 0.0       ? "strengths are positive, those in tension too"
                         : h.unit.empty() || value < 0.0 ? ""
                                                         : "check the unit in the header"});
    return false;
  }

  /// What to do about a cell that is no number; `begins`: with one it begins.
  static std::string remedy_of(const std::string& cell, bool begins) {
    if (cell == formula_without_value)
      return "its value was not saved: open the workbook in the spreadsheet and save it";
    if (begins && std::isalpha(static_cast<unsigned char>(cell.back())) != 0)  // "45 GPa"
      return "units stand in the header only: mixed units are not read";
    const bool day = cell.size() == 10 && cell[4] == '-' && cell[7] == '-';
    return day ? "a day or an hour: did the spreadsheet take 1.5 for the first of May? Type it again in a "
                 "cell that has "
                 "the format of a number"
               : "write digits and a point alone, no sign, limit, +- or blanks between digits; leave the "
                 "cell empty "
                 "only where nothing was measured";
  }

  /// A row that holds nothing of what is read: blank, or a remark.
  bool is_empty(const TableRow& row) const {
    for (std::size_t i = 0; i < heads_.size(); ++i)
      if (heads_[i].kind != Column::other && heads_[i].kind != Column::passed && !row.cells[i].empty() &&
          !row.merged.contains(i))
        return false;
    return true;
  }

  void read_row(const TableRow& row, double confining) {
    if (is_empty(row)) return;
    if (const auto word = std::find_if(row.cells.begin(), row.cells.end(), is_summary);
        word != row.cells.end()) {
      problems_.push_back(
          {at(row.line), "", *word, "a row of specimens",
           "take it out: specimens and their mean would count twice; of means alone give SD in a "
           "column ..._sd and their number in n"});
      return;
    }
    std::vector<double> v(heads_.size(), nan);
    bool good = true;
    for (std::size_t i = 0; i < heads_.size(); ++i)
      if (heads_[i].kind != Column::other && heads_[i].kind != Column::passed)
        good = number(row, i, v[i]) && good;
    RockReading r;
    r.line = row.line;
    const auto theta = find(Column::theta), beta = find(Column::beta), n = find(Column::n);
    if (theta || beta) {
      const double angle = v[theta ? *theta : *beta];
      if (good && !std::isfinite(angle))
        problems_.push_back({at(row.line), theta ? "theta" : "beta", "", "an angle in every row", ""}),
            good = false;
      r.theta = theta ? angle : 90.0 - angle;
    }
    // After all cells are read, so that every bad cell of the row is reported.
    if (!good) return;
    if (const auto c = find(Column::confining); c && std::isfinite(v[*c])) r.confining = v[*c];
    // E and nu under another confining pressure than the one asked for are left out; NaN asks for none.
    const bool asked = !std::isfinite(confining) || same_stress(r.confining, confining);
    if (n && std::isfinite(v[*n])) r.n = static_cast<int>(v[*n]);
    if (const auto d = find(Column::diameter); d && std::isfinite(v[*d])) r.diameter = v[*d];
    for (std::size_t i = 0; i < heads_.size(); ++i) {
      if (heads_[i].kind != Column::value || !std::isfinite(v[i])) continue;
      r.property = heads_[i].property, r.value = v[i] + (heads_[i].deviatoric ? r.confining : 0.0);
      if (!asked && !is_strength(r.property)) {
        elsewhere_.insert(r.confining);
        continue;
      }
      if (is_compressive(r.property)) {
        const auto other =
            find(Column::value, r.property == Property::ucs ? Property::confined : Property::ucs);
        if (r.property == Property::confined && other && std::isfinite(v[*other]))
          problems_.push_back({at(row.line), "sigma_1", "", "UCS or sigma_1 in a row, not both",
                               "they are the same number under `confining`: a row of its own for each test"});
        r.property = r.confining > 0.0 ? Property::confined : Property::ucs;
      }
      const auto sd = find(Column::scatter, heads_[i].property);
      // A scatter of zero is no measurement of scatter.
      r.sd = sd && v[*sd] > 0.0 ? v[*sd] : nan;
      readings_.push_back(r);
      if (std::isfinite(r.sd) && r.n < least_with_sd) readings_.back().n = least_with_sd, ++n_assumed_;
    }
    read_envelope(r, v);
  }

  /// c and phi become two strengths. The line is one through `n` tests evenly spread over the pressures: at
  /// their mean plus and minus their standard deviation its errors do not depend on each other, and each is
  /// that of half of the tests.
  void read_envelope(RockReading r, const std::vector<double>& v) {
    const auto value = [&](Column c) { return find(c) ? v[*find(c)] : nan; };
    const double c = value(Column::cohesion), phi = value(Column::friction);
    const double from = value(Column::least_confining), to = value(Column::most_confining);
    const double all[] = {c, phi, from, to};
    const auto given =
        std::count_if(std::begin(all), std::end(all), [](double x) { return std::isfinite(x); });
    if (given == 0 || n_envelope_columns() < 4) return;  // columns that are missing were told once
    if (given < 4 || !(from < to)) {
      problems_.push_back({at(r.line), "c, phi", "",
                           "c, phi, and confining_min below confining_max in the same row",
                           "leave all four empty where no envelope was measured"});
      return;
    }
    const int n = std::max(least_of_envelope, r.n);
    const double spread = (to - from) * std::sqrt((n + 1.0) / (12.0 * (n - 1.0)));
    for (const double sigma_3 : {0.5 * (from + to) - spread, 0.5 * (from + to) + spread}) {
      r.property = Property::confined, r.confining = sigma_3, r.sd = nan, r.n = n / 2, r.derived = true;
      r.value = theory::coulomb_sigma_1({c, phi}, sigma_3);
      readings_.push_back(r);
    }
    ++n_envelopes_;
  }

  /// Nothing has been told of the rock where the peak is hardly above the confining stress.
  void check_confined() {
    for (const RockReading& r : readings_)
      if (r.property == Property::confined && !(r.value > least_over_sides * r.confining))
        problems_.push_back(
            {at(r.line), r.derived ? "c, phi" : "sigma_1", fmt::format("{:.4g} MPa", r.value * 1e-6),
             fmt::format("an axial stress at the peak above {:g} times the confining stress, {:.4g} MPa",
                         least_over_sides, r.confining * 1e-6),
             r.derived ? "" : "is it the deviatoric stress? add the confining stress to it"});
  }

  /// Where cracks begin is read in the test of UCS, and before its peak.
  void check_initiation() {
    struct Cell {
      double sum = 0.0, n = 0.0;
      int line = 0;  // the first
      double mean() const { return sum / n; }
    };
    std::map<double, Cell> ucs, initiation;  // by angle
    for (const RockReading& r : readings_) {
      if (r.confining > 0.0 || (r.property != Property::ucs && r.property != Property::crack_initiation))
        continue;
      Cell& cell = (r.property == Property::ucs ? ucs : initiation)[r.theta];
      if (cell.line == 0) cell.line = r.line;
      cell.sum += r.n * r.value, cell.n += r.n;
    }
    for (const auto& [theta, cell] : initiation) {
      const std::string value = fmt::format("{:.4g} MPa", cell.mean() * 1e-6);
      if (!ucs.contains(theta))
        problems_.push_back(
            {at(cell.line), "sigma_ci", value, "UCS at the same angle, in this row or another",
             "here sigma_ci is where cracks begin, and counts against UCS: leave it out; what Hoek and "
             "Brown call so is UCS"});
      else if (cell.mean() >= ucs[theta].mean())
        problems_.push_back(
            {at(cell.line), "sigma_ci", value,
             fmt::format("a mean below that of UCS at this angle, {:.4g} MPa", ucs[theta].mean() * 1e-6),
             "cracks begin before the peak: are two columns swapped?"});
    }
  }

  /// Adds a reading to those that later ones of its cell are held against: all with an SD, and of the others,
  /// which only another's SD can tell apart, the least and the largest.
  void remember(std::size_t i, std::vector<std::size_t>& cell) const {
    const auto farther = [&](std::size_t j, double side) {
      return !std::isfinite(readings_[j].sd) && side * readings_[j].value >= side * readings_[i].value;
    };
    const auto any_farther = [&](double side) {
      return std::any_of(cell.begin(), cell.end(), [&](std::size_t j) { return farther(j, side); });
    };
    if (std::isfinite(readings_[i].sd) || !any_farther(1.0) || !any_farther(-1.0)) cell.push_back(i);
  }

  /// Two rows of one cell that cannot be the same rock.
  void check_repeats() {
    // Each line once, though it may disagree with several others.
    std::set<int> told;
    std::map<std::tuple<Property, double, double, double>, std::vector<std::size_t>> cells;
    for (std::size_t i = 0; i < readings_.size(); ++i) {
      const RockReading& b = readings_[i];
      std::vector<std::size_t>& cell = cells[{b.property, b.theta, b.confining, b.diameter}];
      for (const std::size_t j : cell) {
        const RockReading& a = readings_[j];
        // With one of the two unknown the other decides; with both unknown nothing is reported (comparison
        // with NaN).
        const double sd = std::fmax(a.sd, b.sd);  // passes over a NaN
        if (!(std::fabs(a.value - b.value) > most_apart * sd) || !told.insert(b.line).second) continue;
        problems_.push_back({at(b.line), to_string(b.property), fmt::format("{:g}", b.value),
                             fmt::format("within {:g} SD ({:g}) of line {} ({:g}), SI units", most_apart, sd,
                                         a.line, a.value),
                             "one of the two is a slip, or the rows are two different rocks"});
      }
      remember(i, cell);
    }
  }
};

}  // namespace

Readings parse_readings(std::string_view bytes, const std::string& where, const TableKeys& keys,
                        std::vector<Problem>& problems, std::vector<std::string>& notes) {
  Table table = parse_table(bytes, where, keys.sheet);
  for (Problem& p : table.problems) problems.push_back(std::move(p));
  for (std::string& note : table.notes) notes.push_back(fmt::format("{}: {}", table.where, note));
  if (table.header_line == 0) return {};
  return ReadingReader(table, keys, problems, notes).read();
}

}  // namespace phy::io
