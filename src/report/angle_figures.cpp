#include "report/angle_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "base/check.hpp"
#include "base/quote.hpp"
#include "base/stats.hpp"
#include "records/test_description.hpp"
#include "report/calibration_summary.hpp"
#include "report/curves.hpp"
#include "report/panel_grid.hpp"

namespace phy::report {
namespace {

using Row = GnuplotScript::Row;

/// What a panel may show, in the order in which it is drawn.
struct Series {
  enum : std::size_t { band, theory, single, laboratory, model, left_out, n };
};
constexpr std::array<const char*, Series::n> looks = {
    "with boxxyerror fs solid 1.0 noborder lc rgb '#c4dcee'",
    "with lines dt 2 lw 1.5 lc rgb '#9a3f7d'",
    "with points pt 7 ps 0.22 lc rgb '#555555'",
    "with yerrorbars pt 12 ps 0.8 lw 1.2 lc rgb '#222222'",
    "with points pt 7 ps 0.6 lc rgb '#0072b2'",
    "with points pt 2 ps 0.6 lw 1.6 lc rgb '#d55e00'"};
using Titles = std::array<std::string, Series::n>;

std::string theory_title(const TheoryCurves& curves, const char* fitted_to) {
  const char* const by = curves.E.theta.empty()     ? "Jaeger"
                         : curves.ucs.theta.empty() ? "Goodman"
                                                    : "Goodman, Jaeger";
  return fmt::format("{} fitted to the {}", by, fitted_to);
}

struct AnglePanel {
  std::string label;  ///< of the ordinate
  std::string which;  ///< what the tests have of their own: "10 MPa"
  std::array<std::vector<Row>, Series::n> rows;
};

std::size_t n_drawn(const AnglePanel& p) {
  return Series::n - static_cast<std::size_t>(std::count_if(p.rows.begin(), p.rows.end(),
                                                            [](const auto& r) { return r.empty(); }));
}

std::vector<Row> rows_of(const AngleCurve& curve, double factor) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < curve.theta.size(); ++i)
    rows.push_back({curve.theta[i], factor * curve.value[i]});
  return rows;
}

Row row_with_bar(const Target& t, double factor) {
  const double half = z_95 * t.standard_error();
  return {t.theta, factor * t.mean, factor * (t.mean - half), factor * (t.mean + half)};
}

/// One key for all panels, in as few rows above them as the width allows; points alone need none.
struct PanelKey {
  std::vector<std::string> parts;  ///< of the plot that draws it
  double height = 0.0;             ///< [mm]
};
PanelKey begin_key(GnuplotScript& s, const std::vector<AnglePanel>& panels, const Titles& titles,
                   double width) {
  PanelKey key;
  const bool alone = std::all_of(panels.begin(), panels.end(), [](const auto& p) { return n_drawn(p) == 1; });
  std::size_t longest = 0;
  for (std::size_t k = 0; k < Series::n && !alone; ++k) {
    if (std::all_of(panels.begin(), panels.end(), [&](const auto& p) { return p.rows[k].empty(); })) continue;
    key.parts.push_back(std::string("keyentry ") + looks[k] + " title " + gnuplot_string(titles[k]));
    longest = std::max(longest, titles[k].size());
  }
  if (key.parts.empty()) return s.add("unset key"), key;
  const double column = 12.0 + 1.3 * static_cast<double>(longest);  // [mm], letters of 7 points
  const auto columns = static_cast<std::size_t>(std::max(1.0, width / column));
  const std::size_t rows = (key.parts.size() + columns - 1) / columns;
  s.add("set key at screen 0.06,screen 0.995 left top vertical maxrows {} reverse Left samplen 2.4 width -4",
        rows);
  key.height = 1.0 + 3.4 * static_cast<double>(rows);
  return key;
}

/// Of the drawn angles, 90 degrees at least.
double farthest(const std::vector<AnglePanel>& panels) {
  double far = 90.0;
  for (const AnglePanel& p : panels)
    for (const auto& rows : p.rows)
      for (const Row& row : rows) far = std::max(far, row.front());
  return far;
}

double draw_panels(GnuplotScript& s, const std::vector<AnglePanel>& panels, const Titles& titles,
                   double width) {
  PanelKey key = begin_key(s, panels, titles, width);
  const double height = begin_panels(s, panels.size(), width, 0.85, key.height);
  s.add("set xrange [-5:{:g}]; set xtics 15; set yrange [*<0:*]; set xlabel 'inclination {{/:Italic θ}} [°]'",
        farthest(panels) + 5.0);
  char letter = 'a';
  for (const AnglePanel& p : panels) {
    std::string title = panels.size() > 1 ? fmt::format("({})", letter++) : "";
    if (!p.which.empty()) title += (title.empty() ? "" : " ") + gnuplot_plain(p.which);
    s.add("set ylabel {} offset 1; set title {} offset 0,-0.6", gnuplot_string(p.label),
          gnuplot_string(title));
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < Series::n; ++k)
      if (!p.rows[k].empty()) parts.push_back(s.block(p.rows[k]) + " " + looks[k] + " notitle");
    parts.insert(parts.end(), key.parts.begin(), key.parts.end());
    key.parts.clear();
    s.plot(parts);
    s.add("unset key");
  }
  s.add("unset multiplot");
  return height;
}

// --- a run
// ---------------------------------------------------------------------------------------------------

/// "K_Ic" as gnuplot sets it: all of the word behind the line is low.
std::string typeset(const std::string& label) {
  const std::size_t line = label.find('_');
  if (line == label.npos) return label;
  const std::size_t end = std::min(label.find_first_of(" ,", line), label.size());
  return label.substr(0, line + 1) + "{" + label.substr(line + 1, end - line - 1) + "}" + label.substr(end);
}

struct RunNumber {
  std::string number, label;
  double factor;
  std::optional<Property> property;
  const AngleCurve* curve;
};

/// Without rows where the tests have no such number.
AnglePanel panel_of(const RunRecord& run, const std::vector<Target>& table, const RunNumber& n) {
  AnglePanel panel{n.label, "", {}};
  for (const SpecimenRecord& t : run.tests)
    if (const double v = value_of(t, n.number); !t.result.intact && std::isfinite(v))
      panel.rows[Series::model].push_back({t.result.theta, n.factor * v});
  if (panel.rows[Series::model].empty()) return panel;
  panel.rows[Series::theory] = rows_of(*n.curve, n.factor);
  for (const Target& t : table)
    if (n.property == t.property) panel.rows[Series::laboratory].push_back(row_with_bar(t, n.factor));
  return panel;
}

// --- a calibration
// -------------------------------------------------------------------------------------------

std::string axis_label(Property property) {
  const std::string unit = measured(property).shown.name, symbol = measured(property).axis;
  return unit.empty() ? symbol : symbol + " [" + unit + "]";
}

/// 95 % interval by the fit, else the standard deviation between packings.
std::pair<double, double> bounds_of(const Comparison& c) {
  if (std::isfinite(c.low) && std::isfinite(c.high)) return {c.low, c.high};
  return {c.mean - c.sd, c.mean + c.sd};
}

/// A sixth of the least step between the angles of a table: so wide are bands on both sides of an angle, and
/// so far beside it stand single specimens and what was predicted without them. [deg]
double room_beside(const std::vector<Comparison>& rows) {
  double least = 15.0;
  for (const Comparison& a : rows)
    for (const Comparison& b : rows)
      if (const double step = std::fabs(a.target.theta - b.target.theta); step > 0.0)
        least = std::min(least, step);
  return least / 6.0;
}

AnglePanel panel_of(const Calibration& c, const Target& test, double beside_it, const TheoryCurves& curves) {
  AnglePanel panel{axis_label(test.property), particulars(test), {}};
  if (!panel.which.empty()) panel.which.erase(0, 2);  // ", "
  const double f = measured(test.property).shown.factor;
  for (const Comparison& fitted : c.fitted) {
    const Target& t = fitted.target;
    if (!same_test(t, test)) continue;
    panel.rows[Series::laboratory].push_back(row_with_bar(t, f));
    for (const double v : t.specimens) panel.rows[Series::single].push_back({t.theta - beside_it, f * v});
    const auto [low, high] = bounds_of(fitted);
    if (std::isfinite(low))
      panel.rows[Series::band].push_back({t.theta, f * fitted.mean, t.theta - 0.8 * beside_it,
                                          t.theta + 0.8 * beside_it, f * low, f * high});
    if (const Comparison& row = judged(c, fitted); row.answered())
      panel.rows[Series::model].push_back({t.theta, f * row.mean});
    if (const Comparison* row = row_of(c.left_out, t); row != nullptr && row->answered())
      panel.rows[Series::left_out].push_back({t.theta + beside_it, f * row->mean});
  }
  const AngleCurve none;
  const bool free = test.confining == 0.0;
  panel.rows[Series::theory] = rows_of(free && test.property == Property::E     ? curves.E
                                       : free && test.property == Property::ucs ? curves.ucs
                                                                                : none,
                                       f);
  return panel;
}

/// The tests of the laboratory, whatever their angles, each once.
std::vector<Target> tests_of(const Calibration& c) {
  std::vector<Target> tests;
  for (const Comparison& row : c.fitted)
    if (std::none_of(tests.begin(), tests.end(), [&](const Target& t) { return same_test(t, row.target); }))
      tests.push_back(row.target);
  return tests;
}

std::vector<Target> table_of(const Calibration& c) {
  std::vector<Target> table;
  for (const Comparison& row : c.fitted) table.push_back(row.target);
  return table;
}

}  // namespace

double draw_anisotropy(GnuplotScript& s, const RunRecord& run, const std::vector<Target>& table,
                       double width) {
  const TheoryCurves curves = theory_curves(run);
  const TestKind kind = run.tests.empty() ? TestKind() : run.tests.front().recipe.test.kind;
  const TestQuantity made_for = kind->curve.quantity();
  const RunNumber all[] = {{"E_tangent", axis_label(Property::E), 1e-9, Property::E, &curves.E},
                           {made_for.number, typeset(made_for.label) + " [" + made_for.unit + "]",
                            made_for.scale, kind->property(), &curves.ucs},
                           {"nu", axis_label(Property::nu), 1.0, Property::nu, &curves.nu}};
  std::vector<AnglePanel> panels;
  for (const RunNumber& n : all)
    if (AnglePanel panel = panel_of(run, beside(run, table), n); n_drawn(panel) > 0)
      panels.push_back(std::move(panel));
  if (panels.empty())
    throw InputError(Problem{"result", "theta", "", "specimens with layers and with numbers",
                             "run a recipe with [[bedding]] or a foliated matrix, and test.angles"});
  Titles titles;
  titles[Series::theory] = theory_title(curves, "model");
  titles[Series::laboratory] = "laboratory, mean and its 95 %", titles[Series::model] = "model";
  return draw_panels(s, panels, titles, width);
}

double draw_comparison(GnuplotScript& s, const Calibration& c, double width) {
  const std::vector<Target> table = table_of(c);
  const TheoryCurves curves = theory_curves(table);
  const double beside_it = room_beside(c.fitted);
  std::vector<AnglePanel> panels;
  for (const Target& test : tests_of(c)) panels.push_back(panel_of(c, test, beside_it, curves));
  if (panels.empty())
    throw InputError(Problem{c.rock, "fitted", "", "values of a laboratory", "calibrate the rock again"});
  Titles titles;
  titles[Series::band] = c.method == CalibrationMethod::sequence
                             ? "model ± standard deviation of the packings"
                             : "95 % of the rock's value by the fit";
  titles[Series::theory] = theory_title(curves, "laboratory");
  titles[Series::single] = "single specimens", titles[Series::laboratory] = "laboratory, mean and its 95 %";
  titles[Series::model] = c.verification.empty() ? "model, packings of the fit" : "model, unseen packings";
  titles[Series::left_out] = "model, predicted without it";
  return draw_panels(s, panels, titles, width);
}

}  // namespace phy::report
