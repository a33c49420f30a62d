#include "rock/heads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include "base/quote.hpp"
#include "base/trimmed.hpp"
#include "base/units.hpp"
#include "io/table_cells.hpp"
#include "rock/directions.hpp"

namespace phy::rock {
namespace {

constexpr std::size_t most_examples = 3;  // of cells, in a question

bool is_read(const Head& h) { return h.kind != Column::other && h.kind != Column::passed; }

bool is_number(const std::string& cell) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  return error == std::errc() && end == cell.data() + cell.size();
}

bool is_nothing(const std::string& cell) {
  return cell.empty() || cell == "-" || cell == "[-]" || cell == "(-)";
}

std::string quoted(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "\"" : ", \"") + text + '"';
  return all;
}

/// Headers with what the rock file would say of each: "A" = "-", "B" = "-".
std::string said_as(const std::string& name, const std::vector<std::string>& headers) {
  std::string all;
  for (const std::string& header : headers)
    all += (all.empty() ? "" : ", ") + toml_string(header) + " = \"" + name + '"';
  return all;
}

class HeadsReader {
 public:
  HeadsReader(io::Table& table, const TableKeys& keys, std::vector<Problem>& problems,
              std::vector<std::string>& notes)
      : table_(table), keys_(keys), problems_(problems), notes_(notes) {}

  Heads read() {
    // Rows of units first, since a bare SD takes the unit of the value before it. Names last, when it is
    // known what each column is.
    name_heads();
    take_row_of_units();
    take_degree_signs();
    settle_replicates();
    take_units_of_values();
    check_names();
    check_combinations();
    tell();
    return std::move(heads_);
  }

 private:
  io::Table& table_;
  const TableKeys& keys_;
  std::vector<Problem>& problems_;
  std::vector<std::string>& notes_;
  Heads heads_;
  std::vector<std::string> titles_;           // of the headers
  std::vector<std::size_t> without_unit_;     // columns that are read
  std::vector<std::string> unknown_;          // headers that are asked for
  std::vector<std::string> describe_layers_;  // headers that may say how the layers lie
  std::vector<std::string> passed_, named_, converted_, replicates_, set_aside_;
  std::set<std::size_t> told_;  // columns whose unit has been told to be none

  void report_problem(const std::string& key, const std::string& value, const std::string& expected,
                      const std::string& remedy) {
    problems_.push_back(
        {table_.where + ":" + std::to_string(table_.header_line), key, value, expected, remedy});
  }
  const std::string& header(std::size_t i) const { return table_.header[i]; }

  std::vector<std::string> cells_of(std::size_t column) const {
    std::vector<std::string> cells;
    for (const io::TableRow& row : table_.rows)
      if (!is_nothing(row.cells[column])) cells.push_back(row.cells[column]);
    return cells;
  }
  template <class Is>
  bool any_cell(std::size_t column, const Is& is) const {
    return std::any_of(table_.rows.begin(), table_.rows.end(), [&](const io::TableRow& row) {
      return !is_nothing(row.cells[column]) && is(row.cells[column]);
    });
  }
  template <class Is>
  bool all_cells(std::size_t column, const Is& is) const {
    const auto is_none = [&](const std::string& cell) { return !is(cell); };
    return any_cell(column, is) && !any_cell(column, is_none);
  }

  /// What the user says of a header: the header, whole or without its unit where no other has that title, and
  /// our name.
  const std::pair<const std::string, std::string>* said_of(std::size_t i) const {
    if (const auto whole = keys_.columns.find(header(i)); whole != keys_.columns.end()) return &*whole;
    // "UCS [MPa]" beside "UCS [psi]": without its unit the user's word would mean both.
    if (std::count(titles_.begin(), titles_.end(), titles_[i]) != 1) return nullptr;
    for (const auto& said : keys_.columns)
      if (title_of(said.first) == titles_[i]) return &said;
    return nullptr;
  }

  void name_heads() {
    for (const std::string& cell : table_.header) titles_.push_back(title_of(cell));
    std::set<std::string> said, used;  // names of ours; headers
    std::vector<bool> by_user;
    for (std::size_t i = 0; i < table_.header.size(); ++i) {
      const auto* meant = said_of(i);
      Head h = head_of(header(i), meant != nullptr ? meant->second : "");
      by_user.push_back(meant != nullptr);
      if (meant != nullptr) {
        used.insert(meant->first);
        if (h.replicate.empty()) said.insert(h.name);
        // A unit in the rock file mends a header that has none, or one that cannot be read.
        const std::string unit = head_of(meant->first).unit;
        if (!unit.empty()) h.unit = unit;
        // Also where the user has named the column: a factor that is passed over is a rock a thousand times
        // as stiff.
        if (is_read(h) && has_factor(titles_[i]) && !unit.starts_with("10^")) ask_for_factor(i, h);
      }
      heads_.all.push_back(std::move(h));
    }
    mark_replicates(by_user);
    // The user's word goes before what a header seems to say; specimens side by side stay together.
    for (std::size_t i = 0; i < heads_.all.size(); ++i)
      if (Head& h = heads_.all[i];
          !by_user[i] && h.kind != Column::other && said.contains(h.name) && h.replicate.empty())
        h.kind = Column::passed;
    check_counts(by_user);
    for (const auto& [title, name] : keys_.columns)
      if (!used.contains(title))
        report_problem("[columns]", title, "a header of this table",
                       fmt::format("it has: {}", fmt::join(table_.header, ", ")));
  }

  void ask_for_factor(std::size_t i, const Head& h) {
    report_problem(header(i), "", "a unit with the factor of the header",
                   fmt::format("write in the rock file for example: [columns] {} = \"{}\"",
                               toml_string(fmt::format("{} [10^3 {}]", titles_[i],
                                                       h.unit.empty() ? usual_unit(h) : h.unit)),
                               h.name));
  }
  /// Columns of values to which the user gives one name are specimens side by side; so is one beside such
  /// columns.
  void mark_replicates(const std::vector<bool>& by_user) {
    std::map<std::string, std::vector<std::size_t>> columns;
    for (std::size_t i = 0; i < heads_.all.size(); ++i)
      if (const Head& h = heads_.all[i];
          h.kind == Column::value && !h.summary && (by_user[i] || !h.replicate.empty()))
        columns[h.name].push_back(i);
    for (const auto& [name, same] : columns) {
      const bool asked = std::any_of(same.begin(), same.end(), [&](std::size_t i) { return by_user[i]; });
      for (std::size_t k = 0; asked && same.size() > 1 && k < same.size(); ++k)
        heads_.all[same[k]].replicate = std::to_string(k + 1);
    }
  }
  /// A column N that counts 1, 2, 3 numbers the rows.
  void check_counts(const std::vector<bool>& by_user) {
    for (std::size_t i = 0; i < heads_.all.size(); ++i) {
      if (heads_.all[i].kind != Column::n || by_user[i]) continue;
      const std::vector<std::string> cells = cells_of(i);
      // Two rows may well stand for one and for two specimens.
      bool counts = cells.size() > 2;
      for (std::size_t k = 0; k < cells.size(); ++k) counts = counts && cells[k] == std::to_string(k + 1);
      if (counts)
        report_problem(
            header(i), "1, 2, 3, ...", "the number of specimens behind each row",
            fmt::format(
                "does it number the rows? Write in the rock file: [columns] {0} = \"-\"; if not, {0} = \"n\"",
                toml_string(header(i))));
    }
  }

  /// Units in a row of their own: at least half of its cells, and no number.
  bool is_row_of_units(const io::TableRow& row) const {
    std::size_t units = 0, others = 0;
    for (std::size_t i = 0; i < heads_.all.size(); ++i) {
      const std::string& cell = row.cells[i];
      if (is_nothing(cell) || cell == "1") continue;
      const std::string unit = is_number(cell) ? "" : unit_of_cell(cell);
      // A number is a value, so this is a row of the table and no row of units.
      if (unit.empty() && io::looks_measured(cell)) return false;
      ++(unit.empty() ? others : units);
    }
    return units > 0 && units >= others;
  }
  void take_row_of_units() {
    if (table_.rows.empty() || !is_row_of_units(table_.rows.front())) return;
    const std::vector<std::string> cells = table_.rows.front().cells;
    table_.rows.erase(table_.rows.begin());
    notes_.push_back(table_.where + ": units stand in a row of their own");
    for (std::size_t i = 0; i < heads_.all.size(); ++i) {
      Head& h = heads_.all[i];
      const std::string unit = is_nothing(cells[i]) ? "" : unit_of_cell(cells[i]);
      if (!unit.empty() && !h.unit.empty() && unit != h.unit)
        report_problem(header(i), cells[i], "one unit", "the row below the header has another: correct one");
      // The header goes before the row: where both have one and differ, the message stands above.
      if (h.unit.empty()) h.unit = unit == "1" ? "" : unit;
      if (unit.empty() && !is_nothing(cells[i]) && is_read(h) && dimension_of(h) != Dimension::none)
        told_.insert(i), tell_unit(i, cells[i]);
    }
  }

  /// "30°" below a header without a unit.
  void take_degree_signs() {
    for (std::size_t i = 0; i < heads_.all.size(); ++i) {
      Head& h = heads_.all[i];
      if (!h.is_angle() || !h.unit.empty()) continue;
      // Where bare numbers stand beside them, their unit is still to be asked.
      if (!any_cell(i, is_number) && any_cell(i, [&](const auto& cell) { return is_direction(cell, i); }))
        h.unit = "deg";
    }
  }

  /// Columns of one property that are told apart by a mark are specimens of the same row; what is made of
  /// them, a mean or an SD, is set aside. A mark alone, or none that begins, says nothing.
  void settle_replicates() {
    std::map<std::string, std::vector<std::size_t>> marked;
    for (std::size_t i = 0; i < heads_.all.size(); ++i)
      if (!heads_.all[i].replicate.empty() && is_read(heads_.all[i])) marked[heads_.all[i].name].push_back(i);
    for (auto& [name, columns] : marked) {
      take_unmarked(name, columns);
      std::set<std::string> marks;
      for (const std::size_t i : columns) marks.insert(heads_.all[i].replicate);
      // Specimens are counted from the first. "UCS 25" and "UCS 50" are sizes, temperatures, or ages.
      const bool begins = marks.contains("1") || marks.contains("01") || marks.contains("a");
      if (columns.size() > 1 && marks.size() == columns.size() && begins)
        take_replicates(name, columns);
      else
        for (const std::size_t i : columns)
          // Not passed over: they speak of values, so that it is asked what they are.
          heads_.all[i].kind = Column::other, heads_.all[i].speaks_of.values = true;
    }
    for (std::size_t i = 0; i < heads_.all.size(); ++i) take_scatter_behind(i);
  }
  /// "UCS", "UCS 2", "UCS 3", as spreadsheets tell equal headers apart: the first has no mark.
  void take_unmarked(const std::string& name, std::vector<std::size_t>& columns) {
    for (std::size_t i = 0; i < heads_.all.size(); ++i) {
      Head& h = heads_.all[i];
      if (h.kind != Column::value || h.name != name || !h.replicate.empty() || h.summary) continue;
      const auto has = [&](const char* mark) {
        return std::any_of(columns.begin(), columns.end(),
                           [&](std::size_t k) { return heads_.all[k].replicate == mark; });
      };
      // With a first specimen in the table an unmarked column is something else, a mean perhaps.
      if (!has("1") && has("2")) h.replicate = "1", columns.push_back(i);
    }
  }
  void take_replicates(const std::string& name, const std::vector<std::size_t>& columns) {
    std::vector<std::string> titles;
    for (const std::size_t i : columns) titles.push_back(titles_[i]);
    replicates_.push_back(fmt::format("{} are specimens of {}", fmt::join(titles, ", "), name));
    for (std::size_t i = 0; i < heads_.all.size(); ++i) {
      Head& h = heads_.all[i];
      const bool named = h.name == name || h.name == name + "_sd";
      if (!h.summary || h.kind == Column::passed ||
          !(named || (h.kind == Column::other && belongs_to(i, name))))
        continue;
      h.kind = Column::passed, set_aside_.push_back(header(i));
    }
  }
  /// A bare "Mean" or "SD" belongs to the last property on its left.
  bool belongs_to(std::size_t i, const std::string& name) const {
    while (i > 0 && heads_.all[i].summary) --i;
    return heads_.all[i].name == name;
  }
  /// A bare "SD" right behind a value is its scatter.
  void take_scatter_behind(std::size_t i) {
    if (i == 0 || heads_.all[i].kind != Column::other || !is_scatter(titles_[i])) return;
    const Head& value = heads_.all[i - 1];
    // Behind specimens side by side an SD is that of all of them, and made of what is read anyway.
    if (value.kind != Column::value || !value.replicate.empty()) return;
    Head& h = heads_.all[i];
    h.kind = Column::scatter, h.property = value.property, h.name = value.name + "_sd";
    if (h.unit.empty()) h.unit = value.unit;
  }

  /// A standard deviation without a unit has the unit of its values.
  void take_units_of_values() {
    for (Head& h : heads_.all)
      if (const auto value = heads_.find(Column::value, h.property);
          // With brackets left in its title a unit was tried there and not understood: that is asked, not
          // guessed.
          h.kind == Column::scatter && h.unit.empty() && value && base_title(h) == h.title)
        h.unit = heads_.all[*value].unit;
  }

  void check_names() {
    std::map<std::string, std::size_t> seen;
    for (std::size_t i = 0; i < heads_.all.size(); ++i) {
      const Head& h = heads_.all[i];
      if (h.kind == Column::passed) {
        if (std::find(set_aside_.begin(), set_aside_.end(), header(i)) == set_aside_.end())
          passed_.push_back(header(i));
      } else if (h.kind == Column::other) {
        check_other(i);
      } else if (const auto [it, fresh] = seen.emplace(h.name, i);
                 !fresh && (h.replicate.empty() || heads_.all[it->second].replicate.empty())) {
        check_second(i, it->second);
      } else {
        check_unit(i);
        if (!h.own && h.replicate.empty()) named_.push_back(fmt::format("{} is {}", header(i), h.name));
      }
    }
    if (!unknown_.empty()) ask_for_names();
    ask_for_layers();
    if (without_unit_.size() == 1) tell_unit(without_unit_.front(), "");
    if (without_unit_.size() > 1) ask_for_units();
  }
  /// All headers without a unit in one question.
  void ask_for_units() {
    std::vector<std::string> titles, mended;
    for (const std::size_t i : without_unit_) {
      titles.push_back(header(i));
      mended.push_back(fmt::format("{} [{}]", titles_[i], usual_unit(heads_.all[i])));
    }
    report_problem(quoted(titles), "", "a unit in each header, or in a row of units below",
                   fmt::format("write for example {}", fmt::join(mended, ", ")));
  }
  /// All unknown columns in one question.
  void ask_for_names() {
    bool factor = false, direction = false;
    for (const std::string& name : unknown_) {
      factor = factor || has_factor(title_of(name));
      direction = direction || title_of(name).ends_with("°") || direction_in_words(name, "");
    }
    std::string more;
    if (factor) more += "; a factor goes into the unit, as in \"E×10³ [10^3 MPa]\" = \"E\"";
    if (direction) more += "; where the header says the direction, give one row per angle and a column theta";
    report_problem(
        quoted(unknown_), "",
        fmt::format("a known column: {}; of each value also _sd", fmt::join(names_in_short(), ", ")),
        fmt::format("write in the rock file what each is, or \"-\" to leave it out: [columns] {}{}",
                    said_as("...", unknown_), more));
  }
  static std::vector<std::string> names_in_short() {
    std::vector<std::string> names = column_names();
    std::erase_if(names, [](const std::string& name) { return name.ends_with("_sd"); });
    return names;
  }

  /// Numbers that may be meant for the model are not dropped in silence: those of a column that has no name,
  /// or a name that is not understood with the unit or a word of what is read.
  void check_other(std::size_t i) {
    const Head& h = heads_.all[i];
    if (header(i).empty()) return check_nameless(i);
    const auto unit = find_unit(h.unit);
    const bool angle = unit && unit->dimension == Dimension::angle;
    const bool value =
        unit && (unit->dimension == Dimension::pressure || unit->dimension == Dimension::toughness);
    const bool speaks = (h.speaks_of.values || h.summary) && !unit;  // "UCS diameter [mm]" is no strength
    if (may_be_angle(i))
      ask_for_angle(i);
    else if (angle || value || (speaks && any_cell(i, io::looks_measured)))
      unknown_.push_back(header(i));
    else if (needs_angles() && h.speaks_of.directions && h.unit.empty() && !cells_of(i).empty())
      describe_layers_.push_back(header(i));
    else
      passed_.push_back(header(i));
  }
  bool is_direction(const std::string& cell, std::size_t column) const {
    return without_degree_sign(cell) || direction_in_words(cell, header(column));
  }
  /// Numbers below a word of angles; of a table without angles also "parallel" and "30°" below any header.
  bool may_be_angle(std::size_t i) const {
    const Head& h = heads_.all[i];
    if (h.kind != Column::other || header(i).empty() ||
        !(h.unit.empty() || h.unit == "deg" || h.unit == "rad"))
      return false;
    const auto is_angle = [&](const auto& cell) { return is_number(cell) || is_direction(cell, i); };
    if (h.speaks_of.angles && (!h.unit.empty() || any_cell(i, is_angle))) return true;
    if (needs_angles() && !h.unit.empty()) return true;
    if (!needs_angles() || !any_cell(i, is_angle)) return false;
    // Bare numbers below a header that says nothing may be anything; signs of degrees or words of directions
    // may not.
    return h.speaks_of.directions || (!all_cells(i, is_number) && all_cells(i, is_angle));
  }
  bool needs_angles() const { return !heads_.angles() && keys_.bedded != false; }
  /// What an angle would be called in the rock file: the header, with the unit of bare numbers.
  std::string angle_key(std::size_t i) const {
    const bool bare = heads_.all[i].unit.empty() && any_cell(i, is_number);
    return toml_string(header(i) + (bare ? " [deg]" : ""));
  }
  void check_nameless(std::size_t i) {
    for (const io::TableRow& row : table_.rows)
      if (!row.cells[i].empty())
        return report_problem(fmt::format("column {}", i + 1), "", "a header",
                              fmt::format("line {} has a value there", row.line));
  }
  void ask_for_angle(std::size_t i) {
    heads_.asked_for_angles = true;
    if (heads_.angles())
      return report_problem(
          header(i), "", "one column of angles",
          fmt::format("the angles of the layers are read from another; leave this one out: [columns] {} = "
                      "\"-\", or the other",
                      toml_string(header(i))));
    const std::string words = meaning_of_words(i);
    const auto is_word = [&](const auto& cell) { return direction_in_words(cell, header(i)).has_value(); };
    if (all_cells(i, is_word))
      return report_problem(
          header(i), "", "an angle that says from where it counts",
          fmt::format("write in the rock file: [columns] {} = \"theta\". Then {}. \"-\" leaves it out",
                      angle_key(i), words));
    report_problem(
        header(i), "", "an angle that says from where it counts",
        fmt::format(
            "is it theta (of the layers from the horizontal, load upright) or beta (between load and "
            "layers)? Write in the rock file: [columns] {} = \"theta\", or = \"beta\"; \"-\" leaves it "
            "out{}{}",
            angle_key(i), words.empty() ? "" : ". Then ", words));
  }
  /// Columns whose names speak of a direction and whose cells do not, in one question.
  void ask_for_layers() {
    // One question about angles is enough: its answer settles the others, too.
    if (heads_.asked_for_angles || describe_layers_.empty()) return;
    heads_.asked_for_angles = true;
    report_problem(
        quoted(describe_layers_), "", "an angle that says from where it counts",
        fmt::format("if it says how the layers lie, add a column theta [deg]: 90 where the load is along "
                    "them, 0 where it is across. If not, write in the rock file: [columns] {}",
                    said_as("-", describe_layers_)));
  }
  /// What the words of a column would count as.
  std::string meaning_of_words(std::size_t i) const {
    std::vector<std::string> meanings;
    std::set<std::string> seen;
    for (const std::string& cell : cells_of(i))
      if (const auto theta = direction_in_words(cell, header(i));
          theta && seen.insert(cell).second && meanings.size() < most_examples)
        meanings.push_back(fmt::format("\"{}\" counts as theta = {:g} deg", cell, *theta));
    return fmt::format("{}", fmt::join(meanings, ", "));
  }

  void check_second(std::size_t i, std::size_t first) {
    const Head &a = heads_.all[first], &b = heads_.all[i];
    const std::string remedy =
        a.title != b.title ? fmt::format(
                                 "{} is read as that too: the rock file chooses, "
                                 "[columns] {} = \"{}\" and {} = \"-\"; "
                                 "of specimens side by side both are \"{}\"",
                                 header(first), toml_string(b.title), b.name, toml_string(a.title), b.name)
        : a.unit != b.unit ? "its units are mixed: " + a.unit + " and " + b.unit
                           : "two headers are the same: rename one";
    report_problem(header(i), "", "one column of " + b.name, remedy);
  }

  void check_unit(std::size_t i) {
    const Head& h = heads_.all[i];
    const Dimension d = dimension_of(h);
    const bool bare = h.unit.empty() || h.unit == "-" || h.unit == "1";
    const auto unit = find_unit(h.unit);
    if (d == Dimension::none) {
      if (!bare)
        report_problem(header(i), h.unit, fmt::format("{} without a unit", h.name),
                       "write it as a bare number" + otherwise(h));
    } else if (bare && base_title(h) == h.title) {
      if (!told_.contains(i) && !speaks_in_words(i)) without_unit_.push_back(i);
    } else if (!unit || unit->dimension != d) {
      if (!told_.contains(i)) tell_unit(i, bare ? "" : h.unit);
    } else if (const Quantity one = parse_quantity("1 " + h.unit, d);
               print_quantity(one.value, d) != "1 " + h.unit && h.unit != "cm") {
      converted_.push_back(fmt::format("{} [{}]", base_title(h), h.unit));
    }
  }
  /// A column of "parallel" and "perpendicular" needs no unit.
  bool speaks_in_words(std::size_t i) const { return heads_.all[i].is_angle() && cells_of(i).empty(); }
  static std::string otherwise(const Head& h) {
    return fmt::format("; if it is something else: [columns] {} = \"-\" in the rock file",
                       toml_string(h.title));
  }
  /// The title up to its brackets: what is in them is no unit, and a second one would not mend it.
  static std::string base_title(const Head& h) {
    return std::string(trimmed(std::string_view(h.title).substr(0, h.title.find_first_of("[({")), " "));
  }
  void tell_unit(std::size_t i, const std::string& found) {
    const Head& h = heads_.all[i];
    const std::string base = base_title(h).empty() ? h.name : base_title(h);
    const std::string bracket = h.title.substr(std::min(base.size(), h.title.size()));
    const std::string odd = !found.empty() ? found : std::string(trimmed(bracket, "[](){} "));
    report_problem(
        header(i), odd, fmt::format("a unit of {} in the header: {}", h.name, unit_names(dimension_of(h))),
        fmt::format("write for example {} [{}]{}{}", base, usual_unit(h),
                    odd.empty() ? "" : " and convert the values, if they are in another", otherwise(h)));
  }

  void check_combinations() {
    const std::vector<Head>& all = heads_.all;
    if (heads_.find(Column::theta) && heads_.find(Column::beta))
      report_problem("beta", "", "one convention of angles", "keep theta or beta, not both");
    const auto named = [&](const char* name) {
      return std::find_if(all.begin(), all.end(),
                          [&](const Head& h) { return is_read(h) && h.name == name; });
    };
    if (named("sigma_1") != all.end() && named("deviator") != all.end())
      report_problem("deviator", "", "sigma_1 or the deviator stress",
                     "pass one of the two over in the rock file: [columns] " +
                         toml_string(named("deviator")->title) + " = \"-\"");
    for (std::size_t i = 0; i < all.size(); ++i)
      if (all[i].kind == Column::scatter && !heads_.find(Column::value, all[i].property))
        report_problem(header(i), "", "a column of the values themselves", "");
    const bool any = std::any_of(all.begin(), all.end(), [](const Head& h) {
      return h.kind == Column::value || h.kind == Column::cohesion;
    });
    if (!any && unknown_.empty())
      report_problem(
          "header", fmt::format("{}", fmt::join(table_.header, ", ")),
          "at least one of the columns E, nu, UCS, DTS, BTS, sigma_1, c",
          "is this the line of the headers? Take away what stands above it; the rock file can say which "
          "is which: [columns] \"peak stress\" = \"UCS\"");
    check_envelope_columns();
  }
  /// A line over confining stress needs both of its numbers, and where it was measured.
  void check_envelope_columns() {
    const Column columns[] = {Column::cohesion, Column::friction, Column::least_confining,
                              Column::most_confining};
    const auto n = std::count_if(std::begin(columns), std::end(columns),
                                 [&](Column c) { return heads_.find(c).has_value(); });
    if (n == 0 || n == 4) return;
    std::vector<std::string> given;
    for (const Column c : columns)
      if (const auto i = heads_.find(c)) given.push_back(header(*i));
    report_problem(
        "c, phi", "", "the columns c, phi, confining_min and confining_max together",
        "an envelope is read as strengths, and only inside the pressures that were tested; to do without: "
        "[columns] " +
            said_as("-", given));
  }

  void tell() {
    const auto note = [&](const char* form, const std::vector<std::string>& all) {
      if (!all.empty()) notes_.push_back(fmt::format(fmt::runtime(form), fmt::join(all, ", ")));
    };
    // Both conventions are in use, so the conversion is mentioned.
    if (heads_.find(Column::beta))
      notes_.emplace_back("angles are beta, between load and bedding; theta = 90 deg - beta");
    note("columns by other names: {} ([columns] in the rock file changes that)", named_);
    for (std::size_t i = 0; i < heads_.all.size(); ++i)
      if (heads_.all[i].is_angle())
        if (const std::string words = meaning_of_words(i); !words.empty() && keys_.bedded != false)
          notes_.push_back("directions: " + words);
    note("specimens side by side: {}", replicates_);
    note("set aside, since the specimens themselves are read: {}", set_aside_);
    note("converted to SI: {}", converted_);
    note("columns passed over: {}", passed_);
  }
};

}  // namespace

std::optional<std::size_t> Heads::find(Column kind, Property p) const {
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].kind == kind && (all[i].property == p || (kind != Column::value && kind != Column::scatter)))
      return i;
  return std::nullopt;
}

Heads read_heads(io::Table& table, const TableKeys& keys, std::vector<Problem>& problems,
                 std::vector<std::string>& notes) {
  return HeadsReader(table, keys, problems, notes).read();
}

}  // namespace phy::rock
