#include "report/calibration_figures.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "report/angle_panels.hpp"
#include "report/calibration_summary.hpp"

namespace phy::report {
namespace {

/// 95 % interval by the fit, else the standard deviation between packings.
std::pair<double, double> bounds_of(const Comparison& c) {
  if (std::isfinite(c.low) && std::isfinite(c.high)) return {c.low, c.high};
  // The sequence of the paper has no posterior; packings are then all that shows a spread.
  return {c.mean - c.sd, c.mean + c.sd};
}

/// A sixth of the least step between the angles of a table: so wide are boxes on both sides of an angle, and
/// so far beside it stand single specimens and what was predicted without them. [deg]
double room_beside(const std::vector<Target>& table) {
  // Where a table has one angle there is no step; 15 degrees is the usual one.
  double least = 15.0;
  for (const Target& a : table)
    for (const Target& b : table)
      if (const double step = std::fabs(a.theta - b.theta); step > 0.0) least = std::min(least, step);
  return least / 6.0;
}

/// A panel for every test of a table, whatever its angles, with what the laboratory and theory say of it.
class LaboratoryPanels {
 public:
  explicit LaboratoryPanels(const std::vector<Target>& table)
      : table_(table), curves_(theory_curves(table)), beside_(room_beside(table)) {
    // One panel per test: UCS under two pressures are two curves, never one.
    for (const Target& t : table)
      if (std::none_of(tests_.begin(), tests_.end(), [&](const Target& k) { return same_panel(k, t); }))
        tests_.push_back(t);
  }
  /// One of each, with its first angle.
  const std::vector<Target>& tests() const { return tests_; }
  /// So far beside its place stands what belongs to a value: [deg], or of sheared bedding [MPa].
  double beside(const Target& test) const {
    if (!measured(test.property).along_bedding) return beside_;
    double most = 0.0;
    for (const Target& t : table_)
      if (same_panel(t, test)) most = std::max(most, place_in_panel(t));
    // Stresses have no usual step, so the room is a share of the axis.
    return most / 40.0;
  }

  Panel panel_of(const Target& test) const {
    Panel panel;
    panel.y = axis_of(test.property);
    if (measured(test.property).along_bedding)
      panel.x = {"normal stress σ_n", "MPa"};
    else if (panel.title = particulars(test); !panel.title.empty())
      panel.title.erase(0, 2);  // ", "
    panel.aside = test.property == Property::nu;
    Series laboratory = laboratory_series(), single{"specimens", Mark::dots, Role::specimen};
    const double f = measured(test.property).shown.factor;
    bool assumed = false;
    for (const Target& t : table_) {
      if (!same_panel(t, test)) continue;
      laboratory.points.push_back(point_of(t, f));
      assumed = assumed || t.sd_assumed;
      // To the left of the mean, whose interval would hide them.
      for (const double v : t.specimens) single.points.push_back({place_in_panel(t) - beside(test), f * v});
    }
    const AngleCurve curve = curve_of(test);
    if (laboratory.points.size() > 1) panel.caption = curve.note;  // rock without layers has one angle
    // Else the bar would pass for a measured scatter.
    if (assumed) panel.caption += " Where one specimen was tested its scatter is assumed.";
    panel.series = {theory_series(theory_name(curves_, "laboratory"), curve, f), single, laboratory};
    return panel;
  }

 private:
  AngleCurve curve_of(const Target& test) const {
    // Goodman and Jaeger were fitted to the least confined values alone.
    if (test.confining != 0.0) return {};
    return test.property == Property::E     ? curves_.E
           : test.property == Property::ucs ? curves_.ucs
                                            : AngleCurve{};
  }
  const std::vector<Target>& table_;
  TheoryCurves curves_;
  std::vector<Target> tests_;
  double beside_;  // [deg]
};

constexpr double alone = 0.5;             ///< height over width of one panel, as wide as the page
constexpr std::size_t fewest_joined = 5;  ///< angles; of fewer nobody would draw a curve

/// Between the angles of a table: the model, joined by straight lines, and dashed because it is no
/// prediction; and 95 % of the rock's value by the model and what it misses.
void add_between(const Calibration& c, const Target& test, Panel& panel) {
  std::vector<Comparison> rows;
  for (const Comparison& row : c.fitted)
    if (same_test(row.target, test) && row.answered()) rows.push_back(row);
  if (rows.size() < fewest_joined || c.discrepancy.empty()) return;
  std::sort(rows.begin(), rows.end(),
            [](const Comparison& a, const Comparison& b) { return a.target.theta < b.target.theta; });
  Series bare{"model alone, packings of the fit", Mark::line, Role::bare},
      band{"model with its discrepancy, 95 %", Mark::band, Role::between};
  const double f = measured(test.property).shown.factor;
  for (const Comparison& row : rows) bare.points.push_back({row.target.theta, f * row.mean});
  for (const AngleFactor& a : c.discrepancy) {
    const auto above = std::find_if(rows.begin(), rows.end(),
                                    [&](const Comparison& r) { return r.target.theta >= a.theta; });
    if (!same_test(a.test, test) || above == rows.end() || a.theta < rows.front().target.theta) continue;
    // At the very first angle there is nothing below it; the step is 0 then.
    const Comparison& below = above == rows.begin() ? *above : *(above - 1);
    const double step = above->target.theta - below.target.theta;
    const double model =
        f * std::lerp(below.mean, above->mean, step > 0.0 ? (a.theta - below.target.theta) / step : 0.0);
    // The discrepancy is a factor on the model, which between angles is taken as straight.
    band.points.push_back({a.theta, model * a.factor, model * a.low, model * a.high});
  }
  if (band.points.empty()) return;  // a modulus
  panel.series.insert(panel.series.begin(), band);
  panel.series.push_back(bare);
}

/// What the model makes of a test: below the laboratory the interval, above it the model.
void add_model(const Calibration& c, const Target& test, double beside, Panel& panel) {
  const bool sequence = c.method == CalibrationMethod::sequence;
  Series box{sequence ? "model ± standard deviation of the packings" : "95 % of the rock's value by the fit",
             Mark::boxes, Role::interval};
  Series model{c.verification.empty() ? "model, packings of the fit" : "model, unseen packings", Mark::points,
               Role::model};
  Series left_out{"model, predicted without it", Mark::points, Role::left_out};
  box.width = 1.6 * beside;
  const double f = measured(test.property).shown.factor;
  for (const Comparison& fitted : c.fitted) {
    const Target& t = fitted.target;
    if (!same_panel(t, test)) continue;
    if (const auto [low, high] = bounds_of(fitted); std::isfinite(low))
      box.points.push_back({place_in_panel(t), nan, f * low, f * high});
    // Unseen packings where there are some: on those of the fit the model looks better than it is.
    if (const Comparison& row = judged(c, fitted); row.answered())
      model.points.push_back({place_in_panel(t), f * row.mean, nan, nan, error_beside(row.mean, &t)});
    if (const Comparison* row = row_of(c.left_out, t); row != nullptr && row->answered())
      // To the right: the same angle holds the model that has seen the value.
      left_out.points.push_back({place_in_panel(t) + beside, f * row->predicted()});
  }
  // Drawers draw in this order: the interval must not cover what stands on it.
  panel.series.insert(panel.series.begin(), box);
  panel.series.push_back(left_out), panel.series.push_back(model);
}

}  // namespace

Figure calibration_figure(const Calibration& c) {
  std::vector<Target> table;
  for (const Comparison& row : c.fitted) table.push_back(row.target);
  const LaboratoryPanels panels(table);
  Figure figure;
  for (const Target& test : panels.tests()) {
    figure.panels.push_back(panels.panel_of(test));
    add_model(c, test, panels.beside(test), figure.panels.back());
    add_between(c, test, figure.panels.back());
  }
  if (figure.panels.size() == 1) figure.aspect = alone;
  fit_over_angles(figure);
  return figure;
}

Figure laboratory_figure(const std::vector<Target>& table) {
  const LaboratoryPanels panels(table);
  Figure figure;
  for (const Target& test : panels.tests()) figure.panels.push_back(panels.panel_of(test));
  fit_over_angles(figure);
  return figure;
}

}  // namespace phy::report
