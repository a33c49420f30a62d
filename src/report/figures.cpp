#include "report/figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "base/check.hpp"
#include "base/spelling.hpp"
#include "records/recipe_schema.hpp"
#include "records/test_description.hpp"
#include "report/angle_figures.hpp"
#include "report/curves.hpp"
#include "report/palette.hpp"
#include "report/specimen_picture.hpp"
#include "report/variation_figures.hpp"

namespace phy::report {
namespace {

using Row = GnuplotScript::Row;
constexpr double dots_per_mm = 16.0;  // of pictures in figures: 400 per inch

std::string heading(const SpecimenRecord& t) {
  return t.result.intact ? "intact" : fmt::format("{{/:Italic θ}} = {:g}°", t.result.theta);
}

std::vector<const SpecimenRecord*> with_scene(const RunRecord& run) {
  std::vector<const SpecimenRecord*> tests;
  for (const SpecimenRecord& t : run.tests)
    if (!t.scene.frames.empty()) tests.push_back(&t);
  if (tests.empty())
    throw InputError(Problem{"result", "scene.bin", "", "discs and displacements",
                             "run the recipe again with test.n_frames"});
  return tests;
}

// --- curves
// --------------------------------------------------------------------------------------------------

const TestCurve& axes_of(const RunRecord& run) {
  return (run.tests.empty() ? TestKind() : run.tests.front().recipe.test.kind)->curve;
}

/// Where the curve first reaches the value of a number.
void add_mark(const SpecimenRecord& t, const TestCurve& axes, const std::string& name,
              std::vector<Row>& marks) {
  const double level = value_of(t, name);
  for (const HistoryRow& row : t.result.history.rows)
    if (axes.stress_of(row) >= level)
      return marks.push_back({axes.strain_factor * axes.strain_of(row), 1e-6 * level});
}

/// The angle at the peak of each curve.
class PeakLabels {
 public:
  /// `x_end`, `y_end`: largest values of the axes; the plot is `width` x `height` mm.
  PeakLabels(double x_end, double y_end, double width, double height)
      : x_scale_(width / x_end), y_scale_(height / y_end) {}
  /// Above the point, or as much higher as it takes to stand clear of the labels before it. Higher by a bit
  /// more than a label each time: rounding cannot let the same one meet again.
  void add_to(GnuplotScript& s, const std::string& text, double x, double y, const std::string& color) {
    constexpr double high = 3.2, wide = 7.0;  // [mm] of a label of 7 points
    Place p{x * x_scale_, y * y_scale_ + 0.6 * high};
    const auto meets = [&](const Place& other) {
      return std::fabs(other.x - p.x) < wide && std::fabs(other.y - p.y) < high;
    };
    for (auto it = places_.begin();
         (it = std::find_if(places_.begin(), places_.end(), meets)) != places_.end();)
      p.y = it->y + 1.01 * high;
    places_.push_back(p);
    s.add("set label '{}' at first {:.6g},{:.6g} center front boxed font ',7' tc rgb '{}'", text, x,
          p.y / y_scale_, color);
  }

 private:
  struct Place {
    double x, y;  // [mm]
  };
  double x_scale_, y_scale_;
  std::vector<Place> places_;
};

/// Stress over strain in the units of the axes.
std::vector<Row> curve_of(const SpecimenRecord& t, const TestCurve& axes) {
  std::vector<Row> rows;
  for (const HistoryRow& row : t.result.history.rows)
    rows.push_back({axes.strain_factor * axes.strain_of(row), 1e-6 * axes.stress_of(row)});
  return rows;
}

Row largest_of(const std::vector<std::vector<Row>>& curves) {
  Row largest = {1e-9, 1e-9};
  for (const auto& curve : curves)
    for (const Row& row : curve)
      for (std::size_t k = 0; k < 2; ++k) largest[k] = std::fmax(largest[k], row[k]);
  return largest;
}

/// Lightness and dashes tell the curves apart, as hues do not in grey or to the colour-blind.
std::string look_of(std::size_t i, const TestResult& r) {
  constexpr std::array<const char*, 8> dashes = {"1",      "(18,8)", "(4,7)",          "(18,7,4,7)",
                                                 "(40,9)", "(9,8)",  "(28,7,4,7,4,7)", "(2,10)"};
  return fmt::format("dt {} lc rgb '{}'", dashes[i % dashes.size()], hex_color(paper_color(r)));
}

/// Damage and peak of all curves, in black.
void add_marks(GnuplotScript& s, const RunRecord& run, const TestCurve& axes,
               std::vector<std::string>& parts) {
  const std::array<std::string, 3> names = {"sigma_ci", "sigma_cd", axes.strength};
  const std::array<std::string, 3> titles = {"{/:Italic σ}_{ci}", "{/:Italic σ}_{cd}", axes.strength_label};
  constexpr std::array<int, 3> symbols = {9, 5, 7};
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<Row> marks;
    for (const SpecimenRecord& t : run.tests) add_mark(t, axes, names[k], marks);
    if (!marks.empty())
      parts.push_back(fmt::format("{} with points pt {} ps 0.5 lc rgb '#222222' title '{}'", s.block(marks),
                                  symbols[k], titles[k]));
  }
}

double stress_strain(GnuplotScript& s, const FigureData& data, double width) {
  const TestCurve& axes = axes_of(data.run);
  s.add("set xlabel '{} [{}]'; set ylabel '{} [MPa]' offset 1", axes.strain, axes.strain_unit, axes.stress);
  s.add("set key outside right top reverse Left samplen 4; set lmargin at screen 0.11");
  s.add("set style textbox opaque noborder margins 0.3,0.3");
  std::vector<std::vector<Row>> curves;
  for (const SpecimenRecord& t : data.run.tests) curves.push_back(curve_of(t, axes));
  const Row largest = largest_of(curves);
  s.add("set xrange [0:{:.6g}]; set yrange [0:{:.6g}]", 1.02 * largest[0], 1.12 * largest[1]);
  PeakLabels labels(largest[0], 1.12 * largest[1], 0.68 * width, 0.5 * width);
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (curves[i].empty()) continue;
    const TestResult& r = data.run.tests[i].result;
    parts.push_back(fmt::format("{} with lines lw 1.5 {} title '{}'", s.block(curves[i]), look_of(i, r),
                                heading(data.run.tests[i])));
    const Row& peak = *std::max_element(curves[i].begin(), curves[i].end(),
                                        [](const Row& a, const Row& b) { return a[1] < b[1]; });
    labels.add_to(s, r.intact ? "intact" : fmt::format("{:g}°", r.theta), peak[0], peak[1],
                  hex_color(paper_color(r)));
  }
  add_marks(s, data.run, axes, parts);
  if (parts.empty()) {
    const Outcome o = data.run.tests.empty() ? Outcome{} : data.run.tests.front().result.outcome;
    throw InputError(Problem{"result", "", "", "a test that came to be loaded", o.reason + "; " + o.advice});
  }
  s.plot(parts);
  return 0.62 * width;
}

// --- specimens
// -----------------------------------------------------------------------------------------------

/// Draws a specimen, or the part between x0 ... x1 and y0 ... y1 [m] of it, `width` mm wide on paper.
struct Window {
  double x0, y0, x1, y1;
};
Canvas picture_of(const SpecimenRecord& t, const Window& w, double width, bool at_end) {
  const double scale = dots_per_mm * width / (w.x1 - w.x0);
  Canvas canvas(static_cast<int>(std::lround(scale * (w.x1 - w.x0))),
                static_cast<int>(std::lround(scale * (w.y1 - w.y0))), 0xffffff);
  SpecimenView view;
  view.left = -scale * w.x0, view.top = scale * (w.y1 - t.scene.height), view.scale = scale,
  view.cracks = at_end;
  draw_specimen(canvas, t, view, at_end ? last_strain(t) : 0.0);
  return canvas;
}

/// The specimen with a little room for what bulges.
Window whole(const SpecimenRecord& t) {
  const double edge = 0.03 * t.scene.width;
  return {-edge, -edge, t.scene.width + edge, t.scene.height + edge};
}

void show(GnuplotScript& s, const SpecimenRecord& t, const Window& w, double width, bool at_end,
          const std::string& title) {
  s.add("set title '{}' offset 0,-0.7; set xrange [{}:{}]; set yrange [{}:{}]", title, 1e3 * w.x0, 1e3 * w.x1,
        1e3 * w.y0, 1e3 * w.y1);
  s.picture(picture_of(t, w, width, at_end), 1e3 * w.x0, 1e3 * w.y0, 1e3 * w.x1, 1e3 * w.y1, {});
}

/// What colours mean, in letters of 7 points in the middle below the pictures: in as few rows as the width
/// allows.
class Key {
 public:
  struct Word {
    std::string text, color;
  };
  Key(std::vector<Word> words, double width) : words_(std::move(words)), width_(width) {
    while (columns_ > 1 && row_length(0) > width) columns_ = (columns_ + 1) / 2;
  }
  double height() const { return 3.0 + row * static_cast<double>(rows()); }  // [mm]
  /// `figure_height`: [mm]; labels are numbered from 1.
  void add_to(GnuplotScript& s, double figure_height) const {
    for (std::size_t k = 0; k < words_.size(); ++k) {
      const std::size_t line = k / columns_, first = line * columns_;
      double x = 0.5 * (width_ - row_length(first));
      for (std::size_t i = first; i < k; ++i) x += length(words_[i]);
      const double y = 2.5 + row * static_cast<double>(rows() - 1 - line);
      s.add("set label {} '{}' at screen {:.4f},{:.4f} tc rgb '{}' font ',7'", k + 1, words_[k].text,
            x / width_, y / figure_height, words_[k].color);
    }
  }

 private:
  static constexpr double row = 4.0, letter = 1.25, gap = 2.0;  // [mm]
  std::vector<Word> words_;
  double width_;
  std::size_t columns_ = words_.size();

  std::size_t rows() const { return (words_.size() + columns_ - 1) / columns_; }
  static double length(const Word& w) { return gap + letter * static_cast<double>(w.text.size()); }
  double row_length(std::size_t first) const {
    double sum = 0.0;
    for (std::size_t i = first; i < std::min(first + columns_, words_.size()); ++i) sum += length(words_[i]);
    return sum;
  }
};

/// Side by side, with room for titles and key [mm].
double specimens(GnuplotScript& s, const FigureData& data, double width, bool at_end) {
  constexpr double title = 6.0, widest = 60.0;
  std::vector<Key::Word> modes;
  for (std::size_t k = 0; k < 4; ++k)
    modes.push_back({fmt::format("■ {}", crack_names[k]), hex_color(crack_colors[k])});
  const Key words(modes, width);
  const double key = at_end ? words.height() : 1.0;
  const auto tests = with_scene(data.run);
  const auto n = static_cast<double>(tests.size());
  double aspect = 0.0;
  for (const SpecimenRecord* t : tests) {
    const Window w = whole(*t);
    aspect = std::max(aspect, (w.y1 - w.y0) / (w.x1 - w.x0));
  }
  const double panel = std::min(width / n, widest), height = panel * aspect + title + key;
  s.add("set size ratio -1; unset border; unset tics; unset key");
  if (at_end) words.add_to(s, height);
  const double edge = 0.5 * (1.0 - n * panel / width) + 0.003;
  s.add("set multiplot layout 1,{} margins {:.4f},{:.4f},{:.4f},{:.4f} spacing 0.003,0", tests.size(), edge,
        1.0 - edge, key / height, 1.0 - title / height);
  for (const SpecimenRecord* t : tests) {
    show(s, *t, whole(*t), panel, at_end, heading(*t));
    s.add("unset label");
  }
  s.add("unset multiplot");
  return height;
}

/// The specimen nearest to 30 degrees before the test, and a window on its bedding.
double model(GnuplotScript& s, const FigureData& data, double width) {
  const auto tests = with_scene(data.run);
  const SpecimenRecord& t =
      **std::min_element(tests.begin(), tests.end(), [](const SpecimenRecord* a, const SpecimenRecord* b) {
        const auto far = [](const SpecimenRecord& r) {
          return r.result.intact ? 1e3 : std::abs(r.result.theta - 30.0);
        };
        return far(*a) < far(*b);
      });
  const double w = t.scene.width, h = t.scene.height, half = 0.16 * w;
  const Window all = whole(t), close{0.5 * w - half, 0.5 * h - half, 0.5 * w + half, 0.5 * h + half};
  constexpr double title = 6.0, edge = 1.5;  // mm
  const double left = 0.44 * width, right = 0.46 * width;
  const double left_height = left * (all.y1 - all.y0) / (all.x1 - all.x0),
               most = std::max(left_height, right), height = most + title + edge;
  const auto place = [&](double from, double to, double high) {
    const double bottom = edge + 0.5 * (most - high);
    s.add(
        "set lmargin at screen {}; set rmargin at screen {}; set bmargin at screen {:.4f}; set tmargin at "
        "screen "
        "{:.4f}",
        from, to, bottom / height, (bottom + high) / height);
  };
  s.add("set size ratio -1; unset border; unset tics; unset key; set multiplot");
  s.add("set object 1 rectangle from {},{} to {},{} front fillstyle empty border lc rgb '#000000' lw 1.4",
        1e3 * close.x0, 1e3 * close.y0, 1e3 * close.x1, 1e3 * close.y1);
  place(0.01, 0.45, left_height);
  show(s, t, all, left, false, fmt::format("{:.3g} × {:.3g} mm, {}", 1e3 * w, 1e3 * h, heading(t)));
  s.add("unset object 1; set border 15 lw 1.4");
  place(0.52, 0.98, right);
  show(s, t, close, right, false, "dark: discs with smooth joints");
  s.add("unset multiplot");
  return height;
}

// --- roses
// ---------------------------------------------------------------------------------------------------

/// Corners of the petals in polar coordinates: the area is proportional to the number.
std::vector<Row> petals(const Rose& r, double largest, bool shear_only) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < 2 * r.tension.size(); ++i) {
    const std::size_t k = i % r.tension.size();
    const double from = (static_cast<double>(i) - 0.5) * r.bin(), to = from + r.bin();
    const double radius = std::sqrt((r.shear[k] + (shear_only ? 0.0 : r.tension[k])) / largest);
    rows.insert(rows.end(),
                {{from, 0.0}, {from, radius}, {0.5 * (from + to), radius}, {to, radius}, {to, 0.0}});
  }
  return rows;
}

double rose(GnuplotScript& s, const FigureData& data, double width) {
  const std::size_t n = data.run.tests.size();
  s.add(
      "set polar; set angles degrees; unset border; unset tics; unset raxis; unset rtics; set size square; "
      "unset key; set rrange [0:1.15]");
  s.add("set style fill solid 1.0 noborder");
  const double height = n > 4 ? 0.6 * width : width / static_cast<double>(n) + 14.0;
  Key({{"■ tension", hex_color(crack_colors[0])},
       {"■ shear", hex_color(crack_colors[1])},
       {"- - bedding", "#000000"}},
      width)
      .add_to(s, height);
  s.add("set multiplot layout {},{} margins 0.04,0.96,{},0.90 spacing 0.01,0.10", n > 4 ? 2 : 1,
        n > 4 ? (n + 1) / 2 : n, n > 4 ? 0.07 : 0.12);
  for (const SpecimenRecord& t : data.run.tests) {
    const Rose r = crack_rose(t.result.cracks);
    double largest = 1.0;
    for (std::size_t i = 0; i < r.tension.size(); ++i) largest = std::max(largest, r.tension[i] + r.shear[i]);
    std::vector<Row> circle;
    for (int angle = 0; angle <= 360; angle += 5) circle.push_back({static_cast<double>(angle), 1.0});
    std::vector<std::string> parts = {
        s.block(circle) + " with lines lw 0.7 lc rgb '#aaaaaa'",
        fmt::format("{} with filledcurves lc rgb '{}'", s.block(petals(r, largest, false)),
                    hex_color(crack_colors[0])),
        fmt::format("{} with filledcurves lc rgb '{}'", s.block(petals(r, largest, true)),
                    hex_color(crack_colors[1]))};
    if (!t.result.intact)
      parts.push_back(s.block({{t.result.theta, 1.13}, {t.result.theta + 180.0, 1.13}}) +
                      " with lines dt 2 lw 1.4 lc rgb '#000000'");
    s.add("set title '{}, n = {}' offset 0,-0.6", heading(t), t.result.cracks.size());
    s.plot(parts);
    s.add("unset label");
  }
  s.add("unset multiplot");
  return height;
}

/// Draws a figure that is `width` mm wide and returns its height.
double draw(GnuplotScript& s, const std::string& kind, const FigureData& data, double width) {
  if (kind == "stress_strain") return stress_strain(s, data, width);
  if (kind == "anisotropy" && data.calibration) return draw_comparison(s, *data.calibration, width);
  if (kind == "anisotropy") return draw_anisotropy(s, data.run, data.laboratory, width);
  if (kind == "rose") return rose(s, data, width);
  if (kind == "model") return model(s, data, width);
  if (kind == "stiffness") return draw_stiffness(s, data.variation, width);
  if (kind == "modulus") return draw_modulus(s, data.variation, width);
  if (kind == "strength") return draw_strength(s, data.variation, width);
  return specimens(s, data, width, kind == "cracks");
}

}  // namespace

const std::vector<FigureKind>& figure_kinds() {
  static const std::vector<FigureKind> kinds = {
      {"stress_strain", "", "stress over strain of a run, with sigma_ci, sigma_cd and UCS", 140.0, false},
      {"anisotropy", "",
       "E, strengths, nu over the inclination: a run, or a calibration beside its laboratory", 190.0, false},
      {"rose", "", "directions of the cracks of a run", 190.0, false},
      {"cracks", "", "specimens of a run at the end, cracks by mode and place", 190.0, false},
      {"model", "fig2", "one specimen of a run with its bedding", 90.0, false},
      {"specimens", "fig3", "specimens of a run before the test", 190.0, false},
      {"stiffness", "fig4", "macro stiffnesses K_n, K_s over the parameters of a study", 190.0, true},
      {"modulus", "fig5", "E over the inclination, per value of a study", 190.0, true},
      {"strength", "fig6", "UCS over the inclination, per value of a study", 190.0, true}};
  return kinds;
}

const FigureKind& figure_kind(const std::string& word) {
  std::vector<std::string> names;
  std::string list;
  for (const FigureKind& k : figure_kinds()) {
    if (word == k.name || (*k.paper != 0 && word == k.paper)) return k;
    names.emplace_back(k.name);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  // Who names what a table of the laboratory holds means its course.
  constexpr std::string_view of_table[] = {"UCS", "ucs", "BTS", "bts", "DTS", "dts", "E", "nu", "theta"};
  const bool is_of_table = std::find(std::begin(of_table), std::end(of_table), word) != std::end(of_table);
  const std::string near = is_of_table ? "anisotropy" : nearest(word, names);
  throw InputError(Problem{"command line", "--kind", word, "one of " + list,
                           near.empty() ? "" : "did you mean " + near + "?"});
}

std::string figure_script(const FigureKind& kind, const FigureData& data, FigureFormat format, double width,
                          const std::string& out) {
  const double w = width > 0.0 ? width : kind.width;
  GnuplotScript script;
  const double height = draw(script, kind.name, data, w);
  return gnuplot_head(format, w, height, out) + script.text();
}

}  // namespace phy::report
