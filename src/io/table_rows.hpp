// What is read of a table, whichever file it came from (io/table.hpp).
#pragma once
#include <set>
#include <string>
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

}  // namespace phy::io
