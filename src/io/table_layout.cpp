#include "io/table_layout.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/trimmed.hpp"
#include "base/units.hpp"
#include "io/table_cells.hpp"

namespace phy::io {
namespace {

/// What of a row its place in the file depends on.
struct Shape {
  std::size_t reach = 0;   ///< columns up to the last that is not empty
  std::size_t filled = 0;  ///< cells that are not empty
  std::size_t values = 0;  ///< of these, that could be measured
  int line = 0;
};

Shape shape_of(const TableRow& row) {
  Shape shape;
  shape.line = row.line;
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    if (row.cells[i].empty()) continue;
    shape.reach = i + 1, ++shape.filled;
    shape.values += looks_measured(row.cells[i]) ? 1 : 0;
  }
  return shape;
}

/// Reach and values of most rows that hold values; of two as frequent the larger.
std::pair<std::size_t, std::size_t> usual(const std::vector<Shape>& shapes) {
  std::map<std::pair<std::size_t, std::size_t>, int> counts;
  for (const Shape& s : shapes)
    if (s.values > 0) ++counts[{s.reach, s.values}];
  std::pair<std::size_t, std::size_t> best{0, 0};
  int most = 0;
  for (const auto& [kind, n] : counts)
    if (n >= most) best = kind, most = n;
  return best;
}

/// A row of units below the header is no second header.
bool holds_units(const TableRow& row) {
  return std::all_of(row.cells.begin(), row.cells.end(), [](const std::string& cell) {
    return cell.empty() || find_unit(trimmed(cell, "[]() ")).has_value();
  });
}

class Finder {
 public:
  Finder(const std::vector<TableRow>& rows, HeaderRule rule) : rows_(rows), rule_(rule) {
    for (const TableRow& row : rows) shapes_.push_back(shape_of(row));
    std::tie(width_, values_) = usual(shapes_);
    // Two cells at least, where any row has two: a title fills one.
    for (const Shape& s : shapes_) least_ = std::max(least_, std::min<std::size_t>(2, s.filled));
  }

  std::optional<Layout> find() const {
    std::optional<std::size_t> header;
    for (std::size_t i = 0; i < shapes_.size() && width_ > 0; ++i) {
      // Another row of names begins the table anew; what stands above was about the test.
      const bool fresh = i > 0 && (shapes_[i].line > shapes_[i - 1].line + 1 || shapes_[i - 1].values > 0);
      if (is_header(i) && (!header || fresh))
        header = i;
      else if (is_row(i))
        return header ? with_second(*header) : std::optional<Layout>();
    }
    return {};
  }

 private:
  const std::vector<TableRow>& rows_;
  HeaderRule rule_;
  std::vector<Shape> shapes_;
  std::size_t width_ = 0, values_ = 0, least_ = 0;

  bool is_header(std::size_t i) const {
    const Shape& s = shapes_[i];
    const bool named = rule_ == HeaderRule::names ? s.values == 0 : s.values < s.filled;
    return named && s.reach >= width_ && s.filled >= least_;
  }
  // Half of the usual values are enough: rows of real tables have gaps.
  bool is_row(std::size_t i) const { return shapes_[i].reach >= width_ && 2 * shapes_[i].values >= values_; }

  /// Is there a gap in the upper of two rows, or a name that repeats the one before, with a name below it?
  bool spans(std::size_t upper, std::size_t lower) const {
    const auto &above = rows_[upper].cells, &below = rows_[lower].cells;
    bool named = false;
    for (std::size_t i = 0; i < below.size(); ++i) {
      const bool gap = i >= above.size() || above[i].empty() || (i > 0 && above[i] == above[i - 1]);
      if (gap && named && !below[i].empty()) return true;
      named = !gap || (named && !below[i].empty());
    }
    return false;
  }
  /// Does the lower of two rows need the upper? It leaves out what the upper says, repeats itself, or names
  /// what the upper does not.
  bool is_incomplete(std::size_t upper, std::size_t lower) const {
    const auto &above = rows_[upper].cells, &below = rows_[lower].cells;
    std::set<std::string> seen;
    if (above.front().empty()) return true;
    for (std::size_t i = 0; i < below.size(); ++i) {
      const bool said = i < above.size() && !above[i].empty();
      if (said && (below[i].empty() || rows_[lower].merged.contains(i))) return true;
      if (!below[i].empty() && !seen.insert(below[i]).second) return true;
    }
    return false;
  }
  bool are_beside(std::size_t upper, std::size_t lower) const {
    return lower < shapes_.size() && shapes_[lower].line == shapes_[upper].line + 1 &&
           shapes_[upper].values == 0 && shapes_[lower].values == 0 && spans(upper, lower) &&
           !holds_units(rows_[lower]);
  }
  Layout with_second(std::size_t header) const {
    // The row above needs two cells here as well, or a title would become part of every name.
    if (header > 0 && shapes_[header - 1].filled >= 2 && are_beside(header - 1, header) &&
        is_incomplete(header - 1, header))
      return {header - 1, true, width_, values_};
    return {header, are_beside(header, header + 1), width_, values_};
  }
};

/// "UCS (MPa)": the name and "(MPa)", if it ends so.
std::pair<std::string, std::string> name_and_unit(const std::string& cell) {
  const std::size_t open = cell.find_last_of("[(");
  const bool closed = cell.ends_with(']') || cell.ends_with(')');
  if (open == cell.npos || open == 0 || !closed) return {cell, ""};
  return {std::string(trimmed(std::string_view(cell).substr(0, open))), cell.substr(open)};
}

}  // namespace

std::optional<Layout> find_layout(const std::vector<TableRow>& rows, HeaderRule rule) {
  return Finder(rows, rule).find();
}

std::vector<std::string> one_header(const TableRow& upper, const TableRow& lower) {
  std::vector<std::string> header;
  std::string above;  // the name that spans this column
  for (std::size_t i = 0; i < std::max(upper.cells.size(), lower.cells.size()); ++i) {
    const std::string here = i < upper.cells.size() ? upper.cells[i] : "";
    const std::string below = i < lower.cells.size() && !lower.merged.contains(i) ? lower.cells[i] : "";
    if (!here.empty() || below.empty()) above = here;
    // The unit goes behind both names, since readers of headers look for it there.
    const auto [name, unit] = name_and_unit(above);
    if (below.empty() || above.empty() || below == above)
      header.push_back(above.empty() ? below : above);
    else if (unit.empty() || !name_and_unit(below).second.empty())
      header.push_back(name + " " + below);
    else
      header.push_back(name + " " + below + " " + unit);
  }
  return header;
}

}  // namespace phy::io
