#include "report/terminal_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/check.hpp"
#include "base/quote.hpp"
#include "report/palette.hpp"

namespace phy::report {
namespace {

constexpr int axis_columns = 8;  // characters for the numbers of the y axis, its line included

/// Characters of a text in UTF-8.
int length_of(const std::string& text) {
  return static_cast<int>(std::count_if(
      // Bytes 10xxxxxx continue a letter.
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

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
    Cell& cell = cells_[index(rows_ - 1 - y / 4, x / 2)];
    // A terminal has one colour per character, so that the last curve wins.
    cell.dots |= bit(x, y), cell.color = color;
  }
  /// Characters in place of dots, about a dot.
  void write(int x, int y, const std::string& text, Color color) {
    const int row = std::clamp(rows_ - 1 - y / 4, 0, rows_ - 1), length = length_of(text);
    // A label at the edge is moved inwards, never cut.
    int column = std::clamp(x / 2 - length / 2, 0, std::max(0, columns_ - length));
    for (std::size_t i = 0; i < text.size() && column < columns_; ++column) {
      // At least one byte: damaged UTF-8 must not make an endless loop.
      const std::size_t n = std::max<std::size_t>(1, utf8_length(std::string_view(text).substr(i)));
      cells_[index(row, column)] = {0, color, text.substr(i, n)};
      i += n;
    }
  }
  static unsigned bit(int x, int y) {  // of a character
    // Unicode numbers the dots of Braille column by column, the lowest row behind: 7 and 8.
    constexpr std::array<std::array<unsigned, 2>, 4> bits = {
        {{0x40, 0x80}, {0x04, 0x20}, {0x02, 0x10}, {0x01, 0x08}}};
    return bits[static_cast<std::size_t>(y % 4)][static_cast<std::size_t>(x % 2)];
  }
  /// U+2800 + dots in UTF-8.
  static std::string character(unsigned dots) {
    return {'\xE2', static_cast<char>(0xA0U | dots >> 6U), static_cast<char>(0x80U | (dots & 63U))};
  }
  std::string line(int row, bool colored) const {
    std::string text;
    for (int i = 0; i < columns_; ++i) {
      const Cell& cell = cells_[index(row, i)];
      // A blank and no empty Braille pattern, which some fonts draw as circles.
      if (cell.dots == 0 && cell.letter.empty()) {
        text += ' ';
        continue;
      }
      const std::string shown = cell.letter.empty() ? character(cell.dots) : cell.letter;
      text += colored ? in_color(shown, cell.color) : shown;
    }
    return text;
  }
  static std::string in_color(const std::string& text, Color c) {
    // 24-bit colours: the sixteen of a terminal are too few for an order of angles.
    return fmt::format("\033[38;2;{};{};{}m{}\033[0m", c >> 16U & 255U, c >> 8U & 255U, c & 255U, text);
  }

 private:
  struct Cell {
    unsigned dots = 0;
    Color color = 0;
    std::string letter = {};  ///< in place of the dots
  };
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column);
  }
  int columns_, rows_;
  std::vector<Cell> cells_;
};

/// From values to dots. What lies outside the picture is drawn to its nearest edge: the first stresses of a
/// test can be a billion times below the axis.
class Places {
 public:
  Places(const Axis& axis, int n) : n_(n), logarithmic_(axis.logarithmic) {
    low_ = scaled(axis.low), span_ = scaled(axis.high) - low_;
  }
  int of(double v) const {
    const double part = span_ > 0.0 ? (scaled(v) - low_) / span_ : 0.0;
    // One dot outside, which put() leaves out; farther would overflow the int.
    return static_cast<int>(std::lround(std::clamp(part * (n_ - 1), -1.0, static_cast<double>(n_))));
  }

 private:
  double scaled(double v) const { return logarithmic_ ? std::log10(v) : v; }
  int n_;
  bool logarithmic_;
  double low_ = 0.0, span_ = 0.0;
};

/// Which dots of a box are seen: patterns tell neighbours apart without colours.
bool is_inked(std::size_t number, int x, int y) {
  constexpr std::size_t patterns = 4;
  switch (number % patterns) {
    case 0: return true;
    case 1: return (x + y) % 2 == 0;
    case 2: return x % 2 == 0;
    default: return y % 2 == 0;
  }
}

/// How a series looks where it is seen alone; points are letters, by their order in the key.
std::string sign_of(const Series& s, const std::vector<const Series*>& key) {
  // Symbols that differ most without colour come first.
  constexpr std::string_view letters = "ox+*#%&@";
  const auto before =
      std::find_if(key.begin(), key.end(), [&](const Series* k) { return k->name == s.name; });
  const auto n = std::count_if(key.begin(), before, [](const Series* k) { return k->mark == Mark::points; });
  unsigned dots = 0;
  for (int i = 0; i < 8; ++i)
    if (is_inked(s.number, i % 2, i / 2)) dots |= Dots::bit(i % 2, i / 2);
  switch (s.mark) {
    case Mark::points: return {letters[static_cast<std::size_t>(n) % letters.size()]};
    case Mark::boxes: return Dots::character(dots);
    case Mark::dots: return "·";
    default: return "─";
  }
}

/// Draws the series of a panel, in the order in which they come.
class Pen {
 public:
  Pen(Dots& dots, const Panel& panel)
      : dots_(dots),
        key_(named_series({&panel})),
        x_(panel.x, dots.width()),
        y_(panel.y, dots.height()),
        right_(panel.right.value_or(panel.y), dots.height()) {}

  void draw(const Series& s) {
    color_ = screen_color(s.role, s.number, s.shade);
    const Places& up = s.right ? right_ : y_;
    for (std::size_t i = 0; i < s.points.size(); ++i) {
      const Point& p = s.points[i];
      const Point* before = i == 0 ? nullptr : &s.points[i - 1];
      if (before != nullptr && (s.mark == Mark::line || s.mark == Mark::area))
        line({before->x, before->y}, {p.x, p.y}, up);
      // Upper edges alone: a filled band would hide the curves of one colour.
      if (before != nullptr && s.mark == Mark::band) line({before->x, before->high}, {p.x, p.high}, up);
      if (s.mark == Mark::text && known({p.x, p.y})) dots_.write(x_.of(p.x), up.of(p.y), p.text, color_);
      if (s.mark == Mark::dots) line({p.x, p.y}, {p.x, p.y}, up);
      if (s.mark == Mark::boxes && p.high > p.low) box(s, p, up);
      if (s.mark == Mark::points) line({p.x, p.low}, {p.x, p.high}, up);
      if (s.mark == Mark::points && known({p.x, p.y}))
        dots_.write(x_.of(p.x), up.of(p.y), sign_of(s, key_), color_);
    }
  }

 private:
  struct Place {
    double x, y;
  };
  static bool known(Place p) { return std::isfinite(p.x) && std::isfinite(p.y); }
  void line(Place a, Place b, const Places& up) {
    if (!known(a) || !known(b)) return;
    const int x0 = x_.of(a.x), x1 = x_.of(b.x), y0 = up.of(a.y), y1 = up.of(b.y);
    const int n = std::max({1, std::abs(x1 - x0), std::abs(y1 - y0)});
    // Integers, so that a line is the same on every machine.
    for (int k = 0; k <= n; ++k) dots_.put(x0 + (x1 - x0) * k / n, y0 + (y1 - y0) * k / n, color_);
  }
  void box(const Series& s, const Point& p, const Places& up) {
    const int right = x_.of(p.x + 0.5 * s.width), top = up.of(p.high);
    for (int x = x_.of(p.x - 0.5 * s.width); x <= right; ++x)
      for (int y = up.of(p.low); y <= top; ++y)
        if (is_inked(s.number, x, y)) dots_.put(x, y, color_);
  }
  Dots& dots_;
  std::vector<const Series*> key_;
  Places x_, y_, right_;
  Color color_ = 0;
};

/// The names along x.
std::string names_below(const Axis& axis, int columns) {
  Dots line(columns - axis_columns, 1);
  const Places at(axis, line.width());
  for (std::size_t i = 0; i < axis.names.size(); ++i)
    line.write(at.of(static_cast<double>(i)), 0, axis.names[i], 0);
  return std::string(axis_columns, ' ') + line.line(0, false);
}

/// The ends of x or the names along it, what it is, then the key of the series, on as many lines as it takes.
std::vector<std::string> legend(const Panel& panel, int columns, bool colored) {
  std::vector<std::string> lines;
  if (!panel.x.names.empty()) lines.push_back(names_below(panel.x, columns));
  lines.emplace_back();
  int used = 0;
  const auto add = [&](const std::string& text, const std::string& shown) {
    const int length = length_of(text) + 2;
    if (used > 0 && used + length > columns) lines.emplace_back(), used = 0;
    // A name longer than the terminal would be broken by it, and push the picture out of place.
    if (length > columns) return;
    lines.back() += "  " + shown, used += length;
  };
  const Axis& x = panel.x;
  const std::string ends = fmt::format("{:.3g} ... {:.3g}{}{}", x.low, x.high, x.unit.empty() ? "" : " ",
                                       x.unit),
                    quantity = !x.names.empty()     ? x.quantity
                               : x.quantity.empty() ? ends
                                                    : ends + "  " + x.quantity;
  if (panel.framed) add(quantity, quantity);
  const std::vector<const Series*> key = named_series({&panel});
  for (const Series* s : key) {
    const std::string text = sign_of(*s, key) + " " + s->name;
    add(text, colored ? Dots::in_color(text, screen_color(s->role, s->number, s->shade)) : text);
  }
  return lines;
}

}  // namespace

std::vector<std::string> terminal_plot(const Panel& panel, int columns, int rows, bool colored) {
  PHY_CHECK(rows >= 6 && columns >= 30, "room for a plot");
  std::vector<std::string> names = legend(panel, columns, colored);
  // Many series must not leave the picture without rows: the key gives way.
  names.resize(std::min<std::size_t>(names.size(), static_cast<std::size_t>(rows - 5)));
  const int inner = rows - 2 - static_cast<int>(names.size());
  Dots dots(columns - axis_columns, inner);
  Pen pen(dots, panel);
  for (const Series& s : panel.series) pen.draw(s);
  std::string top = panel.title.empty() ? panel.y.label() : panel.y.label() + "  " + panel.title;
  while (length_of(top) > columns) top.pop_back();
  std::vector<std::string> lines = {top};
  for (int row = 0; row < inner; ++row) {
    const std::string number = !panel.framed      ? ""
                               : row == 0         ? fmt::format("{:.4g}", panel.y.high)
                               : row == inner - 1 ? fmt::format("{:.4g}", panel.y.low)
                                                  : "";
    lines.push_back(fmt::format("{:>{}}│{}", number, axis_columns - 1, dots.line(row, colored)));
  }
  std::string axis = fmt::format("{:>{}}└", "", axis_columns - 1);
  for (int i = axis_columns; i < columns; ++i) axis += "─";
  lines.push_back(axis);
  lines.insert(lines.end(), names.begin(), names.end());
  return lines;
}

}  // namespace phy::report
