#include "report/film.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "report/palette.hpp"
#include "report/run_figures.hpp"

namespace phy::report {
namespace {

constexpr double label_height = 34.0, curve_height = 190.0, edge = 14.0;  // [pixels]
constexpr double widest_cell = 420.0;                                     // [pixels]
// Without it the last frame, the broken specimen, is gone before anybody has looked.
constexpr double rest = 0.12;  // of the film, in which the end stands still
constexpr Color paper = 0xffffff, ink = 0x3d464c;

Color color_of(const TestResult& r) {
  // The same colours as in the figures of the run.
  const Series look = series_of(r, Mark::line, 0);
  return paper_color(look.role, look.number, look.shade);
}

}  // namespace

Film::Film(const RunRecord& run, const FilmOptions& options) : options_(options) {
  for (const SpecimenRecord& t : run.tests) {
    if (t.scene.frames.empty()) continue;
    places_.push_back({&t, {}});
    axes_ = t.recipe.test.kind->curve;
    // One clock of strain for all: specimens that fail early stand still while others go on.
    end_ = std::max(end_, last_strain(t));
    for (const HistoryRow& row : t.result.history.rows)
      strongest_ = std::max(strongest_, axes_.stress_of(row));
  }
  if (places_.empty())
    throw InputError(Problem{"result", "scene.bin", "", "discs and displacements",
                             "run the recipe again with test.n_frames"});
  if (!(end_ > 0.0)) {
    const Outcome& o = places_.front().test->result.outcome;
    throw InputError(Problem{"result", "", "", "a test that was loaded", o.reason + "; " + o.advice});
  }
  const auto n = static_cast<double>(places_.size());
  const Scene& scene = places_.front().test->scene;
  // One specimen alone would fill the width and be taller than any screen.
  cell_ = std::min(widest_cell, (options_.width - 2.0 * edge) / n);
  const double scale = 0.92 * cell_ / scene.width;
  for (std::size_t i = 0; i < places_.size(); ++i)
    places_[i].view = {0.5 * (options_.width - cell_ * n) + cell_ * (static_cast<double>(i) + 0.04),
                       label_height, scale, options_.magnify, true};
  curve_top_ = label_height + scale * scene.height + 26.0;
  // Colours are kept at half the resolution (yuv420p), so that pixels come in pairs.
  height_ = 2 * static_cast<int>(
                    std::ceil(0.5 * (curve_top_ + curve_height + 30.0)));  // encoders want even numbers
}

int Film::n_frames() const {
  return std::max(2, static_cast<int>(std::lround(options_.seconds * options_.per_second)));
}

Canvas Film::frame(int i) const {
  Canvas canvas(width(), height_, paper);
  // Even steps of strain, whatever the spacing of the frames that a run has kept.
  const double strain = end_ * std::min(1.0, (1.0 + rest) * i / (n_frames() - 1));
  for (const Place& p : places_)
    draw_specimen(canvas, *p.test, p.view, std::min(strain, last_strain(*p.test)));
  draw_curves(canvas, strain);
  return canvas;
}

void Film::draw_curves(Canvas& canvas, double strain) const {
  const double left = edge + 8.0, right = width() - edge - 8.0, low = curve_top_ + curve_height;
  const auto place = [&](const HistoryRow& row) {
    return Vec2{left + (right - left) * axes_.strain_of(row) / end_,
                // At least 1 Pa: a test that never carried anything draws a flat line.
                low - curve_height * axes_.stress_of(row) / std::max(1.0, strongest_)};
  };
  canvas.line({left, low}, {right, low}, 1.2, ink);
  canvas.line({left, curve_top_}, {left, low}, 1.2, ink);
  for (const Place& p : places_) {
    const auto& rows = p.test->result.history.rows;
    const Color color = color_of(p.test->result);
    std::size_t last = 0;
    for (std::size_t i = 1; i < rows.size() && axes_.strain_of(rows[i]) <= strain; last = i++)
      canvas.line(place(rows[i - 1]), place(rows[i]), 1.6, color);
    if (!rows.empty()) canvas.disc(place(rows[last]).x, place(rows[last]).y, 4.5, color);
  }
}

std::string Film::labels() const {
  std::string filter;
  const auto add = [&](const std::string& text, double x, double y, Color color) {
    filter += fmt::format("{}drawtext=text='{}':x={:.0f}-text_w/2:y={:.0f}:fontsize=15:fontcolor=0x{:06x}",
                          filter.empty() ? "" : ",", text, x, y, color);
  };
  for (const Place& p : places_)
    add(heading(p.test->result), p.view.left + 0.46 * cell_, 9.0, color_of(p.test->result));
  add(fmt::format("{} to {:.3g} MPa over {} to {:.2g} {}", axes_.stress, 1e-6 * strongest_, axes_.strain,
                  // In drawtext a percent sign begins an expansion.
                  axes_.strain_factor * end_, axes_.strain_unit == "%" ? "percent" : axes_.strain_unit),
      0.5 * width(), height_ - 24.0, ink);
  return filter;
}

std::vector<std::string> Film::encoder_arguments(const std::string& out) const {
  std::vector<std::string> arguments = {"-hide_banner",
                                        "-loglevel",
                                        "error",
                                        "-y",
                                        "-f",
                                        "rawvideo",
                                        "-pixel_format",
                                        "rgb24",
                                        "-video_size",
                                        fmt::format("{}x{}", width(), height_),
                                        "-framerate",
                                        std::to_string(options_.per_second),
                                        "-i",
                                        "-"};
  const auto add = [&](std::initializer_list<std::string> more) { arguments.insert(arguments.end(), more); };
  // A palette of the film's own, as a GIF has 256 colours at most; dithering would flicker from frame to
  // frame.
  if (out.ends_with(".gif"))
    add({"-filter_complex",
         labels() +
             ",split[a][b];[a]palettegen=max_colors=64:stats_mode=diff[p];[b][p]paletteuse=dither=none"});
  else if (out.ends_with(".mp4"))
    // Even sides, colours at half resolution and the index in front are what PowerPoint and browsers play.
    add({"-vf", labels() + ",pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-crf", "20", "-pix_fmt",
         "yuv420p", "-movflags", "+faststart"});
  else
    add({"-vf", labels(), "-c:v", "libvpx-vp9", "-crf", "30", "-b:v", "0", "-row-mt", "1", "-deadline",
         "good", "-cpu-used", "4", "-pix_fmt", "yuv420p"});
  arguments.push_back("file:" + out);  // else "tcp://..." is a place on the network
  return arguments;
}

}  // namespace phy::report
