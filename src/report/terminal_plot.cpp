#include "report/terminal_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.hpp"

namespace phy::report {
namespace {

constexpr int axis_columns = 8;  // characters for the numbers of the y axis, its line included

/// Two dots by four per character, and the colour of the curve that came last.
class Dots {
 public:
  Dots(int columns, int rows)
      : columns_(columns),
        rows_(rows),
        cells_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows)) {}
  int width() const { return 2 * columns_; }
  int height() const { return 4 * rows_; }

  void put(int x, int y, Color color) {  // from the lower left corner
    if (x < 0 || y < 0 || x >= width() || y >= height()) return;
    const int row = rows_ - 1 - y / 4, line = 3 - y % 4;  // of the character, of the dot from above
    constexpr std::array<std::array<unsigned, 2>, 4> bits = {
        {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}}};
    Cell& cell = cells_[index(row, x / 2)];
    cell.dots |= bits[static_cast<std::size_t>(line)][static_cast<std::size_t>(x % 2)];
    cell.color = color;
  }
  /// One line of text; U+2800 + dots in UTF-8.
  std::string line(int row, bool colored) const {
    std::string text;
    for (int i = 0; i < columns_; ++i) {
      const Cell& cell = cells_[index(row, i)];
      if (cell.dots == 0) {
        text += ' ';
        continue;
      }
      const std::string dots = {'\xE2', static_cast<char>(0xA0U | cell.dots >> 6U),
                                static_cast<char>(0x80U | (cell.dots & 63U))};
      text += colored ? in_color(dots, cell.color) : dots;
    }
    return text;
  }
  static std::string in_color(const std::string& text, Color c) {
    return fmt::format("\033[38;2;{};{};{}m{}\033[0m", c >> 16U & 255U, c >> 8U & 255U, c & 255U, text);
  }

 private:
  struct Cell {
    unsigned dots = 0;
    Color color = 0;
  };
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  int columns_, rows_;
  std::vector<Cell> cells_;
};

double largest(const std::vector<TerminalCurve>& curves, std::vector<double> TerminalCurve::*values) {
  double most = 0.0;
  for (const TerminalCurve& c : curves)
    for (const double v : c.*values)
      if (std::isfinite(v)) most = std::max(most, v);
  return most;
}

/// What lies outside the picture is drawn to its nearest edge: the first stresses of a test can be a billion
/// times below the axis.
void draw(Dots& dots, const TerminalCurve& c, double x_end, double y_end) {
  const auto at = [](double v, double end, int n) {
    return static_cast<int>(std::lround(std::clamp(v / end * (n - 1), -1.0, static_cast<double>(n))));
  };
  const auto known = [&](std::size_t i) { return std::isfinite(c.x[i]) && std::isfinite(c.y[i]); };
  for (std::size_t i = 1; i < c.x.size(); ++i) {
    if (!known(i - 1) || !known(i)) continue;
    const int x0 = at(c.x[i - 1], x_end, dots.width()), x1 = at(c.x[i], x_end, dots.width());
    const int y0 = at(c.y[i - 1], y_end, dots.height()), y1 = at(c.y[i], y_end, dots.height());
    const int n = std::max({1, std::abs(x1 - x0), std::abs(y1 - y0)});
    for (int k = 0; k <= n; ++k) dots.put(x0 + (x1 - x0) * k / n, y0 + (y1 - y0) * k / n, c.color);
  }
}

/// The line below the axis: the end of x, then the names of the curves as long as there is room.
std::string legend(const std::vector<TerminalCurve>& curves, const std::string& x, int columns,
                   bool colored) {
  std::string text = fmt::format("{:>{}} 0 ... {}", "", axis_columns - 2, x);
  int used = static_cast<int>(text.size());  // ASCII so far
  for (const TerminalCurve& c : curves) {
    const int length = static_cast<int>(c.label.size());
    if (used + 2 + length > columns) break;
    text += "  " + (colored ? Dots::in_color(c.label, c.color) : c.label);
    used += 2 + length;
  }
  return text;
}

}  // namespace

std::vector<std::string> terminal_plot(const std::vector<TerminalCurve>& curves, const std::string& x_unit,
                                       const std::string& y_unit, int columns, int rows, bool colored) {
  PHY_CHECK(rows >= 4 && columns >= 30, "room for a plot");
  const double x_end = largest(curves, &TerminalCurve::x), y_end = largest(curves, &TerminalCurve::y);
  const int inner = rows - 2;
  Dots dots(columns - axis_columns, inner);
  if (x_end > 0.0 && y_end > 0.0)
    for (const TerminalCurve& c : curves) draw(dots, c, x_end, y_end);
  std::vector<std::string> lines;
  for (int row = 0; row < inner; ++row) {
    const std::string number = row == 0           ? fmt::format("{:.4g}", y_end)
                               : row == 1         ? y_unit
                               : row == inner - 1 ? "0"
                                                  : "";
    lines.push_back(fmt::format("{:>{}}│{}", number, axis_columns - 1, dots.line(row, colored)));
  }
  std::string axis = fmt::format("{:>{}}└", "", axis_columns - 1);
  for (int i = axis_columns; i < columns; ++i) axis += "─";
  lines.push_back(axis);
  lines.push_back(legend(curves, fmt::format("{:.3g} {}", x_end, x_unit), columns, colored));
  return lines;
}

}  // namespace phy::report
