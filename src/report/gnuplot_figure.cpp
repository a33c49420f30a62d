#include "report/gnuplot_figure.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "base/check.hpp"
#include "base/quote.hpp"
#include "report/palette.hpp"

namespace phy::report {
namespace {

using Row = GnuplotScript::Row;

// --- looks

struct Look {
  std::string color, dash = "1";
  double line = 1.4;  ///< width
  int symbol = 7;
  double size = 0.55;
};

/// Lightness and dashes tell lines apart, symbols points, as hues do not in grey or to the colour-blind.
Look look_of(const Series& s) {
  constexpr std::array<const char*, 8> dashes = {"1",      "(18,8)", "(4,7)",          "(18,7,4,7)",
                                                 "(40,9)", "(9,8)",  "(28,7,4,7,4,7)", "(2,10)"};
  constexpr std::array<int, 7> symbols = {7, 5, 9, 11, 13, 15, 6};
  // Stresses of damage recur on every curve: the same three symbols tell which is which.
  constexpr std::array<int, 3> level_symbols = {9, 5, 7};
  Look look{hex_color(paper_color(s.role, s.number, s.shade))};
  const double thin = s.strong ? 2.0 : 1.4;
  switch (s.role) {
    // Lightness tells the order already, so that dashes may repeat after eight.
    case Role::ordered: look.dash = dashes[s.number % dashes.size()], look.line = thin; [[fallthrough]];
    case Role::listed: look.symbol = symbols[s.number % symbols.size()]; break;
    // An open symbol: the model's full one stays visible where both agree.
    case Role::laboratory: look.line = 1.2, look.symbol = 12, look.size = 0.8; break;
    case Role::left_out: look.line = 1.6, look.symbol = 2, look.size = 0.6; break;
    case Role::level: look.symbol = level_symbols[s.number % level_symbols.size()], look.size = 0.5; break;
    case Role::intact: look.dash = dashes.back(); break;
    case Role::theory:
    case Role::bare:
    case Role::bedding:
    case Role::others: look.dash = "2"; break;
    case Role::frame: look.line = 0.7; break;
    default: break;
  }
  return look;
}

/// What stands behind the data in a plot command; in the key, behind "keyentry".
std::string style_of(const Series& s, const Look& look) {
  // yerrorbars draws a short dash at a point without a bar, which reads as an interval of nothing.
  const bool bars =
      std::any_of(s.points.begin(), s.points.end(), [](const Point& p) { return p.high > p.low; });
  const std::string color = fmt::format(" lc rgb '{}'", look.color);
  switch (s.mark) {
    case Mark::points:
      return fmt::format("with {} pt {} ps {} lw {}", bars ? "yerrorbars" : "points", look.symbol, look.size,
                         look.line) +
             color;
    case Mark::dots: return "with points pt 7 ps 0.22" + color;
    case Mark::boxes: return "with boxxyerror fs solid 1.0 noborder" + color;
    case Mark::band:
    case Mark::area: return "with filledcurves fs solid 1.0 noborder" + color;
    default: return fmt::format("with lines lw {} dt {}", look.line, look.dash) + color;
  }
}

std::vector<Row> rows_of(const Series& s) {
  std::vector<Row> rows;
  for (const Point& p : s.points) switch (s.mark) {
      case Mark::points:  // one without a bar is drawn all the same
        rows.push_back({p.x, p.y, std::isfinite(p.low) ? p.low : p.y, std::isfinite(p.high) ? p.high : p.y});
        break;
      case Mark::band: rows.push_back({p.x, p.low, p.high}); break;
      case Mark::boxes:
        rows.push_back({p.x, p.low, p.x - 0.5 * s.width, p.x + 0.5 * s.width, p.low, p.high});
        break;
      default: rows.push_back({p.x, p.y}); break;
    }
  return rows;
}

// --- places

/// Panels in rows and columns, with margins in millimetres whatever the width of the figure.
struct Grid {
  std::size_t columns = 1, rows = 1;
  double width = 0.0, height = 0.0, head = 0.0;               // [mm] of the figure; above the panels
  double left = 15.5, right = 1.5, top = 6.0, bottom = 11.0;  // [mm] about each panel
  double panel_width = 0.0, panel_height = 0.0;               // [mm] between the axes
};

/// As high as the sheet, or as the panels' axes want it.
Grid grid_of(const Figure& figure, const Sheet& sheet, double head) {
  constexpr double lowest = 15.0;  // [mm] between axes whose numbers stand clear of each other
  Grid g;
  const std::size_t n = std::max<std::size_t>(1, figure.panels.size());
  // All panels of a figure are of one sort, so that the first can tell.
  const bool framed = n > 0 && !figure.panels.empty() && figure.panels.front().framed;
  if (framed) {
    // Four as two by two: three and one would leave most of a row empty.
    g.columns = n <= 2 ? n : n == 4 ? 2 : 3;
    // The second axis has numbers and a name, too.
    if (figure.panels.front().right) g.right = 11.0;
    double highest = 1e3;
    for (const Panel& panel : figure.panels)
      if (!panel.y.logarithmic) highest = std::max(highest, panel.y.high);
    g.left += 1.7 * (std::floor(std::log10(highest)) - 3.0);  // the room holds four digits
    // Half of the last number below an axis stands beyond its end.
    for (const Panel& panel : figure.panels)
      if (panel.x.high >= 100.0) g.right = std::max(g.right, 3.0);
  } else {
    g.columns = std::min<std::size_t>(n, 4);
    g.left = g.right = g.bottom = 1.0;
  }
  if (figure.panels.size() == 1 && figure.panels.front().title.empty())
    g.top = 2.0;  // letters of several panels need room
  g.rows = (n + g.columns - 1) / g.columns;
  g.width = sheet.width, g.head = head;
  const auto columns = static_cast<double>(g.columns), rows = static_cast<double>(g.rows);
  g.panel_width = g.width / columns - g.left - g.right;
  // Without a frame it is a picture to scale, as high as wide.
  g.panel_height = g.panel_width * (framed ? figure.aspect : 1.0);
  g.height = rows * (g.panel_height + g.top + g.bottom) + head;
  if (sheet.height == 0.0) return g;
  g.panel_height += (sheet.height - g.height) / rows, g.height = sheet.height;
  if (!framed || g.panel_height < lowest)
    throw InputError(Problem{"command line", "--size", fmt::format("{:g}x{:g}", sheet.width, sheet.height),
                             framed ? fmt::format("at least {:.0f} mm of height",
                                                  std::ceil(rows * (lowest + g.top + g.bottom) + head))
                                    : "a width alone, for a figure without axes",
                             "leave the height out: it follows from the width"});
  return g;
}

void begin(GnuplotScript& s, const Grid& g) {
  // gnuplot takes margins as shares of the page; millimetres keep letters clear whatever its width.
  s.add("set multiplot layout {},{} margins {:.4f},{:.4f},{:.4f},{:.4f} spacing {:.4f},{:.4f}", g.rows,
        g.columns, g.left / g.width, 1.0 - g.right / g.width, g.bottom / g.height,
        1.0 - (g.top + g.head) / g.height, (g.left + g.right) / g.width, (g.top + g.bottom) / g.height);
}

/// Names at points, above them, or as much higher as it takes to stand clear of the names before them. Higher
/// by a bit more than a name each time: rounding cannot let the same one meet again.
class Labels {
 public:
  Labels(const Panel& panel, const Grid& g)
      : x_scale_(g.panel_width / (panel.x.high - panel.x.low)),
        y_scale_(g.panel_height / (panel.y.high - panel.y.low)) {}
  void add_to(GnuplotScript& s, const Point& point, const std::string& color) {
    constexpr double high = 3.2, wide = 7.0;  // [mm] of a label of 7 points
    Place p{point.x * x_scale_, point.y * y_scale_ + 0.6 * high};
    const auto meets = [&](const Place& other) {
      return std::fabs(other.x - p.x) < wide && std::fabs(other.y - p.y) < high;
    };
    // From the start again after each move: higher up it may meet a name that was clear before.
    for (auto it = places_.begin();
         (it = std::find_if(places_.begin(), places_.end(), meets)) != places_.end();)
      p.y = it->y + 1.01 * high;
    places_.push_back(p);
    s.add("set label {} at first {:.6g},{:.6g} center front boxed font ',7' tc rgb '{}'",
          gnuplot_string(typeset(point.text)), point.x, p.y / y_scale_, color);
  }

 private:
  struct Place {
    double x, y;  // [mm]
  };
  double x_scale_, y_scale_;
  std::vector<Place> places_;
};

// --- the key

struct KeyRows {
  std::vector<std::string> entries;   ///< of the plot that draws it
  std::size_t rows = 0, longest = 0;  ///< characters of a name
};

/// In as few rows as the width allows [mm]; a name alone needs none where all panels share it.
KeyRows key_of(const std::vector<const Panel*>& panels, double width, bool even_one) {
  KeyRows key;
  const auto named = named_series(panels);
  for (const Series* s : named) {
    if (named.size() == 1 && !even_one) break;
    const std::string name = typeset(s->name);
    key.entries.push_back("keyentry " + style_of(*s, look_of(*s)) + " title " + gnuplot_string(name));
    // Bytes and not letters: Greek counts double, which leaves a little more room than needed.
    key.longest = std::max(key.longest, s->name.size());
  }
  const double column = 12.0 + 1.3 * static_cast<double>(key.longest);  // [mm], letters of 7 points
  const auto columns = static_cast<std::size_t>(std::max(1.0, width / column));
  key.rows = (key.entries.size() + columns - 1) / columns;
  return key;
}

// --- panels

/// Between numbers that stand clear of each other in a panel so wide [mm].
double step_of(const Axis& axis, double width) {
  constexpr double apart = 10.0;  // [mm]
  const double least = (axis.high - axis.low) * apart / width,
               power = std::pow(10.0, std::floor(std::log10(least)));
  // gnuplot's own step does not know the size of letters: on narrow panels numbers would run into each other.
  for (const double times : {1.0, 2.0, 5.0})
    if (times * power >= least) return times * power;
  return 10.0 * power;
}

void set_axis(GnuplotScript& s, const Axis& axis, const char* name, double high, const Grid& g) {
  s.add("set {}range [{:.8g}:{:.8g}]", name, axis.low, high);
  s.add("set {}label {}", name, gnuplot_string(typeset(axis.label())));
  // Set and unset each time: settings go on into the next panel of a multiplot.
  if (axis.logarithmic)
    s.add("set logscale {0}; set format {0} '10^{{%L}}'", name);
  else
    s.add("unset logscale {0}; set format {0} '%g'", name);
  // Along y numbers stand above each other and need little room: gnuplot's step is good.
  const double step = axis.step > 0.0 ? axis.step : *name == 'x' ? step_of(axis, g.panel_width) : 0.0;
  if (step > 0.0) s.add("set {}tics {:g}", name, step);
  std::string names;
  for (std::size_t i = 0; i < axis.names.size(); ++i)
    names += fmt::format("{}{} {}", i == 0 ? "" : ", ", gnuplot_string(gnuplot_plain(axis.names[i])), i);
  if (!names.empty()) s.add("set {}tics ({})", name, names);
}

/// The upper end, with room for a key inside, above the curves.
double end_with_room(const Axis& axis, const Grid& g, std::size_t key_rows) {
  if (key_rows == 0) return axis.high;
  const double key = 1.0 + 2.9 * static_cast<double>(key_rows);  // [mm]
  const double part = key / std::max(key, g.panel_height - key);
  // The same share of the picture is a factor on a logarithmic axis, a length on a linear one.
  return axis.logarithmic ? axis.high * std::pow(axis.high / axis.low, part)
                          : axis.high + part * (axis.high - axis.low);
}

void draw(GnuplotScript& s, const Panel& panel, const Grid& g, const KeyRows& key, bool inside) {
  if (panel.framed) {
    set_axis(s, panel.x, "x", panel.x.high, g);
    set_axis(s, panel.y, "y", end_with_room(panel.y, g, inside ? key.rows : 0), g);
    if (panel.right) {
      set_axis(s, *panel.right, "y2", panel.right->high, g);
      s.add("set ytics nomirror; set y2tics");
    }
  } else {
    s.add("set xrange [{0}:{1}]; set yrange [{0}:{1}]", panel.x.low, panel.x.high);
  }
  Labels labels(panel, g);
  std::vector<std::string> parts;
  for (const Series& series : panel.series) {
    const Look look = look_of(series);
    if (series.mark == Mark::text)
      for (const Point& p : series.points) labels.add_to(s, p, look.color);
    else if (!series.points.empty())
      parts.push_back(fmt::format("{}{} {} notitle", s.block(rows_of(series)),
                                  series.right ? " axes x1y2" : "", style_of(series, look)));
  }
  parts.insert(parts.end(), key.entries.begin(), key.entries.end());
  s.plot(parts);
  // Labels outlive their plot, and would stand in every panel that follows.
  s.add("unset label");
}

std::string title_of(const Figure& figure, std::size_t i) {
  const Panel& panel = figure.panels[i];
  // Letters are for the text that refers to panels; pictures are told apart by their titles.
  if (figure.panels.size() < 2 || !panel.framed) return typeset(panel.title);
  return fmt::format("({}){}{}", static_cast<char>('a' + i), panel.title.empty() ? "" : " ",
                     typeset(panel.title));
}

}  // namespace

std::string typeset(const std::string& text) {
  const auto in_word = [&](std::size_t i) {
    const auto c = static_cast<unsigned char>(text[i]);
    return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '/' || c == '\'' || c >= 0x80U;
  };
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && in_word(end)) ++end;
    const std::string word = text.substr(i, std::max(end - i, std::size_t{1}));
    i += word.size();
    const std::size_t letter = utf8_length(word);
    // 0xCE and 0xCF are the first bytes of all Greek letters.
    const bool greek = letter == 2 && (word[0] == '\xCE' || word[0] == '\xCF');
    const bool latin = letter == 1 && std::isalpha(static_cast<unsigned char>(word[0])) != 0;
    const std::string low = word.substr(std::min(letter, word.size()));
    // Single letters with or without an index are quantities, set in italics as journals do; words are not.
    if ((greek || latin) && (low.empty() || (low[0] == '_' && low.size() > 1)))
      out += "{/:Italic " + word.substr(0, letter) + "}" +
             (low.empty() ? "" : "_{" + gnuplot_plain(low.substr(1)) + "}");
    else
      out += gnuplot_plain(word);
  }
  return out;
}

std::string gnuplot_script(const Figure& figure, Sheet sheet) {
  GnuplotScript s;
  KeyRows key;
  double head = 0.0;
  if (figure.key == Key::shared) {
    key = key_of(panels_of(figure), sheet.width, false);
    if (key.rows > 0) head = 1.0 + 3.4 * static_cast<double>(key.rows);
    // gnuplot takes long names for wider than they are, and short ones for narrower
    const double wider = 2.0 - static_cast<double>(key.longest) / 6.0;  // [letters] of each column
    s.add(
        "set key at screen 0.06,screen 0.995 left top vertical maxrows {} reverse Left samplen 2.4 width "
        "{:.1f}",
        std::max<std::size_t>(1, key.rows), wider);
  } else if (figure.key == Key::inside) {
    s.add("set key top center reverse Left maxrows 3 samplen 1.2 font ',6' width -2");
  }
  const Grid g = grid_of(figure, sheet, head);
  s.add("set style textbox opaque noborder margins 0.3,0.3");
  if (!figure.panels.empty() && !figure.panels.front().framed)
    s.add("unset border; unset tics; set size ratio -1");
  begin(s, g);
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Panel& panel = figure.panels[i];
    if (figure.key == Key::inside) {
      key = key_of({&panel}, g.panel_width, true);
      // As maxrows above: further entries go into a second column.
      key.rows = std::min<std::size_t>(3, key.entries.size());
    }
    s.add("set title {} offset 0,-0.6", gnuplot_string(title_of(figure, i)));
    draw(s, panel, g, key, figure.key == Key::inside);
    // One key for all: the first panel has drawn it.
    if (figure.key == Key::shared) key = {}, s.add("unset key");
  }
  s.add("unset multiplot");
  sheet.height = g.height;
  return gnuplot_head(sheet) + s.text();
}

}  // namespace phy::report
