#include "io/workbook.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <set>

#include "base/quote.hpp"
#include "base/trimmed.hpp"
#include "base/units.hpp"
#include "io/table_cells.hpp"
#include "io/table_layout.hpp"
#include "io/zip.hpp"

namespace phy::io {
namespace {

constexpr std::size_t most_bytes = 64U << 20U;  // of one XML file
constexpr int most_used_columns = static_cast<int>(most_table_columns);
constexpr std::size_t most_sample_rows = 1000;  // that show where the table begins
// Each is read whole for a hint in a message: a workbook of hundreds must not take minutes for it.
constexpr std::size_t most_sheets_tried = 20;
constexpr int most_rows = 1048576,
              most_columns = 16384;  // of a sheet (ECMA-376 names no limit; these are Excel's)

/// A file of the archive as XML. False: there is no such file, or it cannot be read.
bool read_xml(const ZipArchive& archive, const std::string& name, pugi::xml_document& document) {
  const auto text = archive.read(name, most_bytes);
  return text && document.load_buffer(text->data(), text->size());
}

/// Names of elements without the prefix of their namespace, which some programs write.
std::string_view local_name(pugi::xml_node node) {
  const std::string_view name = node.name();
  const std::size_t colon = name.find(':');
  return colon == name.npos ? name : name.substr(colon + 1);
}
pugi::xml_node child(pugi::xml_node node, std::string_view name) {
  return node.find_child([&](pugi::xml_node n) { return local_name(n) == name; });
}
template <class Visit>
void each_child(pugi::xml_node node, std::string_view name, const Visit& visit) {
  for (const pugi::xml_node n : node.children())
    if (local_name(n) == name) visit(n);
}

/// A text, whole (`t`) or in runs of one look (`r`).
std::string text_of(pugi::xml_node node) {
  std::string text = child(node, "t").text().get();
  each_child(node, "r", [&](pugi::xml_node run) { text += child(run, "t").text().get(); });
  return text;
}

/// "B7" is row 7, column 2; rows and columns from 1. False: that is no cell.
struct Place {
  int row = 0, column = 0;
};
bool parse_place(std::string_view text, Place& place) {
  std::size_t i = 0;
  int column = 0;
  for (; i < text.size() && text[i] >= 'A' && text[i] <= 'Z' && column <= most_columns; ++i)
    column = 26 * column + (text[i] - 'A' + 1);
  int row = 0;
  const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), row);
  if (error != std::errc() || end != text.data() + text.size() || i == 0) return false;
  if (row < 1 || row > most_rows || column > most_columns) return false;
  place = {row, column};
  return true;
}
std::string column_letters(int column) {
  std::string letters;
  for (; column > 0; column = (column - 1) / 26)
    letters.insert(letters.begin(), static_cast<char>('A' + (column - 1) % 26));
  return letters;
}

/// The text of a cell on one line.
std::string one_line(const std::string& s) {
  std::string text(trimmed(s));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

/// Does a number under this format look like a day or an hour? Quoted text, colours and [conditions] are no
/// part of it.
bool is_day_format(std::string_view code) {
  bool quoted = false, bracketed = false;
  for (const char c : code) {
    if (c == '"') quoted = !quoted;
    if (c == '[' || c == ']') bracketed = c == '[';
    if (!quoted && !bracketed && std::string_view("dyhDYH").find(c) != std::string_view::npos) return true;
  }
  return false;
}

/// Looks of cells (their `s`) that show a number as a day.
std::set<int> day_looks(const ZipArchive& archive) {
  pugi::xml_document document;
  std::set<int> looks;
  if (!read_xml(archive, "xl/styles.xml", document)) return looks;
  const pugi::xml_node sheet = child(document, "styleSheet");
  std::set<int> days;  // formats; built in are 14 to 22 and 45 to 47, in East Asia 27 to 36 and 50 to 58
  // These have no code in the file: programs know them by number.
  for (const auto& [from, to] : {std::pair{14, 22}, {27, 36}, {45, 47}, {50, 58}})
    for (int id = from; id <= to; ++id) days.insert(id);
  each_child(child(sheet, "numFmts"), "numFmt", [&](pugi::xml_node f) {
    if (is_day_format(f.attribute("formatCode").value())) days.insert(f.attribute("numFmtId").as_int());
  });
  int look = 0;
  each_child(child(sheet, "cellXfs"), "xf", [&](pugi::xml_node xf) {
    if (days.contains(xf.attribute("numFmtId").as_int())) looks.insert(look);
    ++look;
  });
  return looks;
}

/// A number that is shown as a day, as "2026-05-01": days are counted from the end of 1899.
std::string day_of(const std::string& number) {
  double n = 0.0;
  std::from_chars(number.data(), number.data() + number.size(), n);
  if (!(n >= 0.0 && n < 3e6)) return number;
  using namespace std::chrono;
  // The 30th of December, since spreadsheets take 1900 for a leap year.
  const year_month_day day{sys_days{year{1899} / 12 / 30} + days{static_cast<int>(n)}};
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                     static_cast<unsigned>(day.day()));
}

struct Sheet {
  std::map<int, std::map<int, std::string>> rows;  // cells that are not empty, by row and column
  std::map<int, std::set<int>> merged;             // columns that a row shares with the row above
  std::set<int> hidden;                            // rows
  int hidden_columns = 0;
};

class WorkbookReader {
 public:
  WorkbookReader(std::string_view bytes, std::string sheet, std::string where)
      : archive_(bytes), wanted_(std::move(sheet)), where_(std::move(where)) {}

  Table read() {
    if (const auto file = find_sheet(); file && read_sheet(*file)) cut_table();
    table_.where = where_;
    return std::move(table_);
  }
  /// Did the sheet have a row of names above rows with numbers?
  bool has_layout() const { return layout_.has_value(); }
  const std::string& name() const { return name_; }
  const std::vector<std::string>& other_sheets() const { return others_; }

 private:
  ZipArchive archive_;
  std::string wanted_, where_, name_;
  std::vector<std::string> others_;
  std::optional<Layout> layout_;
  Table table_;
  Sheet sheet_;
  int n_commas_ = 0;  // numbers that are text

  bool refuse(const std::string& found, const std::string& expected, const std::string& remedy) {
    table_.problems.push_back({where_, "", found, expected, remedy});
    return false;
  }
  std::string at(int row) const { return fmt::format("{}:{}", where_, row); }

  /// The file of the sheet that is wanted.
  std::optional<std::string> find_sheet() {
    pugi::xml_document book, links;
    if (!read_xml(archive_, "xl/workbook.xml", book) ||
        !read_xml(archive_, "xl/_rels/workbook.xml.rels", links)) {
      const bool open_document = archive_.has("content.xml");
      refuse(
          open_document ? "an OpenDocument spreadsheet" : "an archive that is no workbook, or a damaged one",
          "a workbook (.xlsx) or CSV", "save it anew in one of these formats");
      return {};
    }
    std::map<std::string, std::string> files;
    each_child(child(links, "Relationships"), "Relationship", [&](pugi::xml_node link) {
      const std::string target = link.attribute("Target").value();
      // Targets are relative to the folder of the workbook, or absolute in the archive.
      files[link.attribute("Id").value()] = target.starts_with('/') ? target.substr(1) : "xl/" + target;
    });
    std::vector<std::pair<std::string, std::string>> sheets;  // name and file
    each_child(child(child(book, "workbook"), "sheets"), "sheet", [&](pugi::xml_node sheet) {
      const bool hidden = std::string_view(sheet.attribute("state").value()).ends_with("idden");
      // Hidden sheets hold lists and settings. Whoever names one means it.
      if (hidden && wanted_ != sheet.attribute("name").value()) return;
      for (const pugi::xml_attribute a : sheet.attributes())
        if (const std::string_view name = a.name(); name == "r:id" || name.ends_with(":id"))
          sheets.emplace_back(sheet.attribute("name").value(), files[a.value()]);
    });
    return choose(sheets);
  }
  std::optional<std::string> choose(const std::vector<std::pair<std::string, std::string>>& sheets) {
    std::vector<std::string> names;
    for (const auto& [name, file] : sheets) names.push_back(name);
    const auto chosen =
        wanted_.empty() ? sheets.begin() : std::find_if(sheets.begin(), sheets.end(), [&](const auto& sheet) {
          return sheet.first == wanted_;
        });
    if (chosen == sheets.end()) {
      refuse(wanted_.empty() ? "no sheet" : "no sheet \"" + wanted_ + '"', "a sheet of the workbook",
             names.empty() ? "" : "it has: " + names_of(names));
      return {};
    }
    for (auto sheet = sheets.begin(); sheet != sheets.end(); ++sheet)
      if (sheet != chosen) others_.push_back(sheet->first);
    name_ = printable(chosen->first);
    if (wanted_.empty() && !others_.empty())
      table_.notes.push_back(
          fmt::format("the first of its sheets is read: {}; other sheets: {}", name_, names_of(others_)));
    where_ += " [" + name_ + "]";
    return chosen->second;
  }
  static std::string printable(const std::string& text) { return is_plain(text) ? text : "?"; }

 public:
  static std::string names_of(const std::vector<std::string>& sheets) {
    std::string names;
    for (const std::string& name : sheets) names += (names.empty() ? "" : ", ") + printable(name);
    return names;
  }

 private:
  std::vector<std::string> shared_texts() const {
    std::vector<std::string> texts;
    pugi::xml_document document;
    if (read_xml(archive_, "xl/sharedStrings.xml", document))
      each_child(child(document, "sst"), "si", [&](pugi::xml_node si) { texts.push_back(text_of(si)); });
    return texts;
  }

  bool read_sheet(const std::string& file) {
    pugi::xml_document document;
    if (!read_xml(archive_, file, document))
      return refuse("the sheet is missing, damaged or larger than 64 MB", "a whole workbook", "save it anew");
    const std::vector<std::string> texts = shared_texts();
    const std::set<int> days = day_looks(archive_);
    const pugi::xml_node sheet = child(document, "worksheet");
    int row = 0;
    each_child(child(sheet, "sheetData"), "row", [&](pugi::xml_node r) {
      row = r.attribute("r").as_int(row + 1);  // numbers may be left out
      if (row < 1 || row > most_rows) return;
      if (r.attribute("hidden").as_bool()) sheet_.hidden.insert(row);
      int column = 0;
      each_child(r, "c", [&](pugi::xml_node c) {
        Place place{row, column + 1};
        if (const pugi::xml_attribute a = c.attribute("r"); a && !parse_place(a.value(), place)) return;
        column = place.column;
        const std::string text = plain_cell(one_line(content(c, texts)));
        if (!text.empty()) sheet_.rows[row][column] = is_day(c, days) ? day_of(text) : text;
      });
    });
    each_child(child(sheet, "cols"), "col", [&](pugi::xml_node c) {
      const int from = c.attribute("min").as_int(), to = std::min(c.attribute("max").as_int(), most_columns);
      if (c.attribute("hidden").as_bool() && from >= 1 && from <= to) sheet_.hidden_columns += to - from + 1;
    });
    each_child(child(sheet, "mergeCells"), "mergeCell",
               [&](pugi::xml_node merged) { fill_merged(merged.attribute("ref").value()); });
    return true;
  }
  static bool is_day(pugi::xml_node c, const std::set<int>& days) {
    const std::string_view type = c.attribute("t").value();
    return (type.empty() || type == "n") && days.contains(c.attribute("s").as_int());
  }
  static std::string content(pugi::xml_node c, const std::vector<std::string>& texts) {
    const std::string_view type = c.attribute("t").value();
    const std::string value = child(c, "v").text().get();
    // A formula is not worked out here. Without its saved value an empty cell would pass for one that was not
    // measured.
    if (value.empty() && child(c, "f")) return formula_without_value;
    if (type == "b") return value == "1" ? "TRUE" : "FALSE";
    if (type == "inlineStr") return text_of(child(c, "is"));
    if (type == "s") {
      std::size_t i = texts.size();
      std::from_chars(value.data(), value.data() + value.size(), i);
      return i < texts.size() ? texts[i] : "";
    }
    // Numbers are saved with seventeen digits: the shortest that mean the same were typed.
    double number = 0.0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    const bool whole = error == std::errc() && end == value.data() + value.size() && !value.empty();
    return whole && (type.empty() || type == "n") ? print_number(number) : value;
  }
  /// Cells merged downwards are one value for several rows: an angle beside its replicates.
  void fill_merged(std::string_view ref) {
    const std::size_t colon = ref.find(':');
    Place from, to;
    if (colon == ref.npos || !parse_place(ref.substr(0, colon), from) ||
        // Merged sideways are titles, which belong to no column.
        !parse_place(ref.substr(colon + 1), to) || from.column != to.column)
      return;
    const auto row = sheet_.rows.find(from.row);
    if (row == sheet_.rows.end() || !row->second.contains(from.column)) return;
    const std::string cell = row->second.at(from.column);
    // Only rows that hold something else: below the table a merged cell says nothing.
    for (auto r = std::next(row); r != sheet_.rows.end() && r->first <= to.row; ++r)
      if (r->second.emplace(from.column, cell).second) sheet_.merged[r->first].insert(from.column);
  }

  using Row = std::map<int, std::map<int, std::string>>::const_iterator;

  /// The first rows as far as tables reach, counted from the first column that is used.
  std::vector<TableRow> sample() const {
    // Tables often begin at B2; a column that is empty all the way is none.
    int first = most_columns;
    for (const auto& [number, cells] : sheet_.rows) first = std::min(first, cells.begin()->first);
    std::vector<TableRow> rows;
    for (auto row = sheet_.rows.begin(); row != sheet_.rows.end() && rows.size() < most_sample_rows; ++row) {
      const int reach = std::min(row->second.rbegin()->first - first + 1, most_used_columns);
      rows.push_back(cells_of(row, first, first + reach - 1));
    }
    return rows;
  }
  TableRow cells_of(Row row, int first, int last) const {
    TableRow made{row->first, {}};
    const auto shared = sheet_.merged.find(row->first);
    for (int column = first; column <= last; ++column) {
      const auto cell = row->second.find(column);
      made.cells.push_back(cell == row->second.end() ? "" : cell->second);
      if (shared != sheet_.merged.end() && shared->second.contains(column))
        made.merged.insert(static_cast<std::size_t>(column - first));
    }
    return made;
  }

  /// Where the header stands: above rows with numbers, or else the first row with two cells.
  Row find_header() {
    const std::vector<TableRow> rows = sample();
    layout_ = find_layout(rows, HeaderRule::names);
    if (!layout_) layout_ = find_layout(rows, HeaderRule::numbers);
    // A single column of numbers has nothing to stand beside.
    if (layout_ && layout_->width < 2) layout_.reset();
    if (layout_) return sheet_.rows.find(rows[layout_->header].line);
    return std::find_if(sheet_.rows.cbegin(), sheet_.rows.cend(),
                        [](const auto& row) { return row.second.size() >= 2; });
  }

  /// The table in the sheet: header, width, end.
  void cut_table() {
    const Row header = find_header();
    if (header == sheet_.rows.cend()) {
      refuse("", "a row of headers and at least one row below it",
             sheet_.rows.empty() ? "the sheet is empty" : "no row has two cells");
      return;
    }
    const Row lower = layout_ && layout_->two_rows ? std::next(header) : header;
    if (header != sheet_.rows.cbegin())
      table_.notes.push_back(fmt::format("what stands above row {} is passed over", header->first));
    const int first = std::min(header->second.begin()->first, lower->second.begin()->first);
    const int last = std::max(header->second.rbegin()->first, lower->second.rbegin()->first);
    // A lost cell far to the right would make a table of thousands of columns.
    if (last - first >= most_used_columns) {
      refuse(fmt::format("headers from column {} to {}", column_letters(first), column_letters(last)),
             fmt::format("at most {} columns side by side", most_used_columns),
             "clear what stands far to the right");
      return;
    }
    take_header(cells_of(header, first, last), cells_of(lower, first, last));
    take_rows(std::next(lower), first, last);
  }
  void take_header(TableRow upper, TableRow lower) {
    for (std::string& cell : upper.cells) cell = plain_name(cell);
    for (std::string& cell : lower.cells) cell = plain_name(cell);
    table_.header_line = upper.line;
    table_.header = upper.line == lower.line ? upper.cells : one_header(upper, lower);
    if (upper.line != lower.line)
      table_.notes.push_back(fmt::format("the header has two rows, {} and {}: {}", upper.line, lower.line,
                                         fmt::join(table_.header, ", ")));
  }
  void take_rows(Row from, int first, int last) {
    std::set<int> hidden;
    int beside = 0;
    for (Row it = from; it != sheet_.rows.cend(); ++it) {
      add_row(it, first, last, beside);
      if (sheet_.hidden.contains(it->first)) hidden.insert(it->first);
    }
    if (beside > 0)
      table_.notes.push_back(fmt::format("{} cell(s) beside the table are passed over", beside));
    if (sheet_.hidden_columns > 0) table_.notes.emplace_back("hidden columns are read too");
    if (!hidden.empty())
      table_.notes.push_back(
          fmt::format("{} hidden row(s) are read too: {}", hidden.size(), fmt::join(hidden, ", ")));
    if (n_commas_ > 0)
      table_.notes.push_back(
          fmt::format("{} number(s) are text with a decimal comma: read as numbers", n_commas_));
    if (table_.rows.empty() && table_.problems.empty()) refuse("", "at least one row below the header", "");
  }
  void add_row(Row row, int first, int last, int& beside) {
    for (const auto& [column, cell] : row->second) beside += column < first || column > last ? 1 : 0;
    TableRow made = cells_of(row, first, last);
    for (std::size_t i = 0; i < made.cells.size(); ++i) {
      if (!is_plain(made.cells[i]))
        table_.problems.push_back({at(row->first), "column " + column_letters(first + static_cast<int>(i)),
                                   "", "text in UTF-8 without control characters", ""});
      with_point(made.cells[i]);
    }
    if (std::any_of(made.cells.begin(), made.cells.end(), [](const auto& c) { return !c.empty(); }))
      table_.rows.push_back(std::move(made));
  }
  /// A number that was typed as text, with a comma; "45,000" may be either.
  void with_point(std::string& cell) {
    if (!is_comma_number(cell) || cell.size() - cell.find(',') == 4) return;
    cell[cell.find(',')] = '.';
    ++n_commas_;
  }
};

}  // namespace

bool is_archive(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

Table parse_workbook(std::string_view bytes, const std::string& sheet, const std::string& where) {
  WorkbookReader reader(bytes, sheet, where);
  Table table = reader.read();
  if (reader.has_layout()) return table;
  // A first sheet of notes is common. Only sheets that can be read are named.
  std::vector<std::string> better;
  for (const std::string& name : reader.other_sheets()) {
    WorkbookReader other(bytes, name, where);
    if (better.size() < most_sheets_tried && other.read().problems.empty() && other.has_layout())
      better.push_back(name);
  }
  if (better.empty()) return table;
  const std::string why = table.problems.empty() || table.problems[0].remedy.empty()
                              ? "no row of names stands above numbers"
                              : table.problems[0].remedy;
  table.header.clear(), table.rows.clear(), table.header_line = 0;
  table.problems = {
      {where, "", "", "",
       fmt::format("the sheet {} has no table: {}. Other sheets: {}. Write sheet = \"{}\" in the "
                   "rock file, or move that sheet to the front",
                   reader.name(), why, WorkbookReader::names_of(better), better.front())}};
  return table;
}

}  // namespace phy::io
