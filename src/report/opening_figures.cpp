#include "report/opening_figures.hpp"

#include "base/exact_math.hpp"
#include "base/nan.hpp"
#include "report/run_figures.hpp"
#include "theory/opening.hpp"

namespace phy::report {
namespace {

constexpr double MPa = 1e-6;

Panel closure_panel(const RunRecord& run) {
  Panel panel{"", "", Axis{"closure over the radius", "%"}, Axis{"vertical stress borne", "MPa"}};
  for (std::size_t i = 0; i < run.tests.size(); ++i) {
    const TestResult& r = run.tests[i].result;
    if (r.wall.empty()) continue;
    Series s = series_of(r, Mark::line, static_cast<int>(i));
    s.name = heading(r);
    for (const HistoryRow& row : r.history.rows)
      s.points.push_back({100.0 * row.closure, MPa * row.borne_stress});
    panel.series.push_back(std::move(s));
  }
  return panel;
}

/// Over the direction, of one moment.
template <class Value>
Series around(const TestResult& r, WallMoment moment, Series s, const Value& value) {
  for (const WallPoint& p : r.wall)
    if (p.moment == moment) s.points.push_back({p.angle, value(p)});
  return s;
}

Axis direction() { return {"direction from the horizontal", "deg", 0.0, 360.0, 90.0}; }

double number_of(const SpecimenRecord& t, const char* name) {
  for (const Number& n : t.result.numbers)
    if (n.name == name) return n.value;
  return nan;
}

Panel hoop_panel(const SpecimenRecord& t) {
  Panel panel{heading(t.result), "", direction(), Axis{"hoop stress behind the wall", "MPa"}};
  panel.series.push_back(around(t.result, WallMoment::standing, {"model", Mark::points, Role::model},
                                [](const WallPoint& p) { return MPa * p.hoop; }));
  const TestRecipe& test = t.recipe.test;
  // Where it is, is certain of an untrusted test too.
  const double radius = 0.5 * number_of(t, "hole_diameter"), r = radius + number_of(t, "hoop_distance");
  // A folder that somebody has changed may not say.
  if (!(radius > 0.0) || !(r > radius)) return panel;
  Series theory{"Kirsch, isotropic", Mark::line, Role::theory};
  const Vec2 far = test.far_field();
  const theory::Opening opening{radius, {far.x, far.y, 0.0}, test.internal_pressure};
  for (double angle = 0.0; angle <= 360.0; angle += 5.0) {
    const SinCos at = sin_cos_degrees(angle);
    theory.points.push_back(
        {angle, MPa * theory::polar(theory::kirsch(opening, r * at.cos, r * at.sin), angle).hoop});
  }
  panel.series.push_back(std::move(theory));
  return panel;
}

Panel breakout_panel(const SpecimenRecord& t) {
  Panel panel{heading(t.result), "", direction(), Axis{"depth of breakout", "mm"}};
  const auto depth = [](const WallPoint& p) { return 1e3 * p.breakout; };
  panel.series.push_back(
      around(t.result, WallMoment::standing, {"excavated", Mark::line, Role::level}, depth));
  panel.series.push_back(around(t.result, WallMoment::end, {"at the end", Mark::line, Role::model}, depth));
  return panel;
}

}  // namespace

Figure opening_figure(const RunRecord& run) {
  Figure figure;
  Panel closure = closure_panel(run);
  if (closure.series.empty()) return figure;
  figure.panels.push_back(std::move(closure));
  for (const SpecimenRecord& t : run.tests) {
    if (t.result.wall.empty()) continue;
    figure.panels.push_back(hoop_panel(t));
    figure.panels.push_back(breakout_panel(t));
  }
  fit_axes(figure);
  return figure;
}

}  // namespace phy::report
