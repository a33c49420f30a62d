// Tables of other people: text with a delimiter, as spreadsheets and instruments of any country write it.
//
// Read, and said in the notes: a byte-order mark, line ends of Windows, tabs or semicolons with decimal
// commas, columns that only blanks part, lines above the header, headers in two rows. Refused: a header whose
// delimiter could be two things, decimal points and decimal commas in one table, rows with more or fewer
// cells than the header, bytes that are no UTF-8, more columns or longer lines than any table has. Lines that
// begin with # are comments; empty lines are skipped. Workbooks (.xlsx, io/workbook.hpp) and AGS 4 files
// (io/ags.hpp) are tables too; where the header stands, io/table_layout.hpp finds for all of them.
#pragma once
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/check.hpp"

namespace phy::io {

constexpr std::size_t most_table_columns = 256;  ///< of text and of sheets

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

/// Text, a workbook or an AGS 4 file; `sheet` names the sheet or the group; "": the first sheet, the group
/// RUCS. Never throws; `where` names the source in problems.
Table parse_table(std::string_view bytes, const std::string& where, const std::string& sheet = {});

}  // namespace phy::io
