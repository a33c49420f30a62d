#include "io/table.hpp"

#include <algorithm>
#include <cctype>

#include "base/quote.hpp"
#include "base/trimmed.hpp"
#include "io/workbook.hpp"

namespace phy::io {
namespace {

/// Cells of a line; a quoted cell may hold the delimiter, and "" for a quote. False: quotes left open.
bool split(std::string_view line, char delimiter, std::vector<std::string>& cells) {
  std::string cell;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    // A doubled quote inside quotes is one quote.
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
      cell += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == delimiter && !quoted)
      cells.emplace_back(trimmed(cell)), cell.clear();
    else
      cell += line[i];
  }
  cells.emplace_back(trimmed(cell));
  return !quoted;
}

/// Text and tabs; a line may end as in Windows.
bool is_text(std::string line) {
  if (line.ends_with('\r')) line.pop_back();
  std::replace(line.begin(), line.end(), '\t', ' ');
  return is_plain(line);
}

bool has_outside_quotes(std::string_view line, char wanted) {
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == wanted && !quoted) return true;
  }
  return false;
}

bool is_point_number(std::string cell) {
  // Points become commas, and commas something that no number holds: one rule serves both.
  std::replace(cell.begin(), cell.end(), ',', ';');
  std::replace(cell.begin(), cell.end(), '.', ',');
  return is_comma_number(cell);
}

class TableReader {
 public:
  TableReader(std::string_view text, std::string where) : text_(text), where_(std::move(where)) {
    table_.where = where_;
  }

  Table read() {
    // Spreadsheets write this as "Unicode text"; every second byte is zero, so no line could be read.
    if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF")) {
      table_.problems.push_back(
          {where_, "", "UTF-16", "text in UTF-8", "save it anew as UTF-8 (in a spreadsheet: \"CSV UTF-8\")"});
      return std::move(table_);
    }
    if (text_.starts_with("\xEF\xBB\xBF"))
      table_.notes.emplace_back("a byte-order mark at the beginning was skipped");
    if (text_.find("\r\n") != text_.npos) table_.notes.emplace_back("line ends are those of Windows");
    if (text_.find('\n') == text_.npos && text_.find('\r') != text_.npos)
      table_.notes.emplace_back("line ends are those of old Macs");
    plain_ = plain_text(text_);
    text_ = plain_;
    for (int number = 1; !text_.empty(); ++number) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      take_line(text_.substr(0, end), number);
      text_.remove_prefix(std::min(end + 1, text_.size()));
    }
    if (table_.header_line == 0 && table_.problems.empty())
      table_.problems.push_back({where_, "", "", "a header line and at least one row", "the file is empty"});
    else if (table_.rows.empty() && table_.problems.empty())
      table_.problems.push_back({where_, "", "", "at least one row below the header", ""});
    settle_decimals();
    return std::move(table_);
  }

 private:
  std::string_view text_;
  std::string plain_;
  std::string where_;
  Table table_;
  char delimiter_ = 0;

  std::string at(int line) const { return where_ + ":" + std::to_string(line); }
  void take_line(std::string_view line, int number) {
    const std::string text(trimmed(line));
    if (text.empty() || text.front() == '#') return;
    if (table_.header_line == 0 && is_above_header(text, number)) return;
    if (!is_text(std::string(line))) {
      table_.problems.push_back({at(number), "", "", "text in UTF-8 without control characters",
                                 "save it anew as UTF-8 (in a spreadsheet: \"CSV UTF-8\")"});
      if (table_.header_line == 0) text_ = {};  // rows would be compared with a wrong header
      return;
    }
    if (table_.header_line == 0) {
      table_.header_line = number;
      choose_delimiter(line);
      split(line, delimiter_, table_.header);
      return;
    }
    if (line.find_first_not_of(std::string(" \t\r") + delimiter_) == line.npos)
      return;  // blank in every cell
    TableRow row{number, {}};
    if (!split(line, delimiter_, row.cells)) {
      table_.problems.push_back(
          {at(number), "", std::string(trimmed(line.substr(0, 60))), "closed quotes", ""});
    } else if (row.cells.size() != table_.header.size()) {
      // The usual cause of too many cells: 1,5 read as two.
      const bool commas = delimiter_ == ',' && row.cells.size() > table_.header.size();
      table_.problems.push_back(
          {at(number), "", std::to_string(row.cells.size()) + " cells",
           std::to_string(table_.header.size()) + " cells, as in the header",
           commas ? "decimal commas need semicolons between cells; text with commas needs quotes" : ""});
    } else {
      table_.rows.push_back(std::move(row));
    }
  }
  /// "sep=;", which spreadsheets write for each other, and a title: a line without a delimiter above one that
  /// has several.
  bool is_above_header(const std::string& line, int number) {
    if (line.size() == 5 && line.starts_with("sep=")) return true;
    const auto n_delimiters = [](std::string_view s) {
      return std::count_if(s.begin(), s.end(), [](char c) { return c == ',' || c == ';' || c == '\t'; });
    };
    const std::size_t from = std::min(text_.find('\n'), text_.size());
    std::string_view rest = text_.substr(std::min(from + 1, text_.size()));
    while (!rest.empty() && trimmed(rest.substr(0, rest.find('\n'))).empty())
      rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
    if (n_delimiters(line) > 0 || n_delimiters(rest.substr(0, rest.find('\n'))) < 2) return false;
    table_.notes.push_back("line " + std::to_string(number) + ", a title, is passed over");
    return true;
  }
  void choose_delimiter(std::string_view header) {
    std::string found;
    for (const char c : {',', ';', '\t'})
      if (has_outside_quotes(header, c)) found += c;
    // A single column needs no delimiter. With several candidates the last is assumed, and reported.
    delimiter_ = found.empty() ? ',' : found.back();
    if (found.size() > 1)
      table_.problems.push_back({at(table_.header_line), "", std::string(trimmed(header.substr(0, 80))),
                                 "one delimiter: comma, semicolon or tab",
                                 "the header holds two of them; quote names that contain one"});
  }
  /// Turns decimal commas into points, where semicolons or tabs leave no doubt.
  void settle_decimals() {
    // With commas between cells "1,5" are two cells: the wrong number of cells has shown it.
    if (delimiter_ == ',') return;
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
    const std::string between = delimiter_ == ';' ? "semicolons" : "tabs";
    table_.notes.push_back("cells are separated by " + between +
                           (comma_line != 0 ? ", with decimal commas" : ""));
  }
};

}  // namespace

bool is_comma_number(const std::string& cell) {
  // At least a digit on either side; a list such as "1,2,3" is no number.
  const std::size_t comma = cell.find(',');
  if (comma == 0 || comma == cell.npos || comma + 1 == cell.size()) return false;
  return std::all_of(cell.begin(), cell.end(),
                     [](char c) {
                       return std::isdigit(static_cast<unsigned char>(c)) != 0 || c == ',' || c == '-' ||
                              c == '+' || c == 'e' || c == 'E';
                     }) &&
         cell.find(',', comma + 1) == cell.npos;
}

std::string plain_text(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  std::string plain(text);
  if (text.find('\n') == text.npos) std::replace(plain.begin(), plain.end(), '\r', '\n');
  return plain;
}

Table parse_table(std::string_view bytes, const std::string& where, const std::string& sheet) {
  if (is_archive(bytes)) return parse_workbook(bytes, sheet, where);
  if (!bytes.starts_with("\xD0\xCF\x11\xE0") && sheet.empty()) return TableReader(bytes, where).read();
  Table none;
  none.where = where;
  if (sheet.empty())
    none.problems.push_back({where, "", "a workbook of before 2007 (.xls), or one with a password",
                             "a workbook (.xlsx) or CSV", "save it anew in one of these formats"});
  else
    none.problems.push_back(
        {where, "sheet", sheet, "a workbook (.xlsx)", "the table is text: leave sheet out"});
  return none;
}

}  // namespace phy::io
