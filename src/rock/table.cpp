#include "rock/table.hpp"

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
#include "base/units.hpp"
#include "io/table.hpp"
#include "io/workbook.hpp"
#include "rock/directions.hpp"
#include "theory/jaeger.hpp"

namespace phy::rock {
namespace {

constexpr double most_apart = 5.0;  // standard deviations between two rows of one cell
constexpr int least_with_sd = 2;    // specimens
constexpr int least_of_envelope = 3;
constexpr double most_radians = 1.6;      // pi/2, rounded up
constexpr double least_over_sides = 1.1;  // sigma_1 over sigma_3; a friction angle of 3 degrees has as much

/// What can be computed with at all. Values that are merely doubtful are a matter of
/// survey/unusual.hpp.
using Range = PossibleValues;
Range range_of(const Head& h) {
  switch (h.kind) {
    case Column::theta:
    // A specimen at 120 degrees is the mirror image of one at 60; left unfolded they would be two cells.
    case Column::beta: return {0.0, 90.0, "0 deg <= angle <= 90 deg"};
    case Column::n: return {1.0, 1e6, "a whole number of specimens, at least 1"};
    case Column::diameter: return {1e-3, 10.0, "1 mm <= diameter of the disc <= 10 m"};
    case Column::confining:
    case Column::intermediate:
    case Column::least_confining:
    case Column::most_confining: return {0.0, 5e9, "0 Pa <= confining pressure <= 5 GPa"};
    case Column::normal: return {0.0, 5e9, "0 Pa <= normal stress <= 5 GPa"};
    case Column::cohesion: return {0.0, 5e9, "0 Pa <= cohesion <= 5 GPa"};
    case Column::friction: return {0.0, 80.0, "0 deg <= angle of friction <= 80 deg"};
    case Column::scatter:
      return measured(h.property).absolute ? Range{0.0, 1.0, "0 <= SD of nu <= 1"}
                                           : Range{0.0, 1e12, "a standard deviation >= 0"};
    default: return measured(h.property).possible;
  }
}

/// Reads the cells of a table.
class ReadingReader {
 public:
  ReadingReader(io::Table& table, const TableKeys& keys, std::vector<Problem>& problems,
                std::vector<std::string>& notes)
      : heads_(read_heads(table, keys, problems, notes)),
        table_(table),
        where_(table.where),
        keys_(keys),
        problems_(problems),
        notes_(notes) {
    for (const Head& h : heads_.all) {
      const auto unit = find_unit(h.unit);
      const Dimension d = dimension_of(h);
      const bool bare = h.unit.empty() || h.unit == "-" || h.unit == "1";
      // Told once with the header: a message for each cell below would bury it.
      has_unit_.push_back(d == Dimension::none ? bare : unit && unit->dimension == d);
    }
  }

  Readings read() {
    for (const io::TableRow& row : table_.rows) read_row(row, keys_.confining);
    check_angles();
    check_repeats();
    check_confined();
    check_initiation();
    check_sliding();
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
                      "means of {}",
                      n_assumed_, readings_.size(), least_with_sd));
    Readings made{std::move(readings_),
                  heads_.angles().has_value(),
                  heads_.find(Column::beta).has_value(),
                  heads_.asked_for_angles,
                  {},
                  {}};
    if (const auto E = find(Column::value, Property::E))
      made.E_is = heads_.all[*E].E_is, made.E_title = heads_.all[*E].title;
    return made;
  }

 private:
  const Heads heads_;  // before the rows: it may take a row of units out of the table
  const io::Table& table_;
  const std::string& where_;
  const TableKeys& keys_;
  std::vector<Problem>& problems_;
  std::vector<std::string>& notes_;
  std::vector<bool> has_unit_;  // of the columns; another was reported with the header
  std::vector<RockReading> readings_;
  int n_merged_ = 0;            // cells that are one with that above
  int n_assumed_ = 0;           // values with an SD of an unknown number of specimens
  int n_envelopes_ = 0;         // rows with c and phi
  std::set<double> elsewhere_;  // pressures of E and nu, others than the one asked for [Pa]

  std::string at(int line) const { return where_ + ":" + std::to_string(line); }
  std::optional<std::size_t> find(Column kind, Property p = Property::E) const {
    return heads_.find(kind, p);
  }
  bool is_read(std::size_t column) const {
    return heads_.all[column].kind != Column::other && heads_.all[column].kind != Column::passed;
  }

  bool has_envelope() const {
    return find(Column::cohesion) && find(Column::friction) && find(Column::least_confining) &&
           find(Column::most_confining);
  }

  /// One cell in SI units; NaN if it is empty. False: a problem has been reported.
  bool number(const io::TableRow& row, std::size_t column, double& value) {
    const Head& h = heads_.all[column];
    const bool angle = h.is_angle();
    value = nan;
    // Laboratories write a dash for what was not measured.
    if (row.cells[column].empty() || row.cells[column] == "-") return true;
    // An angle or a stress over several rows holds for each of them, a strength for one specimen.
    if (row.merged.contains(column) && !angle && h.kind != Column::confining) {
      ++n_merged_;  // one value over several rows is one specimen's
      return true;
    }
    if (angle)
      if (const auto theta = direction_in_words(row.cells[column], table_.header[column]))
        return value = h.theta_of(*theta), true;
    const std::string cell = angle && h.unit == "deg"
                                 ? without_degree_sign(row.cells[column]).value_or(row.cells[column])
                                 : row.cells[column];
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
      const bool read = error == std::errc();
      problems_.push_back({at(row.line), h.shown(), cell,
                           "a bare number" + (h.unit.empty() ? "" : " in " + h.unit), remedy_of(cell, read)});
      return false;
    }
    return has_unit_[column] && in_si(row.line, h, cell, value) && in_range(row.line, h, cell, value);
  }
  /// False: a problem has been reported.
  bool in_si(int line, const Head& h, const std::string& cell, double& value) {
    const Dimension d = dimension_of(h);
    if (d == Dimension::none) return true;
    const Quantity q = parse_quantity(cell + " " + h.unit, d);
    // Radians are written with four digits: 1.5708 is 90 degrees.
    value = h.unit == "rad" ? std::round(q.value * 100.0) / 100.0 : q.value;
    if (!q.ok)
      problems_.push_back({at(line), h.shown(), cell + " " + h.unit, range_of(h).text,
                           "a mark for a missing value? Leave the cell empty"});
    return q.ok;
  }
  bool in_range(int line, const Head& h, const std::string& cell, double value) {
    const Range range = range_of(h);
    const bool whole = h.kind != Column::n || value == std::floor(value);
    if (value >= range.low && value <= range.high && whole) return true;
    const bool strength = h.kind == Column::value && is_strength(h.property);
    problems_.push_back({at(line), h.shown(), cell + (h.unit.empty() ? "" : " " + h.unit), range.text,
                         h.is_angle() ? "fold the angle: bedding at 120 deg is the mirror image of 60 deg"
                         : strength && value < 0.0       ? "strengths are positive, those in tension too"
                         : h.unit.empty() || value < 0.0 ? ""
                                                         : "check the unit in the header"});
    return false;
  }

  /// What to do about a cell that is no number; `begins`: with one it begins.
  static std::string remedy_of(const std::string& cell, bool begins) {
    if (cell == "nan" || cell == "NaN" || cell == "n/a" || cell == "N/A" || cell == "n.d." || cell == "inf")
      return "leave the cell empty where nothing was measured";
    if (cell == io::formula_without_value)
      return "its value was not saved: open the workbook in the spreadsheet and save it";
    if (begins && std::isalpha(static_cast<unsigned char>(cell.back())) != 0)  // "45 GPa"
      return "units stand in the header only: mixed units are not read";
    const bool day = cell.size() == 10 && cell[4] == '-' && cell[7] == '-';
    return day ? "a day or an hour: did the spreadsheet take 1.5 for the first of May? Type it again in a "
                 "cell that has "
                 "the format of a number"
               : "write the number alone, no sign, limit, +- or blanks between digits; leave the "
                 "cell empty "
                 "only where nothing was measured";
  }

  /// A row that holds nothing of what is read: blank, or a remark.
  bool is_empty(const io::TableRow& row) const {
    for (std::size_t i = 0; i < heads_.all.size(); ++i)
      if (is_read(i) && !row.cells[i].empty() && !row.merged.contains(i)) return false;
    return true;
  }

  void read_row(const io::TableRow& row, double confining) {
    if (is_empty(row)) return;
    auto word = std::find_if(row.cells.begin(), row.cells.end(), is_summary);
    const auto name =
        std::find_if(row.cells.begin(), row.cells.end(), [](const auto& cell) { return !cell.empty(); });
    // Longer words count in the first cell alone, where rows have their names.
    if (word == row.cells.end() && begins_summary(*name)) word = name;
    if (word != row.cells.end()) {
      problems_.push_back(
          {at(row.line), "", *word, "a row of specimens",
           "take it out: specimens and their mean would count twice; of means alone give SD in a "
           "column ..._sd and their number in n"});
      return;
    }
    std::vector<double> v(heads_.all.size(), nan);
    bool good = true;
    for (std::size_t i = 0; i < heads_.all.size(); ++i)
      if (is_read(i)) good = number(row, i, v[i]) && good;
    RockReading r;
    r.line = row.line;
    good = read_angle(r, v, good);
    // After all cells are read, so that every bad cell of the row is reported.
    if (!good) return;
    if (const auto c = find(Column::confining); c && std::isfinite(v[*c])) r.confining = v[*c];
    if (const auto n = find(Column::n); n && std::isfinite(v[*n])) r.n = static_cast<int>(v[*n]);
    if (const auto d = find(Column::diameter); d && std::isfinite(v[*d])) r.diameter = v[*d];
    check_intermediate(r, v);
    // E and nu under another confining pressure than the one asked for are left out; NaN asks for none.
    const bool asked = !std::isfinite(confining) || same_stress(r.confining, confining);
    for (std::size_t i = 0; i < heads_.all.size(); ++i)
      if (heads_.all[i].kind == Column::value && std::isfinite(v[i])) read_value(r, v, i, asked);
    read_envelope(r, v);
  }
  bool read_angle(RockReading& r, const std::vector<double>& v, bool good) {
    const auto column = heads_.angles();
    if (!column) return good;
    const Head& h = heads_.all[*column];
    r.theta = h.theta_of(v[*column]);
    if (!good || std::isfinite(r.theta)) return good;
    // The box lays the bedding level, whatever it was in the core.
    if (is_shear_alone(v)) return r.theta = 0.0, true;
    problems_.push_back({at(r.line), h.name, "", "an angle in every row",
                         "give the layers of this specimen an angle, also where the row above has the same; "
                         "a row without any goes out of the table, or behind a #"});
    return false;
  }
  /// A row of direct shear, which has no inclination.
  bool is_shear_alone(const std::vector<double>& v) const {
    bool any = false, others = false;
    for (std::size_t i = 0; i < heads_.all.size(); ++i)
      if (const Head& h = heads_.all[i]; h.kind == Column::value && std::isfinite(v[i]))
        (measured(h.property).along_bedding ? any : others) = true;
    return any && !others;
  }
  /// Bedding lies level in the box, under the stress across it. False: a problem has been reported.
  bool put_in_box(RockReading& r, const std::vector<double>& v) {
    const auto column = find(Column::normal);
    r.theta = 0.0, r.confining = column ? v[*column] : nan;
    if (std::isfinite(r.confining)) return true;
    problems_.push_back({at(r.line), "sigma_n", "",
                         fmt::format("the normal stress of {}, in the same row", to_string(r.property)),
                         "bedding shears at another stress under each: 0 where the box was not loaded"});
    return false;
  }
  /// Only the ordinary triaxial test has one pressure around the specimen.
  void check_intermediate(const RockReading& r, const std::vector<double>& v) {
    const auto i = find(Column::intermediate);
    if (!i || !std::isfinite(v[*i]) || same_stress(v[*i], r.confining)) return;
    problems_.push_back({at(r.line), "sigma_2", fmt::format("{:g} MPa", v[*i] * 1e-6),
                         fmt::format("the confining stress, {:g} MPa", r.confining * 1e-6),
                         "a true triaxial test is not modelled in two dimensions: take such rows out"});
  }
  void read_value(RockReading r, const std::vector<double>& v, std::size_t i, bool asked) {
    const Head& h = heads_.all[i];
    r.property = h.property, r.value = v[i] + (h.deviatoric ? r.confining : 0.0);
    // A column n counts the specimens of the row; each of these columns has one of them.
    if (!h.replicate.empty()) r.n = 1;
    if (measured(r.property).along_bedding && !put_in_box(r, v)) return;
    if (measured(r.property).share != 1.0) r.diameter = 0.0;  // I_s(50) has been converted to 50 mm
    if (!asked && !is_strength(r.property)) {
      elsewhere_.insert(r.confining);
      return;
    }
    if (is_compressive(r.property)) {
      const auto other =
          find(Column::value, r.property == Property::ucs ? Property::confined : Property::ucs);
      // Told from the side of sigma_1 alone, or the same row would be told twice.
      if (r.property == Property::confined && other && std::isfinite(v[*other]))
        problems_.push_back({at(r.line), "sigma_1", "", "UCS or sigma_1 in a row, not both",
                             "they are the same number under `confining`: a row of its own for each test"});
      // The stress on the sides says which of the two it is; laboratories use either name for both.
      r.property = r.confining > 0.0 ? Property::confined : Property::ucs;
    }
    const auto sd = find(Column::scatter, h.property);
    // A scatter of zero is no measurement of scatter.
    r.sd = sd && v[*sd] > 0.0 ? v[*sd] : nan;
    if (std::isfinite(r.sd) && r.n < least_with_sd) r.n = least_with_sd, ++n_assumed_;
    readings_.push_back(r);
  }
  /// Angles that are told in degrees and can only be radians.
  void check_angles() {
    const auto column = heads_.angles();
    if (!column || heads_.all[*column].unit != "deg") return;
    const Head& h = heads_.all[*column];
    double least = nan, most = nan;
    for (const RockReading& r : readings_) {
      const double angle = h.theta_of(r.theta);
      least = std::fmin(least, angle), most = std::fmax(most, angle);
    }
    // A table of 0 alone is one inclination, in either unit.
    if (!(most > 0.0 && most < most_radians)) return;
    problems_.push_back(
        {at(table_.header_line), table_.header[*column], fmt::format("{:g} ... {:g} deg", least, most), "",
         "all angles lie below 1.6 degrees. Are they radians? Then the header is " + h.name + " [rad]"});
  }

  /// c and phi become two strengths. The line is one through `n` tests evenly spread over the pressures: at
  /// their mean plus and minus their standard deviation its errors do not depend on each other, and each is
  /// that of half of the tests.
  void read_envelope(RockReading r, const std::vector<double>& v) {
    const auto value = [&](Column kind) { return find(kind) ? v[*find(kind)] : nan; };
    const double c = value(Column::cohesion), phi = value(Column::friction);
    const double from = value(Column::least_confining), to = value(Column::most_confining);
    const double all[] = {c, phi, from, to};
    const auto given =
        std::count_if(std::begin(all), std::end(all), [](double x) { return std::isfinite(x); });
    if (given == 0 || !has_envelope()) return;  // columns that are missing were told once
    if (given < 4 || !(from < to)) {
      problems_.push_back({at(r.line), "c, phi", "",
                           "c, phi, and confining_min below confining_max in the same row",
                           "leave all four empty where no envelope was measured"});
      return;
    }
    // Two tests fix a line without any error: three are the fewest from which one follows.
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
      // Means, not single rows: UCS of other specimens may lie below where cracks begin in this one.
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
             fmt::format("a mean below the mean of UCS at this angle, {:.4g} MPa", ucs[theta].mean() * 1e-6),
             "cracks begin before the peak: are two columns swapped?"});
    }
  }

  /// What slides behind a peak is read in the test of that peak, and below it.
  void check_sliding() {
    for (const RockReading& r : readings_) {
      if (r.property != Property::shear_residual) continue;
      const auto peak = std::find_if(readings_.begin(), readings_.end(), [&](const RockReading& other) {
        // Of the same row, because friction and peak are read in one test, under one stress.
        return other.property == Property::shear_peak && other.line == r.line;
      });
      const std::string value = fmt::format("{:.4g} MPa", r.value * 1e-6);
      if (peak == readings_.end())
        problems_.push_back({at(r.line), "tau_residual", value, "tau_peak in the same row",
                             "both are read in one test: leave tau_residual out where its peak is unknown"});
      else if (r.value > peak->value)
        problems_.push_back({at(r.line), "tau_residual", value,
                             fmt::format("no more than tau_peak, {:.4g} MPa", peak->value * 1e-6),
                             "are two columns swapped?"});
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
  io::Table table = io::parse_table(bytes, where, keys.sheet);
  for (Problem& p : table.problems) problems.push_back(std::move(p));
  for (std::string& note : table.notes) notes.push_back(fmt::format("{}: {}", table.where, note));
  if (table.header_line == 0) return {};
  return ReadingReader(table, keys, problems, notes).read();
}

}  // namespace phy::rock
