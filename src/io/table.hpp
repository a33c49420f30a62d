// Tables of other people: text with a delimiter, as spreadsheets of any country write it.
//
// Accepted: a byte-order mark, line ends of Windows, tabs or semicolons with decimal commas, a title above
// the header (all mentioned in the notes), rows without a value. Refused: a header whose delimiter could be
// two things, decimal points and decimal commas in one table, rows with more or fewer cells than the header,
// UTF-16. Lines that begin with # are comments; empty lines are skipped. Workbooks (.xlsx) are tables too.
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/check.hpp"

namespace phy::io {

struct TableRow {
  int line = 0;                       ///< in the file, from 1
  std::vector<std::string> cells;     ///< without quotes and outer blanks; decimal points
  std::set<std::size_t> merged = {};  ///< cells that are one with that of the row above
};

struct Table {
  std::string where;  ///< for messages: the file, of a workbook with its sheet
  int header_line = 0;
  std::vector<std::string> header;
  std::vector<TableRow> rows;      ///< every row as long as the header
  std::vector<std::string> notes;  ///< how the text was understood
  std::vector<Problem> problems;   ///< everything that could not be; the rest was read nevertheless
};

/// A table as editors and spreadsheets save it: without the byte-order mark of UTF-8, and where lines end as
/// on old Macs (CR alone) with line breaks.
std::string plain_text(std::string_view text);

/// Digits, one comma, digits: a number of half of Europe.
bool is_comma_number(const std::string& cell);

/// Text, or a workbook (io/workbook.hpp), of which `sheet` names the sheet; "": the first. Never throws;
/// `where` names the source in problems.
Table parse_table(std::string_view bytes, const std::string& where, const std::string& sheet = {});

}  // namespace phy::io
