#include "report/specimen_figures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "report/gnuplot_figure.hpp"
#include "report/palette.hpp"
#include "report/run_figures.hpp"
#include "report/specimen_picture.hpp"

namespace phy::report {
namespace {

constexpr double dots_per_mm = 16.0;  // of pictures in figures: 400 per inch

std::string title_of(const SpecimenRecord& t) { return typeset(heading(t.result)); }

std::vector<const SpecimenRecord*> with_scene(const RunRecord& run) {
  std::vector<const SpecimenRecord*> tests;
  for (const SpecimenRecord& t : run.tests)
    if (!t.scene.frames.empty()) tests.push_back(&t);
  if (tests.empty())
    throw InputError(Problem{"result", "scene.bin", "", "discs and displacements",
                             "run the recipe again with test.n_frames"});
  return tests;
}

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

void show(GnuplotScript& s, const Canvas& picture, const Window& w, const std::string& title) {
  s.add("set title '{}' offset 0,-0.7; set xrange [{}:{}]; set yrange [{}:{}]", title, 1e3 * w.x0, 1e3 * w.x1,
        1e3 * w.y0, 1e3 * w.y1);
  // Axes in millimetres, though unseen: the frame of the close-up is placed by them.
  s.picture(picture, 1e3 * w.x0, 1e3 * w.y0, 1e3 * w.x1, 1e3 * w.y1);
}

constexpr double scale_room = 4.5;  // [mm] below a picture

/// A bar of a round length below a picture `drawn` mm wide, whose lower left corner is at (x, y) [mm] of the
/// sheet.
void add_scale(GnuplotScript& s, const Sheet& sheet, const Window& w, double drawn, Vec2 corner) {
  const double wide = 1e3 * (w.x1 - w.x0), power = std::pow(10.0, std::floor(std::log10(0.2 * wide)));
  double length = 10.0 * power;  // [mm] of rock
  for (const double times : {5.0, 2.0})
    if (times * power >= 0.2 * wide) length = times * power;
  const double x = corner.x + 0.03 * drawn, y = corner.y - 2.0, end = x + length / wide * drawn;
  s.add("set arrow 2 from screen {0:.4f},{1:.4f} to screen {2:.4f},{1:.4f} nohead lw 2", x / sheet.width,
        y / sheet.height, end / sheet.width);
  s.add("set label 99 '{:g} mm' at screen {:.4f},{:.4f} font ',6'", length, (end + 1.0) / sheet.width,
        y / sheet.height);
}

/// What colours mean, in letters of 7 points in the middle below the pictures: in as few rows as the width
/// allows.
class ColorKey {
 public:
  struct Word {
    std::string text, color;
  };
  ColorKey(std::vector<Word> words, double width) : words_(std::move(words)), width_(width) {
    // Halved and not lessened by one, so that rows are alike in length.
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
double side_by_side(GnuplotScript& s, const RunRecord& run, double width, bool at_end) {
  constexpr double title = 6.0, widest = 60.0;
  // gnuplot's own key cannot colour its words one by one.
  std::vector<ColorKey::Word> modes;
  for (std::size_t k = 0; k < 4; ++k)
    modes.push_back({fmt::format("■ {}", crack_names[k]), hex_color(crack_colors[k])});
  const ColorKey words(modes, width);
  const double key = (at_end ? words.height() : 1.0) + scale_room;
  const auto tests = with_scene(run);
  const auto n = static_cast<double>(tests.size());
  double aspect = 0.0;
  for (const SpecimenRecord* t : tests) {
    const Window w = whole(*t);
    // Specimens of several heights share one scale, set by the tallest.
    aspect = std::max(aspect, (w.y1 - w.y0) / (w.x1 - w.x0));
  }
  const double panel = std::min(width / n, widest), height = panel * aspect + title + key;
  // The same scale both ways: discs must stay round.
  s.add("set size ratio -1; unset border; unset tics; unset key");
  if (at_end) words.add_to(s, height);
  const double edge = 0.5 * (1.0 - n * panel / width) + 0.003;
  s.add("set multiplot layout 1,{} margins {:.4f},{:.4f},{:.4f},{:.4f} spacing 0.003,0", tests.size(), edge,
        1.0 - edge, key / height, 1.0 - title / height);
  double left = edge * width;
  for (const SpecimenRecord* t : tests) {
    // one for all that are as wide
    if (t == tests.front() || t->scene.width != tests.front()->scene.width)
      add_scale(s, {.width = width, .height = height}, whole(*t), panel, {left, key});
    show(s, picture_of(*t, whole(*t), panel, at_end), whole(*t), title_of(*t));
    // Key and bar belong to the sheet and are drawn with the first picture alone.
    s.add("unset label; unset arrow");
    left += panel;
  }
  s.add("unset multiplot");
  return height;
}

}  // namespace

double draw_specimens(GnuplotScript& s, const RunRecord& run, double width) {
  return side_by_side(s, run, width, false);
}

double draw_cracks(GnuplotScript& s, const RunRecord& run, double width) {
  return side_by_side(s, run, width, true);
}

double draw_model(GnuplotScript& s, const RunRecord& run, double width) {
  const auto tests = with_scene(run);
  const SpecimenRecord& t =
      **std::min_element(tests.begin(), tests.end(), [](const SpecimenRecord* a, const SpecimenRecord* b) {
        const auto far = [](const SpecimenRecord& r) {
          // Near 30 degrees planes cross the specimen from side to side, and one sees best what bedding is.
          return r.result.intact ? 1e3 : std::abs(r.result.theta - 30.0);
        };
        return far(*a) < far(*b);
      });
  const double w = t.scene.width, h = t.scene.height, half = 0.16 * w;
  const Window all = whole(t), close{0.5 * w - half, 0.5 * h - half, 0.5 * w + half, 0.5 * h + half};
  constexpr double title = 6.0, edge = 1.5;  // mm
  const double left = 0.44 * width, right = 0.46 * width;
  const double left_height = left * (all.y1 - all.y0) / (all.x1 - all.x0),
               most = std::max(left_height, right), height = most + title + edge + scale_room;
  const auto place = [&](double from, double to, double high) {
    const double bottom = edge + scale_room + 0.5 * (most - high);
    s.add(
        "set lmargin at screen {}; set rmargin at screen {}; set bmargin at screen {:.4f}; set tmargin at "
        "screen "
        "{:.4f}",
        from, to, bottom / height, (bottom + high) / height);
  };
  s.add("set size ratio -1; unset border; unset tics; unset key; set multiplot");
  s.add("set object 1 rectangle from {},{} to {},{} front fillstyle empty border lc rgb '#000000' lw 1.4",
        1e3 * close.x0, 1e3 * close.y0, 1e3 * close.x1, 1e3 * close.y1);
  // Margins on the screen and no layout: the two pictures differ in height.
  place(0.01, 0.45, left_height);
  const Sheet sheet{.width = width, .height = height};
  add_scale(s, sheet, all, left, {0.01 * width, edge + scale_room + 0.5 * (most - left_height)});
  show(s, picture_of(t, all, left, false), all,
       fmt::format("{:.3g} × {:.3g} mm, {}", 1e3 * w, 1e3 * h, title_of(t)));
  // The frame of the window is drawn in the first picture, not in the window itself.
  s.add("unset object 1; set border 15 lw 1.4");
  place(0.52, 0.98, right);
  add_scale(s, sheet, close, right, {0.52 * width, edge + scale_room + 0.5 * (most - right)});
  show(s, picture_of(t, close, right, false), close, "dark: discs with smooth joints");
  s.add("unset multiplot");
  return height;
}

}  // namespace phy::report
