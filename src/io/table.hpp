// Tables of other people: text with a delimiter, as spreadsheets and instruments of any country write it.
//
// Read, and said in the notes: a byte-order mark, line ends of Windows, tabs or semicolons with decimal
// commas, columns that only blanks part, lines above the header, headers in two rows. Refused: a header whose
// delimiter could be two things, decimal points and decimal commas in one table, rows with more or fewer
// cells than the header, bytes that are no UTF-8, more columns or longer lines than any table has. Lines that
// begin with # are comments; empty lines are skipped. Workbooks (.xlsx, io/workbook.hpp) and AGS 4 files
// (io/ags.hpp) are tables too; where the header stands, io/table_layout.hpp finds for all of them.
#pragma once
#include <string>
#include <string_view>

#include "io/table_rows.hpp"

namespace phy::io {

/// A table as editors and spreadsheets save it: without the byte-order mark of UTF-8, and where lines end as
/// on old Macs (CR alone) with line breaks.
std::string plain_text(std::string_view text);

/// Text, a workbook or an AGS 4 file; `sheet` names the sheet or the group; "": the first sheet, the group
/// RUCS. Never throws; `where` names the source in problems.
Table parse_table(std::string_view bytes, const std::string& where, const std::string& sheet = {});

}  // namespace phy::io
