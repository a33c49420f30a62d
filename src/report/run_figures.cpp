#include "report/run_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "report/angle_panels.hpp"
#include "report/curves.hpp"
#include "report/palette.hpp"
#include "report/specimen_picture.hpp"

namespace phy::report {
namespace {

constexpr std::size_t most_points = 900;  // of a curve: more is not seen on paper or screen

const TestCurve& axes_of(const RunRecord& run) {
  // Even an empty figure needs names of its axes.
  return (run.tests.empty() ? TestKind() : run.tests.front().recipe.test.kind)->curve;
}

/// Stress over strain in the units of the axes, thinned; the peak and the end stay.
std::vector<Point> curve_of(const SpecimenRecord& t) {
  const TestCurve& axes = t.recipe.test.kind->curve;
  const auto& rows = t.result.history.rows;
  // By rows: the fast approach has few of them, the peak many.
  const std::size_t step = std::max<std::size_t>(1, rows.size() / most_points);
  const auto lower = [&](const HistoryRow& a, const HistoryRow& b) {
    return axes.stress_of(a) < axes.stress_of(b);
  };
  const auto peak = std::max_element(rows.begin(), rows.end(), lower) - rows.begin();
  std::vector<Point> points;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (i % step == 0 || static_cast<std::ptrdiff_t>(i) == peak || i + 1 == rows.size())
      points.push_back({axes.strain_factor * axes.strain_of(rows[i]), 1e-6 * axes.stress_of(rows[i])});
  return points;
}

const Point& peak_of(const std::vector<Point>& curve) {
  return *std::max_element(curve.begin(), curve.end(),
                           [](const Point& a, const Point& b) { return a.y < b.y; });
}

/// As it was read, of a test that is not to be trusted too: the curve shows from what.
double as_read(const SpecimenRecord& t, const std::string& name) {
  for (const Number& n : t.result.numbers)
    if (n.name == name) return n.value;
  return nan;
}

/// Where a curve first reaches the stresses of damage and its strength, a series each.
std::vector<Series> levels_of(const SpecimenRecord& t, int item) {
  const TestCurve& axes = t.recipe.test.kind->curve;
  const std::array<std::array<std::string, 2>, 3> levels = {
      {{"sigma_ci", "σ_ci"}, {"sigma_cd", "σ_cd"}, {axes.strength, axes.strength_label}}};
  std::vector<Series> all;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double level = as_read(t, levels[k][0]);
    for (const HistoryRow& row : t.result.history.rows) {
      // Negated, so that a level of NaN is passed over as well.
      if (!(axes.stress_of(row) >= level)) continue;
      Series s = series_of(t.result, Mark::points, item);
      s.name = levels[k][1], s.role = Role::level, s.number = k;
      s.points = {{axes.strain_factor * axes.strain_of(row), 1e-6 * level}};
      all.push_back(s);
      break;
    }
  }
  return all;
}

void add(Panel& panel, std::vector<Series> some) {
  for (Series& s : some) panel.series.push_back(std::move(s));
}

std::string short_label(const TestResult& r) { return r.intact ? "intact" : fmt::format("{:g}°", r.theta); }

/// Cracks by kind up to a strain, one kind upon the other.
std::vector<Series> crack_bands(const SpecimenRecord& t) {
  constexpr double steps = 160.0;
  const TestCurve& axes = t.recipe.test.kind->curve;
  const auto& cracks = t.result.cracks;  // ordered by step
  std::vector<Series> bands(crack_names.size());
  for (std::size_t kind = 0; kind < bands.size(); ++kind)
    bands[kind].name = crack_names[kind], bands[kind].mark = Mark::band, bands[kind].role = Role::crack,
    bands[kind].number = kind, bands[kind].right = true;
  std::array<double, crack_names.size()> counts = {};
  std::size_t next = 0;
  for (double k = 0.0; k <= steps; k += 1.0) {
    const double strain = last_strain(t) * (k / steps);  // at the end exactly that: no crack is left out
    for (; next < cracks.size() && axes.sign * cracks[next].strain <= strain; ++next)
      counts[crack_kind(cracks[next])] += 1.0;
    double below = 0.0;
    for (std::size_t kind = 0; kind < bands.size(); ++kind) {
      bands[kind].points.push_back({axes.strain_factor * strain, nan, below, below + counts[kind]});
      below += counts[kind];
    }
  }
  return bands;
}

Panel damage_panel(const SpecimenRecord& t, int item) {
  Panel panel = curve_panel(t.recipe.test.kind->curve);
  panel.title = heading(t.result);
  panel.right = Axis{"cracks", "", 0.0};
  // Bands end with the test; a round number behind it would look like strain without cracks.
  if (last_strain(t) > 0.0) panel.x.high = t.recipe.test.kind->curve.strain_factor * last_strain(t);
  add(panel, crack_bands(t));
  Series stress{panel.y.quantity, Mark::line, Role::plain};
  stress.item = item, stress.points = curve_of(t);
  panel.series.push_back(stress);
  for (Series& s : levels_of(t, item)) {
    // One specimen per panel: its shade of the angle would tell nothing here.
    s.shade = nan;
    panel.series.push_back(s);
  }
  return panel;
}

// --- roses

/// Both ways of a direction on a circle about the middle; `degrees` anticlockwise from +x.
Point at(double radius, double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  return {radius * std::cos(a), radius * std::sin(a)};
}

/// Corners of the petals; each begins and ends in the middle.
std::vector<Point> petals(const Rose& r, double largest, bool shear_only) {
  std::vector<Point> points;
  // A crack points both ways, so each petal is drawn twice.
  for (std::size_t i = 0; i < 2 * r.tension.size(); ++i) {
    const std::size_t k = i % r.tension.size();
    const double count = r.shear[k] + (shear_only ? 0.0 : r.tension[k]);
    if (count == 0.0) continue;
    // Areas and not radii are in proportion to numbers, since the eye compares areas.
    const double from = (static_cast<double>(i) - 0.5) * r.bin(), radius = std::sqrt(count / largest);
    points.push_back({0.0, 0.0});
    constexpr int chords = 4;  // of the arc
    for (int c = 0; c <= chords; ++c) points.push_back(at(radius, from + r.bin() * c / chords));
    points.push_back({0.0, 0.0});
  }
  return points;
}

Panel rose_panel(const SpecimenRecord& t) {
  const Rose rose = crack_rose(t.result.cracks);
  double largest = 1.0;
  for (std::size_t i = 0; i < rose.tension.size(); ++i)
    largest = std::max(largest, rose.tension[i] + rose.shear[i]);
  constexpr double room = 1.2;  // the circle has a radius of 1
  Panel panel{fmt::format("{}, n = {}", heading(t.result), t.result.cracks.size()), "",
              Axis{"", "", -room, room}, Axis{"", "", -room, room}};
  panel.framed = false;
  Series outer{"", Mark::line, Role::frame}, inner = outer;
  for (int angle = 0; angle <= 360; angle += 5)
    outer.points.push_back(at(1.0, angle)), inner.points.push_back(at(0.5, angle));
  Series tension{"tension", Mark::area, Role::crack}, shear{"shear", Mark::area, Role::crack, 1};
  // All cracks below, shear upon them: what is left uncovered is tension.
  tension.points = petals(rose, largest, false), shear.points = petals(rose, largest, true);
  Series directions{"", Mark::text, Role::frame};
  directions.points = {{1.08, 0.0, nan, nan, "0°"}, {0.0, 1.02, nan, nan, "90°"}};
  panel.series = {inner, outer, tension, shear, directions};
  if (!t.result.intact) {
    Series bedding{"bedding", Mark::line, Role::bedding};
    bedding.points = {at(1.13, t.result.theta), at(1.13, t.result.theta + 180.0)};
    panel.series.push_back(bedding);
  }
  return panel;
}

// --- over the inclination

struct RunNumber {
  std::string number;  ///< among those of a result
  Axis axis;
  double factor;
  std::optional<Property> property;
  const AngleCurve* curve;
};

/// Without series where no specimen with layers has the number.
Panel panel_of(const RunRecord& run, const std::vector<Target>& table, const RunNumber& n,
               const std::string& theory) {
  Panel panel{"", n.curve->note, {}, n.axis};
  Series intact{"intact", Mark::line, Role::intact}, model{"model", Mark::points, Role::model};
  const auto laboratory_of = [&](double theta) {
    const auto is = [&](const Target& t) { return n.property == t.property && t.theta == theta; };
    const auto it = std::find_if(table.begin(), table.end(), is);
    return it == table.end() ? nullptr : &*it;
  };
  for (const SpecimenRecord& t : run.tests) {
    const double v = value_of(t, n.number);
    if (!std::isfinite(v)) continue;
    if (t.result.intact)
      // Intact rock has no angle: a line across all of them.
      intact.points = {{0.0, n.factor * v}, {90.0, n.factor * v}};
    else
      model.points.push_back(
          {t.result.theta, n.factor * v, nan, nan, error_beside(v, laboratory_of(t.result.theta))});
  }
  // Without a model's value a laboratory's alone would be no comparison.
  if (model.points.empty()) return panel;
  Series laboratory = laboratory_series();
  for (const Target& t : table)
    if (n.property == t.property) laboratory.points.push_back(point_of(t, n.factor));
  panel.series = {intact, theory_series(theory, *n.curve, n.factor), laboratory, model};
  return panel;
}

}  // namespace

std::string heading(const TestResult& r) { return r.intact ? "intact" : fmt::format("θ = {:g}°", r.theta); }

Series series_of(const TestResult& r, Mark mark, int item) {
  Series s;
  s.mark = mark, s.item = item, s.number = static_cast<std::size_t>(std::max(0, item));
  s.role = r.intact ? Role::intact : Role::ordered;
  // By the angle itself, so that 30 degrees has one colour in all figures.
  if (!r.intact) s.shade = part_of_ninety(r.theta);
  return s;
}

Panel curve_panel(const TestCurve& curve) {
  return {"", "", Axis{curve.strain, curve.strain_unit}, Axis{curve.stress, "MPa"}};
}

Figure stress_strain_figure(const RunRecord& run) {
  Panel panel = curve_panel(axes_of(run));
  std::vector<Series> labels;
  double strongest = 0.0, farthest = 0.0;
  for (std::size_t i = 0; i < run.tests.size(); ++i) {
    const SpecimenRecord& t = run.tests[i];
    Series s = series_of(t.result, Mark::line, static_cast<int>(i)), label = s;
    s.name = heading(t.result), s.points = curve_of(t);
    if (s.points.empty()) continue;
    label.mark = Mark::text, label.points = {peak_of(s.points)};
    label.points.front().text = short_label(t.result);
    strongest = std::max(strongest, label.points.front().y), farthest = std::max(farthest, s.points.back().x);
    panel.series.push_back(std::move(s)), labels.push_back(std::move(label));
  }
  for (std::size_t i = 0; i < run.tests.size(); ++i) add(panel, levels_of(run.tests[i], static_cast<int>(i)));
  // Labels last, above all curves.
  add(panel, std::move(labels));
  // Labels stand above the peaks, and the strongest would leave the picture.
  constexpr double room_for_labels = 1.12, room_at_the_end = 1.02;
  if (strongest > 0.0) panel.y.high = room_for_labels * strongest;
  if (farthest > 0.0) panel.x.high = room_at_the_end * farthest;
  Figure figure{{panel}, Key::shared, 0.52};
  fit_axes(figure);
  return figure;
}

Figure damage_figure(const RunRecord& run) {
  Figure figure;
  for (std::size_t i = 0; i < run.tests.size(); ++i)
    figure.panels.push_back(damage_panel(run.tests[i], static_cast<int>(i)));
  fit_axes(figure);
  return figure;
}

Figure modes_figure(const RunRecord& run) {
  constexpr double bar = 0.78;
  Panel panel{"", "", Axis{"specimen"}, Axis{"share of cracks", "%", 0.0, 100.0}};
  for (std::size_t kind = 0; kind < crack_names.size(); ++kind) {
    Series s{crack_names[kind], Mark::boxes, Role::crack, kind};
    s.width = bar;
    panel.series.push_back(s);
  }
  for (std::size_t i = 0; i < run.tests.size(); ++i) {
    const auto& cracks = run.tests[i].result.cracks;
    panel.x.names.push_back(short_label(run.tests[i].result));
    double below = 0.0;
    // A specimen without cracks keeps its place, empty: 0 of 0 is no share.
    for (std::size_t kind = 0; kind < crack_names.size() && !cracks.empty(); ++kind) {
      const auto n = std::count_if(cracks.begin(), cracks.end(),
                                   [&](const CrackEvent& c) { return crack_kind(c) == kind; });
      const double share = 100.0 * static_cast<double>(n) / static_cast<double>(cracks.size());
      panel.series[kind].points.push_back(
          {static_cast<double>(i), nan, below, below + share, fmt::format("{} cracks, {:.1f} %", n, share)});
      below += share;
    }
  }
  panel.x.low = -0.5, panel.x.high = static_cast<double>(run.tests.size()) - 0.5;
  return {{panel}};
}

Figure rose_figure(const RunRecord& run) {
  Figure figure;
  for (const SpecimenRecord& t : run.tests) figure.panels.push_back(rose_panel(t));
  return figure;
}

Figure anisotropy_figure(const RunRecord& run, const std::vector<Target>& laboratory) {
  const TheoryCurves curves = theory_curves(run);
  const TestKind kind = run.tests.empty() ? TestKind() : run.tests.front().recipe.test.kind;
  const TestQuantity made_for = kind->curve.quantity();
  const std::vector<Target> table = beside(run, laboratory);
  const AngleCurve none;
  // Jaeger's curve is of compression; the strength of another test has none.
  const bool axial = kind->property() == Property::ucs;
  Axis E = axis_of(Property::E);
  // The laboratory's E may be another slope, and the axis must say which one the run has.
  E.quantity += ", tangent at 50 %";
  const RunNumber all[] = {{"E_tangent", E, measured(Property::E).shown.factor, Property::E, &curves.E},
                           {made_for.number, Axis{made_for.label, made_for.unit}, made_for.scale,
                            kind->property(), axial ? &curves.ucs : &none},
                           {"nu", axis_of(Property::nu), 1.0, Property::nu, &curves.nu}};
  Figure figure;
  for (const RunNumber& n : all)
    if (Panel panel = panel_of(run, table, n, theory_name(curves, "model")); !panel.series.empty())
      figure.panels.push_back(std::move(panel));
  fit_over_angles(figure);
  return figure;
}

Figure two_curves_figure(const History& ours, const History& theirs, const std::string& their_name) {
  // Uniaxial compression, the only curve that foreign files are read for.
  Panel panel = curve_panel(TestCurve{});
  const auto add_curve = [&](const History& h, const std::string& name, Role role) {
    Series s{name, Mark::line, role};
    for (const HistoryRow& r : h.rows) s.points.push_back({100.0 * r.axial_strain, 1e-6 * r.axial_stress});
    panel.series.push_back(s);
  };
  add_curve(ours, "Phyllite", Role::model), add_curve(theirs, their_name, Role::theory);
  Figure figure{{panel}, Key::shared, 0.62};
  fit_axes(figure);
  return figure;
}

}  // namespace phy::report
