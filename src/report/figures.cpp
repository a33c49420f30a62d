#include "report/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/check.hpp"
#include "base/option.hpp"
#include "base/quote.hpp"
#include "base/spelling.hpp"
#include "base/text_table.hpp"
#include "report/calibration_figures.hpp"
#include "report/gnuplot_figure.hpp"
#include "report/opening_figures.hpp"
#include "report/run_figures.hpp"
#include "report/specimen_figures.hpp"
#include "report/terminal_plot.hpp"
#include "report/variation_figures.hpp"

namespace phy::report {
namespace {

Figure stress_strain(const FigureData& data) {
  Figure figure = stress_strain_figure(data.run);
  // Empty axes would look like a fault of the drawing: say what the test lacks.
  if (!figure.panels.front().series.empty()) return figure;
  const Outcome o = data.run.tests.empty() ? Outcome{} : data.run.tests.front().result.outcome;
  throw InputError(Problem{"result", "", "", "a test that was loaded", o.reason + "; " + o.advice});
}

Figure anisotropy(const FigureData& data) {
  Figure figure =
      data.calibration ? calibration_figure(*data.calibration) : anisotropy_figure(data.run, data.laboratory);
  if (!figure.panels.empty()) return figure;
  if (data.calibration)
    throw InputError(
        Problem{data.calibration->rock, "fitted", "", "values of a laboratory", "calibrate the rock again"});
  // an untrusted test has no place over the angle: what it lacks is no angle
  for (const SpecimenRecord& t : data.run.tests)
    if (const Outcome& o = t.result.outcome; o.status == Status::untrusted)
      throw InputError(
          Problem{"result", "", t.result.name, "a test that can be trusted", o.reason + "; " + o.advice});
  throw InputError(Problem{"result", "theta", "", "specimens with layers and with numbers",
                           "run a recipe with [[bedding]] or a foliated matrix, and test.angles"});
}

/// Throws InputError where the run has no events.
Figure with_events(Figure figure, const RunRecord& run) {
  if (!figure.panels.empty()) return figure;
  const bool asked = std::ranges::any_of(run.tests, [](const auto& t) { return t.recipe.test.events; });
  throw InputError(Problem{"result", "events.csv", "", "acoustic events",
                           asked ? "no bond of a test with events = true broke: load it further"
                                 : "run the recipe again with events = true in [test]"});
}

Figure events_of_run(const FigureData& data) {
  return with_events(events_figure(data.run, data.counts), data.run);
}
Figure event_places(const FigureData& data) { return with_events(event_places_figure(data.run), data.run); }

Figure openings(const FigureData& data) {
  Figure figure = opening_figure(data.run);
  if (!figure.panels.empty()) return figure;
  for (const SpecimenRecord& t : data.run.tests)
    if (t.recipe.test.kind == TestKind("opening"))
      throw InputError(Problem{"result", "", t.result.name, "an opening that was excavated",
                               t.result.outcome.reason + "; " + t.result.outcome.advice});
  throw InputError(Problem{"result", "opening.csv", "", "openings under stress",
                           "run a recipe with kind = \"opening\" in [test]"});
}

template <Figure (*make)(const RunRecord&)>
Figure of_run(const FigureData& data) {
  return make(data.run);
}
template <Figure (*make)(const Variation&)>
Figure of_study(const FigureData& data) {
  return make(data.variation);
}

}  // namespace

const std::vector<FigureKind>& figure_kinds() {
  static const std::vector<FigureKind> kinds = {
      {"stress_strain", "", "stress over strain of a run, with sigma_ci, sigma_cd and UCS", 140.0, false,
       stress_strain},
      {"damage", "", "stress and cracks by kind over strain, a panel per specimen of a run", 190.0, false,
       of_run<damage_figure>},
      // Of a calibration too: the one kind that both have.
      {"anisotropy", "",
       "E, strengths, nu over the inclination: a run, or a calibration beside its laboratory", 190.0, false,
       anisotropy},
      {"modes", "", "share of each kind of crack in the specimens of a run", 90.0, false,
       of_run<modes_figure>},
      {"rose", "", "directions of the cracks of a run", 190.0, false, of_run<rose_figure>},
      {"events", "", "acoustic events of a run: how many are how large, with the b-value", 140.0, false,
       events_of_run},
      {"event_places", "", "where the acoustic events of a run were, by source and magnitude", 190.0, false,
       event_places},
      {"opening", "", "openings of a run: stress over closure, hoop stress and breakout around them", 190.0,
       false, openings},
      // No `make`: pictures of discs are pixels and go their own way.
      {"cracks", "", "specimens of a run at the end, cracks by mode and place", 190.0, false, nullptr,
       draw_cracks},
      {"model", "fig2", "one specimen of a run with its bedding", 90.0, false, nullptr, draw_model},
      {"specimens", "fig3", "specimens of a run before the test", 190.0, false, nullptr, draw_specimens},
      {"stiffness", "fig4", "macro stiffnesses K_n, K_s over the parameters of a study", 190.0, true,
       of_study<stiffness_figure>},
      {"modulus", "fig5", "E over the inclination, per value of a study", 190.0, true,
       of_study<modulus_figure>},
      {"strength", "fig6", "UCS over the inclination, per value of a study", 190.0, true,
       of_study<strength_figure>}};
  return kinds;
}

const FigureKind& figure_kind(const std::string& word) {
  std::vector<std::string> names;
  std::string list;
  for (const FigureKind& k : figure_kinds()) {
    // Readers of the paper ask for its figure by number.
    if (word == k.name || (*k.paper != 0 && word == k.paper)) return k;
    names.emplace_back(k.name);
    list += (list.empty() ? "" : ", ") + names.back();
  }
  // Who names what a table of the laboratory holds means its course.
  constexpr std::string_view of_table[] = {"UCS", "ucs", "BTS", "bts", "DTS", "dts", "E", "nu", "theta"};
  const bool is_of_table = std::find(std::begin(of_table), std::end(of_table), word) != std::end(of_table);
  const std::string near = is_of_table ? "anisotropy" : nearest(word, names);
  throw InputError(
      option_problem("kind", word, "one of " + list, near.empty() ? "" : "did you mean " + near + "?"));
}

std::string figure_script(const FigureKind& kind, const FigureData& data, Sheet sheet) {
  if (sheet.width == 0.0) sheet.width = kind.width;
  if (kind.make != nullptr) return gnuplot_script(kind.make(data), sheet);
  if (sheet.height != 0.0)
    throw InputError(Problem{"command line", "--size", fmt::format("{:g}x{:g}", sheet.width, sheet.height),
                             "a width alone", "pictures of specimens are as high as the specimens"});
  GnuplotScript script;
  // The picture is made first: its height follows from the specimen, and the head has to name it.
  sheet.height = kind.picture(script, data.run, sheet.width);
  return gnuplot_head(sheet) + script.text();
}

std::string figure_csv(const FigureKind& kind, const FigureData& data) {
  if (kind.make == nullptr)
    throw InputError(Problem{"command line", "--data", "", "a kind with axes",
                             "pictures show discs.csv and cracks.csv of the folder"});
  const auto number = [](double x) { return std::isfinite(x) ? fmt::format("{:.8g}", x) : ""; };
  std::string text = "panel,series,x_axis,y_axis,x,y,low,high,text\n";
  char letter = 'a';  // as the figure numbers its panels
  for (const Panel& panel : kind.make(data).panels) {
    const std::string title = panel.title.empty() ? std::string(1, letter) : panel.title;
    ++letter;
    for (const Series& s : panel.series)
      for (const Point& p : s.points)
        text += fmt::format("{},{},{},{},{},{},{},{},{}\n", csv_cell(title), csv_cell(s.name),
                            csv_cell(panel.x.label()), csv_cell((s.right ? *panel.right : panel.y).label()),
                            number(p.x), number(p.y), number(p.low), number(p.high), csv_cell(p.text));
  }
  return text;
}

std::string figure_text(const FigureKind& kind, const FigureData& data, int columns) {
  if (kind.make == nullptr)
    throw InputError(Problem{"command line", "--format", "terminal", "svg, pdf or png",
                             "specimens are pictures of discs, too fine for a terminal"});
  // Fits with caption into a terminal of 24 lines.
  constexpr int rows = 20;
  std::string text;
  for (const Panel& panel : kind.make(data).panels) {
    // Without colours: what is printed here is mostly redirected into a file or pasted.
    for (const std::string& line : terminal_plot(panel, columns, rows, false)) text += line + "\n";
    text += panel.caption.empty() ? "\n" : wrapped(panel.caption, columns) + "\n\n";
  }
  return text;
}

}  // namespace phy::report
