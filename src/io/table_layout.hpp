// Where in the rows of a file its table begins. Reports and instruments write titles, dates, sizes of the
// specimen above it, and headers in two rows.
//
// The shape of the table is that of most rows that hold values: how far they reach, and how many values they
// have. The header is the first row of names alone that reaches as far, with such rows below it. A row of
// names that an empty line, or one with fewer values, parts from the table is a title, however long. A row
// with as many values as the table's is never above the header: without a header over it there is no layout,
// so nothing measured is lost.
//
// Two rows are one header where the upper has gaps over names of the lower ("UCS (MPa)" over S1, S2, S3).
// They become one name a column: upper, lower, and the unit of the upper behind them: "UCS S1 (MPa)". A cell
// over none, or over one that repeats it, stays as it is.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "io/table_rows.hpp"

namespace phy::io {

struct Layout {
  std::size_t header = 0;  ///< the row, from 0; the upper of two
  bool two_rows = false;
  std::size_t width = 0;   ///< how many columns most rows reach
  std::size_t values = 0;  ///< how many values they have
};

/// How much a row of a header may look like values. `names`: not at all; `numbers`: some of its cells, as
/// rates of loading do.
enum class HeaderRule { names, numbers };

/// `rows`: the first ones of a file, without empty lines; some hundred are enough. Nothing: no row of them
/// can be the header of the others.
std::optional<Layout> find_layout(const std::vector<TableRow>& rows, HeaderRule rule);

/// One header of two rows.
std::vector<std::string> one_header(const TableRow& upper, const TableRow& lower);

}  // namespace phy::io
