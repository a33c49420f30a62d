#include "report/rock_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "records/test_description.hpp"
#include "report/angle_panels.hpp"
#include "report/calibration_figures.hpp"
#include "report/calibration_summary.hpp"
#include "report/curves.hpp"
#include "report/run_figures.hpp"

namespace phy::report {
namespace {

/// What a specimen came to, as cells of a table, what its test is made for first. Without a number no cell.
std::vector<Target> cells_of(const SpecimenRecord& s) {
  const TestDescription& test = *s.recipe.test.kind;
  std::vector<Target> cells;
  for (const MeasuredProperty& p : measured_properties()) {
    // a share of another property is that one again
    if (p.test == nullptr || std::string_view(p.test) != test.name || p.share != 1.0) continue;
    Target t{.property = p.property, .theta = s.result.theta, .mean = value_of(s, p.number)};
    if (test.kept_stress.value != nullptr) t.confining = s.recipe.test.*test.kept_stress.value;
    if (p.of_discs) t.diameter = s.recipe.test.disc_diameter;
    if (std::isfinite(t.mean)) cells.push_back(t);
  }
  return cells;
}

/// A table that says nothing of the size of its discs means the model's.
bool same_place(const Target& of_table, Target t) {
  if (of_table.diameter == 0.0) t.diameter = 0.0;
  return same_panel(of_table, t);
}

/// Panels of the figure, and of which cells each is.
struct Panels {
  Figure figure;
  std::vector<Target> of;
  bool has(const Target& t) const {
    return std::any_of(of.begin(), of.end(), [&](const Target& k) { return same_place(k, t); });
  }
  Panel& at(const Target& t) {
    for (std::size_t i = 0; i < of.size(); ++i)
      if (same_place(of[i], t)) return figure.panels[i];
    of.push_back(t), figure.panels.emplace_back();
    Panel& panel = figure.panels.back();
    panel.y = axis_of(t.property);
    if (measured(t.property).along_bedding)
      panel.x = {"normal stress σ_n", "MPa"};
    else if (panel.title = particulars(t); !panel.title.empty())
      panel.title.erase(0, 2);  // ", "
    return panel;
  }
};

/// Of one name and number everywhere: a test looks alike in all panels.
Series series_of(const NamedRun& test, std::size_t number, Mark mark) {
  Series s{test.name, mark, Role::listed, number};
  return s;
}

Series points_of(const NamedRun& test, std::size_t number, const Target& cell, bool intact) {
  const double value = measured(cell.property).shown.factor * cell.mean;
  Series points = series_of(test, number, Mark::points);
  points.points = {{place_in_panel(cell), value}};
  if (intact && !measured(cell.property).along_bedding)  // at no angle more than at another
    points.mark = Mark::line, points.points = {{0.0, value}, {90.0, value}};
  return points;
}

/// What a test is made for has a panel in any case, the rest where the table has one.
void add_points(const NamedRun& test, std::size_t number, Panels& panels) {
  for (const SpecimenRecord& s : test.run.tests) {
    const std::vector<Target> cells = cells_of(s);
    for (const Target& cell : cells)
      if (&cell == &cells.front() || panels.has(cell))
        panels.at(cell).series.push_back(points_of(test, number, cell, s.result.intact));
  }
}

Figure over_theta(const std::optional<Calibration>& c, const std::vector<Target>& laboratory,
                  const std::vector<NamedRun>& tests) {
  std::vector<Target> table = laboratory;
  if (c) {
    table.clear();
    for (const Comparison& row : c->fitted) table.push_back(row.target);
  }
  Panels panels;
  panels.figure = c ? calibration_figure(*c) : laboratory_figure(table);
  for (const Target& t : table)
    if (std::none_of(panels.of.begin(), panels.of.end(), [&](const Target& k) { return same_panel(k, t); }))
      panels.of.push_back(t);
  for (std::size_t i = 0; i < tests.size(); ++i) add_points(tests[i], i, panels);
  for (Panel& p : panels.figure.panels) {
    p.y.high = nan;  // open again: tests may be stronger than the table
    if (p.x.quantity == "inclination θ") p.x = {};
  }
  fit_over_angles(panels.figure);
  return std::move(panels.figure);
}

Figure curves_of(const std::vector<NamedRun>& tests) {
  Figure figure;
  figure.aspect = 0.6;
  std::vector<const TestDescription*> kinds;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    const std::vector<SpecimenRecord>& some = tests[i].run.tests;
    if (some.empty()) continue;
    const TestDescription* kind = &*some.front().recipe.test.kind;
    auto it = std::find(kinds.begin(), kinds.end(), kind);
    if (it == kinds.end()) {
      it = kinds.insert(kinds.end(), kind);
      figure.panels.push_back(curve_panel(kind->curve));
      figure.panels.back().title = kind->name;
      std::replace(figure.panels.back().title.begin(), figure.panels.back().title.end(), '_', ' ');
    }
    Panel& panel = figure.panels[static_cast<std::size_t>(it - kinds.begin())];
    for (const Series& of_run : stress_strain_figure(tests[i].run).panels.front().series) {
      if (of_run.mark != Mark::line && of_run.mark != Mark::text) continue;
      Series s = series_of(tests[i], i, of_run.mark);
      s.points = of_run.points;
      if (s.mark == Mark::text) s.name.clear();
      panel.series.push_back(std::move(s));
    }
  }
  fit_axes(figure);
  return figure;
}

bool has_sigma_1(const Target& t) { return t.property == Property::ucs || t.property == Property::confined; }

std::string angle_name(const char* who, double theta) { return fmt::format("{}, θ = {:g}°", who, theta); }

/// Points of one angle over the stress on the sides.
void add_strength(const Target& t, const char* who, Mark mark, Role role, Panel& panel) {
  const std::string name = angle_name(who, t.theta);
  auto it =
      std::find_if(panel.series.begin(), panel.series.end(), [&](const Series& s) { return s.name == name; });
  if (it == panel.series.end()) {
    Series s{name, mark, role, static_cast<std::size_t>(t.theta / 15.0)};
    s.shade = t.theta / 90.0;
    it = panel.series.insert(it, s);
  }
  it->points.push_back({1e-6 * t.confining, 1e-6 * t.mean});
}

Figure over_sigma_3(const std::optional<Calibration>& c, const std::vector<Target>& laboratory,
                    const std::vector<NamedRun>& tests) {
  Panel panel{"", "", Axis{"confining stress σ_3", "MPa", 0.0}, Axis{"strength σ_1", "MPa"}};
  std::vector<Target> model;
  for (const NamedRun& test : tests)
    for (const SpecimenRecord& s : test.run.tests)
      for (const Target& cell : cells_of(s))
        if (has_sigma_1(cell) && !s.result.intact) model.push_back(cell);
  std::set<double> stresses;
  for (const Target& t : model) stresses.insert(t.confining);
  if (c)
    for (const Comparison& fitted : c->fitted)
      if (const Comparison& row = judged(*c, fitted); has_sigma_1(row.target) && row.answered()) {
        model.push_back(row.target);
        model.back().mean = row.mean;
        stresses.insert(row.target.confining);
      }
  if (stresses.size() < 2) return {};
  for (const Target& t : laboratory)
    if (has_sigma_1(t)) add_strength(t, "laboratory", Mark::points, Role::laboratory, panel);
  for (const Target& t : model) add_strength(t, "model", Mark::points, Role::ordered, panel);
  Figure figure{{std::move(panel)}};
  figure.aspect = 0.6;
  fit_axes(figure);
  return figure;
}

}  // namespace

RockResults rock_results(const std::optional<Calibration>& calibration, const std::vector<Target>& laboratory,
                         const std::vector<NamedRun>& tests) {
  return {over_theta(calibration, laboratory, tests), curves_of(tests),
          over_sigma_3(calibration, laboratory, tests)};
}

}  // namespace phy::report
