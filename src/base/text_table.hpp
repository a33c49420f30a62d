// Text for the terminal, plain ASCII, no wider than it is. A width of 0 or less is no limit: output into a
// file.
#pragma once
#include <string>
#include <utility>
#include <vector>

namespace phy {

/// One column; all cells are text. Numbers stand flush right, names (`left`) flush left.
struct Column {
  std::string head, unit;
  std::vector<std::string> cells;
  bool left = false;

  std::size_t width() const;
};
using Columns = std::vector<Column>;

/// A column whose cells say something of each row.
template <class Rows, class Cell>
Column column_of(std::string head, std::string unit, const Rows& rows, const Cell& cell) {
  Column c{std::move(head), std::move(unit), {}};
  for (const auto& row : rows) c.cells.push_back(cell(row));
  return c;
}

/// Label and columns side by side; where that is too wide, several tables one below the other, each with the
/// label. They part between the groups, and inside a group only if it is too wide by itself. A single column
/// that is too wide for the terminal stands alone beside the label.
std::string text_table(const Column& label, const std::vector<Columns>& groups, int terminal_width);

/// Lines that are too wide are broken at spaces; what continues a line is indented by `indent` spaces.
std::string wrapped(const std::string& text, int terminal_width, std::size_t indent = 0);

/// "a, b and c": `last` stands before the last item, `between` before the others.
std::string joined_text(const std::vector<std::string>& items, const char* between, const char* last);

}  // namespace phy
