#include "io/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "base/quote.hpp"
#include "base/trimmed.hpp"
#include "io/ags.hpp"
#include "io/repeated.hpp"
#include "io/table_cells.hpp"
#include "io/table_layout.hpp"
#include "io/workbook.hpp"

namespace phy::io {
namespace {

constexpr std::size_t most_line_bytes = 1U << 16U;
constexpr int most_breaks = 20;                                                 // in the cells of a line
constexpr std::size_t most_sample_lines = 1000, most_sample_bytes = 1U << 18U;  // that show the layout

constexpr const char* save_as_utf8 = "save it anew as UTF-8 (in a spreadsheet: \"CSV UTF-8\")";
constexpr const char* no_blanks = "separated by blanks: use commas, semicolons or tabs";

struct Line {
  std::string_view text;
  int number = 0;
};

/// Where a line ends: spreadsheets keep the line breaks of a cell, in quotes.
std::size_t end_of_line(std::string_view text) {
  constexpr std::string_view around = ",;\t \r\n";
  const std::size_t end = std::min(text.find('\n'), text.size());
  if (text.substr(0, end).find('"') == text.npos) return end;
  bool quoted = false;
  int breaks = 0;
  std::size_t i = 0;
  for (; i < std::min(text.size(), most_line_bytes) && breaks < most_breaks; ++i) {
    if (text[i] == '\n' && !quoted) return i;
    breaks += text[i] == '\n' ? 1 : 0;
    if (text[i] != '"') continue;
    // A quote in the middle of a cell is a sign of inches or seconds, and opens nothing.
    if (!quoted)
      quoted = i == 0 || around.substr(0, 3).find(text[i - 1]) != around.npos;
    else if (i + 1 < text.size() && text[i + 1] == '"')
      ++i;
    else
      quoted = i + 1 < text.size() && around.find(text[i + 1]) == around.npos;
  }
  return quoted ? end : std::min(text.find('\n', i), text.size());  // quotes that nothing closes are none
}

/// Lines that are no comment and not empty; `take` says whether to go on.
template <class Take>
void each_line(std::string_view text, const Take& take) {
  for (int number = 1; !text.empty();) {
    const bool comment = text[std::min(text.find_first_not_of(" \t"), text.size() - 1)] == '#';
    const std::size_t end = comment ? std::min(text.find('\n'), text.size()) : end_of_line(text);
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!comment && !trimmed(line).empty() && !take(Line{line, number})) return;
    number += 1 + static_cast<int>(std::count(line.begin(), line.end(), '\n'));
  }
}

/// The text of a line whose cells have line breaks.
std::string without_breaks(std::string_view line) {
  std::string text(line);
  for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at)) {
    const bool windows = at > 0 && text[at - 1] == '\r';
    text.replace(windows ? at - 1 : at, windows ? 2 : 1, " ");
  }
  return text;
}
bool has_breaks(const Line& line) { return line.text.find('\n') != line.text.npos; }
bool split_line(const Line& line, Separator separator, std::vector<std::string>& cells) {
  return has_breaks(line) ? split_cells(without_breaks(line.text), separator, cells)
                          : split_cells(line.text, separator, cells);
}

/// What spreadsheets write for each other: "sep=;".
bool names_separator(std::string_view line) {
  line = trimmed(line);
  return line.size() == 5 && line.starts_with("sep=");
}

/// Text and tabs; a line may end as in Windows.
bool is_text(const Line& whole) {
  std::string line = without_breaks(whole.text);
  if (line.ends_with('\r')) line.pop_back();
  std::replace(line.begin(), line.end(), '\t', ' ');
  return is_plain(line);
}
/// The first byte of a line that is none of UTF-8, with the letter that it is in Latin-1; "" if there is
/// none.
std::string foreign_byte(std::string_view line) {
  while (!line.empty()) {
    const std::size_t n = utf8_length(line);
    const unsigned byte = static_cast<unsigned char>(line.front());
    line.remove_prefix(std::max<std::size_t>(1, n));
    if (n > 0) continue;
    const std::string letter = {static_cast<char>(0xC0U | byte >> 6U), static_cast<char>(byte & 0xBFU)};
    return fmt::format("byte 0x{:02X}", byte) +
           (byte >= 0xA0 ? fmt::format(", \"{}\" in Latin-1", letter) : "");
  }
  return "";
}

bool is_point_number(std::string cell) {
  // Points become commas, and commas something that no number holds: one rule serves both.
  std::replace(cell.begin(), cell.end(), ',', ';');
  std::replace(cell.begin(), cell.end(), '.', ',');
  return is_comma_number(cell);
}

/// How the cells of a file are parted, and where its header stands.
struct TextLayout {
  std::vector<Separator> separators;  ///< more than one: it could be any
  int header_line = 0;
  bool two_rows = false;
};

/// The layout of the first lines of a text.
class LayoutReader {
 public:
  explicit LayoutReader(const std::vector<Line>& sample) : sample_(sample) {}

  TextLayout read() const {
    // A header of names alone goes before one with numbers in it, which a row of values may be as well.
    for (const HeaderRule rule : {HeaderRule::names, HeaderRule::numbers}) {
      std::vector<Fit> fits;
      for (const Separator s : {Separator::comma, Separator::semicolon, Separator::tab})
        if (const auto layout = fit(s, rule); layout && layout->width >= 2) fits.push_back({s, *layout});
      // Blanks stand in names and remarks: only where nothing else parts a table do they part it.
      if (fits.empty())
        if (const auto blanks = fit_blanks(rule)) fits.push_back(*blanks);
      if (!fits.empty()) return best_of(fits);
    }
    return by_header();
  }

  /// Lines of several values without any other separator than blanks.
  bool has_blanks_alone() const {
    return std::any_of(sample_.begin(), sample_.end(), [](const Line& line) {
      const TableRow row = row_of(line, Separator::blanks);
      return line.text.find_first_of(",;\t") == line.text.npos && row.cells.size() > 1 &&
             std::any_of(row.cells.begin(), row.cells.end(), looks_measured);
    });
  }

 private:
  struct Fit {
    Separator separator;
    Layout layout;
  };
  const std::vector<Line>& sample_;

  static TableRow row_of(const Line& line, Separator separator) {
    TableRow row{line.number, {}};
    split_line(line, separator, row.cells);
    return row;
  }
  std::vector<TableRow> rows(Separator separator) const {
    std::vector<TableRow> all;
    for (const Line& line : sample_) all.push_back(row_of(line, separator));
    return all;
  }
  std::optional<Layout> fit(Separator separator, HeaderRule rule) const {
    return find_layout(rows(separator), rule);
  }
  /// The one whose cells are values most often, and what else parts the same header.
  TextLayout best_of(const std::vector<Fit>& fits) const {
    const Fit& best = *std::max_element(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) {
      return a.layout.values * b.layout.width < b.layout.values * a.layout.width;
    });
    TextLayout found{{}, sample_[best.layout.header].number, best.layout.two_rows};
    for (const Fit& fit : fits)
      if (fit.layout.header == best.layout.header) found.separators.push_back(fit.separator);
    return found;
  }
  /// Between blanks no cell can be empty: every row has as many cells as the header. Where only most have,
  /// runs of blanks part columns all the same; single ones may as well part words.
  std::optional<Fit> fit_blanks(HeaderRule rule) const {
    std::optional<Fit> most;
    for (const Separator s : {Separator::runs, Separator::blanks}) {
      const std::optional<Layout> layout = fit(s, rule);
      if (!layout || layout->width < 2) continue;
      const std::vector<TableRow> all = rows(s);
      const auto has_all = [&](const TableRow& row) { return row.cells.size() == layout->width; };
      const auto header = all.begin() + static_cast<std::ptrdiff_t>(layout->header);
      const bool values = s == Separator::runs || 2 * layout->values >= layout->width;
      if (std::all_of(header, all.end(), has_all) && values) return Fit{s, *layout};
      if (s == Separator::runs && has_all(*header)) most = Fit{s, *layout};
    }
    return most;
  }
  /// No header agrees with rows: that is told of the first line that has several cells.
  TextLayout by_header() const {
    const auto several = std::find_if(sample_.begin(), sample_.end(),
                                      [](const Line& line) { return !separators_in(line).empty(); });
    const Line& header = several == sample_.end() ? sample_.front() : *several;
    TextLayout found{separators_in(header), header.number};
    if (found.separators.empty()) found.separators = {Separator::comma};  // a single column needs none
    return found;
  }
  static std::vector<Separator> separators_in(const Line& line) {
    std::vector<Separator> found;
    for (const Separator s : {Separator::comma, Separator::semicolon, Separator::tab})
      if (row_of(line, s).cells.size() > 1) found.push_back(s);
    return found;
  }
};

class TableReader {
 public:
  TableReader(std::string_view plain, std::string where) : text_(plain), where_(std::move(where)) {
    table_.where = where_;
  }

  Table read() {
    if (read_header()) {
      each_line(text_, [&](const Line& line) {
        if (line.number > last_header_) take_row(line);
        if (line.number >= table_.header_line && has_breaks(line) && breaks_++ == 0)
          table_.notes.push_back(fmt::format("line {}: a cell goes over several lines", line.number));
        return true;
      });
      for (const RepeatedProblem* p : {&encoding_, &quotes_, &counts_}) p->tell(table_.problems);
      if (table_.rows.empty() && table_.problems.empty())
        table_.problems.push_back({where_, "", "", "at least one row below the header", ""});
      settle_decimals();
    }
    return std::move(table_);
  }

 private:
  std::string_view text_;
  std::string where_;
  Table table_;
  Separator separator_ = Separator::comma;
  int last_header_ = 0;  // its line, the lower one of two
  int breaks_ = 0;       // lines whose cells have line breaks
  RepeatedProblem encoding_, quotes_, counts_;

  std::string at(int line) const { return fmt::format("{}:{}", where_, line); }
  bool refuse(Problem p) {
    table_.problems.push_back(std::move(p));
    return false;
  }
  bool is_blank() const { return separator_ == Separator::runs || separator_ == Separator::blanks; }

  /// The first lines; false: there are none, or one is longer than any.
  bool take_sample(std::vector<Line>& sample) {
    std::size_t n_bytes = 0;
    bool good = true;
    each_line(text_, [&](const Line& line) {
      if (line.text.size() > most_line_bytes)
        good = refuse({at(line.number), fmt::format("{} characters", line.text.size()), "",
                       fmt::format("at most {} in a line", most_line_bytes), "is this a table?"});
      else if (sample.size() < most_sample_lines && n_bytes < most_sample_bytes &&
               !names_separator(line.text) && line.text.find_first_not_of(" \t\r,;") != line.text.npos)
        n_bytes += line.text.size(), sample.push_back(line);
      return good;
    });
    if (good && sample.empty())
      refuse({where_, "", "", "a header line and at least one row", "the file is empty"});
    return good && !sample.empty();
  }

  bool read_header() {
    std::vector<Line> sample;
    if (!take_sample(sample)) return false;
    const LayoutReader reader(sample);
    const TextLayout layout = reader.read();
    // Of several that fit the same header one has to be taken; the problem below says that it was a choice.
    separator_ = layout.separators.back();
    auto header = std::find_if(sample.begin(), sample.end(),
                               [&](const Line& line) { return line.number == layout.header_line; });
    tell_above(sample, header - sample.begin());
    if (!is_text(*header))
      return refuse({at(header->number), foreign_byte(header->text), "",
                     "text in UTF-8 without control characters", save_as_utf8});
    if (layout.separators.size() > 1)
      refuse({at(header->number), "", std::string(trimmed(without_breaks(header->text))),
              "one delimiter: comma, semicolon or tab",
              "the header holds two of them; quote names that contain one"});
    const TableRow upper = names(*header), lower = layout.two_rows ? names(*++header) : TableRow{};
    table_.header_line = upper.line, last_header_ = header->number;
    table_.header = layout.two_rows ? one_header(upper, lower) : upper.cells;
    if (layout.two_rows)
      table_.notes.push_back(fmt::format("the header has two rows, lines {} and {}: {}", upper.line,
                                         lower.line, fmt::join(table_.header, ", ")));
    return has_columns(reader);
  }
  TableRow names(const Line& line) const {
    TableRow row{line.number, {}};
    split_line(line, separator_, row.cells);
    for (std::string& cell : row.cells) cell = plain_name(cell);
    return row;
  }
  void tell_above(const std::vector<Line>& sample, std::ptrdiff_t n) {
    if (n == 1)
      table_.notes.push_back(fmt::format("line {}, a title, is passed over", sample[0].number));
    else if (n > 1)
      table_.notes.push_back(fmt::format("lines {} to {}, above the header, are passed over",
                                         sample[0].number, sample[static_cast<std::size_t>(n) - 1].number));
  }
  bool has_columns(const LayoutReader& reader) {
    if (std::all_of(table_.header.begin(), table_.header.end(), looks_measured)) {
      refuse({at(table_.header_line), "", "", "a line of names above the first row",
              "lines that begin with # are comments, and name nothing"});
    } else if (table_.header.size() == 1 && reader.has_blanks_alone()) {
      refuse({at(table_.header_line), "", table_.header[0], "a separator between cells", no_blanks});
    } else if (table_.header.size() > most_table_columns) {
      refuse({at(table_.header_line), fmt::format("{} columns", table_.header.size()), "",
              fmt::format("at most {}", most_table_columns), "leave those out that hold no tests"});
    } else {
      return true;
    }
    table_.header.clear(), table_.header_line = 0;
    return false;
  }

  void take_row(const Line& line) {
    if (line.text.find_first_not_of(std::string(" \t\r") + delimiter()) == line.text.npos)
      return;  // blank in every cell
    if (!is_text(line)) {
      encoding_.add({at(line.number), foreign_byte(line.text), "", "text in UTF-8 without control characters",
                     save_as_utf8});
      return;
    }
    TableRow row{line.number, {}};
    if (!split_line(line, separator_, row.cells)) {
      quotes_.add({at(line.number), "", std::string(trimmed(line.text)), "closed quotes", ""});
    } else if (fit_width(row.cells); row.cells.size() != table_.header.size()) {
      // The usual cause of too many cells: 1,5 read as two.
      const bool commas = separator_ == Separator::comma && row.cells.size() > table_.header.size();
      counts_.add({at(line.number), n_cells(row.cells.size()), "",
                   n_cells(table_.header.size()) + ", as in the header",
                   is_blank() || looks_like_several(row.cells) ? no_blanks
                   : commas ? "decimal commas need semicolons between cells; text with commas needs quotes"
                            : ""});
    } else {
      for (std::string& cell : row.cells) cell = plain_cell(cell);
      table_.rows.push_back(std::move(row));
    }
  }
  /// One cell such as "0 80".
  static bool looks_like_several(const std::vector<std::string>& cells) {
    return cells.size() == 1 && cells[0].find(' ') != cells[0].npos && looks_measured(cells[0]);
  }
  /// Loggers end lines with a delimiter: cells that are empty, or have no header, may be left out.
  void fit_width(std::vector<std::string>& cells) const {
    while (cells.size() > table_.header.size() && cells.back().empty()) cells.pop_back();
    while (cells.size() < table_.header.size() && table_.header[cells.size()].empty() && !is_blank())
      cells.emplace_back();
  }
  static std::string n_cells(std::size_t n) { return fmt::format("{} cell{}", n, n == 1 ? "" : "s"); }
  std::string delimiter() const {
    return separator_ == Separator::comma ? "," : separator_ == Separator::semicolon ? ";" : "";
  }

  /// Turns decimal commas into points, where no comma parts cells.
  void settle_decimals() {
    // With commas between cells "1,5" are two cells: the wrong number of cells has shown it.
    if (separator_ == Separator::comma) return;
    int comma_line = 0, point_line = 0;
    for (TableRow& row : table_.rows)
      for (std::string& cell : row.cells) {
        if (comma_line == 0 && is_comma_number(cell)) comma_line = row.line;
        if (point_line == 0 && is_point_number(cell)) point_line = row.line;
        if (is_comma_number(cell)) cell[cell.find(',')] = '.';
      }
    // One file with both is ambiguous: 1.234 may be a thousand.
    if (comma_line != 0 && point_line != 0)
      table_.problems.push_back(
          {at(std::max(comma_line, point_line)), "", "", "decimal commas or decimal points, not both",
           "line " + std::to_string(std::min(comma_line, point_line)) + " writes the other"});
    const std::string between = is_blank()                           ? "blanks"
                                : separator_ == Separator::semicolon ? "semicolons"
                                                                     : "tabs";
    table_.notes.push_back("cells are separated by " + between +
                           (comma_line != 0 ? ", with decimal commas" : ""));
  }
};

/// How the text was saved.
std::vector<std::string> notes_on(std::string_view bytes) {
  std::vector<std::string> notes;
  if (bytes.starts_with("\xEF\xBB\xBF")) notes.emplace_back("a byte-order mark at the beginning was skipped");
  if (bytes.find("\r\n") != bytes.npos) notes.emplace_back("the file has line ends of Windows");
  if (bytes.find('\n') == bytes.npos && bytes.find('\r') != bytes.npos)
    notes.emplace_back("the file has line ends of old Macs");
  return notes;
}

Table refused(const std::string& where, Problem problem) {
  Table none;
  none.where = where;
  none.problems.push_back(std::move(problem));
  return none;
}

}  // namespace

std::string plain_text(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string plain(text);
  if (text.find('\n') == text.npos) std::replace(plain.begin(), plain.end(), '\r', '\n');
  return plain;
}

Table parse_table(std::string_view bytes, const std::string& where, const std::string& sheet) {
  if (is_archive(bytes)) return parse_workbook(bytes, sheet, where);
  if (bytes.starts_with("\xD0\xCF\x11\xE0"))
    return refused(where, {where, "", "a workbook of before 2007 (.xls), or one with a password",
                           "a workbook (.xlsx) or CSV", "save it anew in one of these formats"});
  // Spreadsheets write this as "Unicode text"; every second byte is zero, so no line could be read.
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    return refused(where, {where, "", "UTF-16", "text in UTF-8", save_as_utf8});
  const std::string plain = plain_text(bytes);
  const bool ags = is_ags(plain);
  if (!ags && !sheet.empty())
    return refused(where, {where, "sheet", sheet, "a workbook (.xlsx) or an AGS 4 file",
                           "the table is text: leave sheet out"});
  Table table = ags ? parse_ags(plain, sheet, where) : TableReader(plain, where).read();
  const std::vector<std::string> notes = notes_on(bytes);
  table.notes.insert(table.notes.begin(), notes.begin(), notes.end());
  return table;
}

}  // namespace phy::io
