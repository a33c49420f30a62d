#include "report/event_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "events/b_value.hpp"
#include "events/counts.hpp"
#include "report/curves.hpp"
#include "report/run_figures.hpp"
#include "report/specimen_picture.hpp"
#include "report/words_of_events.hpp"

namespace phy::report {
namespace {

/// How many events have at least each magnitude.
Series frequency_of(std::vector<double> magnitudes) {
  Series s{"events", Mark::dots, Role::model};
  // The largest has one event of at least its size: itself.
  std::sort(magnitudes.begin(), magnitudes.end(), std::greater<>());
  for (std::size_t i = 0; i < magnitudes.size(); ++i)
    s.points.push_back({magnitudes[i], static_cast<double>(i + 1)});
  return s;
}

Panel frequency_panel(const SpecimenRecord& t) {
  const double thickness = t.result.events.front().thickness;
  // A figure in a paper has no caption of ours: what a magnitude is of stands on its axis.
  Panel panel{heading(t.result), "", Axis{fmt::format("magnitude, thickness {:.3g} mm", 1e3 * thickness)},
              Axis{"events of at least that magnitude"}};
  panel.y.logarithmic = true;
  const std::vector<double> magnitudes = events::magnitudes_of(t.result.events);
  panel.series.push_back(frequency_of(magnitudes));
  // Read and not computed: the figure shows what result.json says.
  const double b = value_of(t, "b_value"), half_width = value_of(t, "b_value_half_width"),
               from = value_of(t, "magnitude_of_completeness");
  // value_of knows no number of an untrusted test; what magnitudes are of is certain all the same.
  panel.caption = text_of_b_value(b, half_width, thickness, t.result.outcome.status != Status::untrusted);
  const auto [least, most] = std::minmax_element(magnitudes.begin(), magnitudes.end());
  // They are below zero, where an axis would otherwise end.
  panel.x.low = std::floor(*least), panel.x.high = std::max(std::ceil(*most), panel.x.low + 1.0);
  if (!std::isfinite(b)) return panel;
  panel.title += fmt::format(", b = {:.2f} ± {:.2f}", b, half_width);
  const auto n = static_cast<double>(
      std::count_if(magnitudes.begin(), magnitudes.end(), [&](double m) { return m >= from; }));
  // From all events from the completeness on down to one, or as far as the axis reaches.
  Series line{"log N = a - b M", Mark::line, Role::theory};
  const double to = std::min(from + std::log10(n) / b, panel.x.high);
  line.points = {{from, n}, {to, n * std::pow(10.0, -b * (to - from))}};
  panel.series.push_back(line);
  return panel;
}

/// Circles of one type in one series: a point without a height parts each from the next.
Series circles_of(const SpecimenRecord& t, SourceType type) {
  Series s{to_string(type), Mark::line, Role::listed, static_cast<std::size_t>(type)};
  const SpecimenSize& size = t.recipe.specimen;
  const std::vector<double> magnitudes = events::magnitudes_of(t.result.events);
  const double largest = *std::max_element(magnitudes.begin(), magnitudes.end());
  constexpr int chords = 16;
  for (const AcousticEvent& e : t.result.events) {
    if (e.type != type || !std::isfinite(e.magnitude)) continue;
    // About the middle of the specimen [mm]: both axes of a picture without a frame have one range.
    const double r = event_radius(e, largest, size.width);
    const Vec2 middle = e.position - Vec2{0.5 * size.width, 0.5 * size.height};
    for (int i = 0; i <= chords; ++i) {
      const double a = 2.0 * std::numbers::pi * i / chords;
      s.points.push_back({1e3 * (middle.x + r * std::cos(a)), 1e3 * (middle.y + r * std::sin(a))});
    }
    s.points.push_back({1e3 * middle.x});
  }
  return s;
}

Panel places_panel(const SpecimenRecord& t) {
  const SpecimenSize& size = t.recipe.specimen;
  // A square about the specimen with some room: circles reach beyond its edge.
  const double most = 0.53e3 * std::max(size.width, size.height);
  Panel panel{heading(t.result), "", Axis{"", "", -most, most}, Axis{"", "", -most, most}};
  panel.framed = false;
  Series outline{"", Mark::line, Role::frame};
  const double w = 0.5e3 * size.width, h = 0.5e3 * size.height;
  outline.points = {{-w, -h}, {w, -h}, {w, h}, {-w, h}, {-w, -h}};
  panel.series.push_back(outline);
  for (const SourceType type : all_source_types) panel.series.push_back(circles_of(t, type));
  return panel;
}

Panel counts_panel(const SpecimenRecord& t, const LaboratoryCounts& laboratory) {
  const events::Counts ours = events::counts_of(t.result.events, t.recipe.test.kind->curve.sign,
                                                std::fabs(value_of(t, "peak_strain"))),
                       theirs = events::counts_of(laboratory.curve);
  // Shares over shares: a laboratory counts what it hears, on a specimen of another size.
  Panel panel{heading(t.result), "", Axis{"strain over strain at the peak", "%", 0.0, 100.0},
              Axis{"events over events up to the peak", "%", 0.0, 100.0}};
  Series model{"model", Mark::line, Role::model}, measured{laboratory.name, Mark::line, Role::laboratory};
  constexpr int steps = 100;
  for (int i = 0; i <= steps; ++i) {
    const double part = static_cast<double>(i) / steps;
    model.points.push_back({100.0 * part, 100.0 * ours.share(part)});
    measured.points.push_back({100.0 * part, 100.0 * theirs.share(part)});
  }
  panel.series = {model, measured};
  panel.caption = text_of_counts(events::compared(ours, theirs));
  return panel;
}

bool has_events(const SpecimenRecord& t) { return !events::magnitudes_of(t.result.events).empty(); }

}  // namespace

Figure events_figure(const RunRecord& run, const LaboratoryCounts& laboratory) {
  Figure figure;
  for (const SpecimenRecord& t : run.tests) {
    if (!has_events(t)) continue;
    figure.panels.push_back(frequency_panel(t));
    if (!laboratory.curve.rows.empty()) figure.panels.push_back(counts_panel(t, laboratory));
  }
  fit_axes(figure);
  return figure;
}

Figure event_places_figure(const RunRecord& run) {
  Figure figure;
  for (const SpecimenRecord& t : run.tests)
    if (has_events(t)) figure.panels.push_back(places_panel(t));
  return figure;
}

}  // namespace phy::report
