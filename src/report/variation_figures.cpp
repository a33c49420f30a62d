#include "report/variation_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/check.hpp"
#include "report/angle_panels.hpp"

namespace phy::report {
namespace {

/// As in the paper; other keys as they stand in the recipe.
std::string symbol_of(const std::string& key) {
  static const std::map<std::string, std::string> known = {
      {"bedding.k_n", "k_n"},     {"bedding.k_s", "k_s"},    {"bedding.mu", "μ"},
      {"bedding.sigma_n", "σ_n"}, {"bedding.cohesion", "C"}, {"bedding.zone_thickness", "d"},
      {"bedding.spacing", "δ"}};
  const auto it = known.find(key);
  return it != known.end() ? it->second : key;
}

/// A mean with its 95 % interval. An interval of one degree of freedom is 12.7 standard errors wide and says
/// less than the two values themselves: these are seen in its place, and it is read only.
Point point_of(double x, const Summary& s, double factor) {
  const double half = factor * s.half_width;
  Point p{x, factor * s.mean, nan, nan, std::isfinite(half) ? fmt::format("± {:.2f}", half) : ""};
  if (s.n > 2 && std::isfinite(half)) p.low = p.y - half, p.high = p.y + half;
  return p;
}

/// The values of two, as small points in the look of their mean.
Series pairs_of(const Series& means, const std::vector<Point>& points) {
  Series s = means;
  s.name.clear(), s.mark = Mark::dots, s.points = points;
  return s;
}

/// A series of means, and of the values behind those that are of two.
class Means {
 public:
  explicit Means(Series look) : means_(std::move(look)) {}
  void add(double x, const Summary& s, double factor) {
    if (s.n == 0) return;
    means_.points.push_back(point_of(x, s, factor));
    // The standard deviation of two values is their distance over sqrt 2, so each lies sd/sqrt 2 from the
    // mean.
    const double apart = factor * s.sd / std::numbers::sqrt2;  // from the mean
    if (s.n == 2)
      pairs_.push_back({x, factor * s.mean - apart}), pairs_.push_back({x, factor * s.mean + apart});
  }
  bool empty() const { return means_.points.empty(); }
  /// `joined`: by a line, a guide to the eye.
  void add_to(Panel& panel, bool joined) const {
    Series line = means_;
    // Without a name: the key has the symbols, and a line beside each would say it twice.
    line.name.clear(), line.mark = Mark::line;
    if (line.role == Role::ordered) line.number = 0;  // dashes are of fitted lines
    // Without bars, which belong to the symbols.
    for (Point& p : line.points) p = {p.x, p.y};
    if (joined) panel.series.push_back(line);
    if (!pairs_.empty()) panel.series.push_back(pairs_of(means_, pairs_));
    panel.series.push_back(means_);
  }

 private:
  Series means_;
  std::vector<Point> pairs_;
};

/// What others found for a macro stiffness over a parameter.
void add_regressions(Panel& panel, const Variation& v, const VariedParameter& p, const std::string& number) {
  for (const Regression& line : v.regressions) {
    if (line.number != number || line.key != p.key) continue;
    Series s{line.source, Mark::line, Role::others};
    for (const VariedSetting& setting : p.settings)
      // Only at values that were tried: a regression of others holds on their range at best.
      s.points.push_back({setting.factor, 1e-9 * (line.slope * setting.value + line.intercept)});
    panel.series.push_back(s);
  }
}

double largest_factor(const Variation& v) {
  double largest = 0.0;
  for (const VariedParameter& p : v.parameters)
    for (const VariedSetting& s : p.settings) largest = std::fmax(largest, s.factor);
  return largest;
}

/// Of K_n or K_s; without series where Eq. 1 gives none.
Panel macro_panel(const Variation& v, Summary MacroPoint::*number, const std::string& name) {
  Panel panel{"", "", Axis{"parameter / base"},
              Axis{fmt::format("macro {} stiffness {}", name == "K_n" ? "normal" : "shear", name), "GPa/m"}};
  std::size_t n = 0;
  double low = nan, high = 0.0;
  for (const VariedParameter& p : v.parameters) {
    Means means(Series{symbol_of(p.key), Mark::points, Role::listed, n});
    for (const MacroPoint& m : macro_points(v, p)) {
      means.add(m.factor, m.*number, 1e-9);
      if ((m.*number).n > 0) low = std::fmin(low, (m.*number).mean), high = std::fmax(high, (m.*number).mean);
    }
    if (means.empty()) continue;
    // Numbers choose symbols; a parameter without points should not use one up.
    ++n;
    means.add_to(panel, true);
    add_regressions(panel, v, p, name);
  }
  panel.y.logarithmic = high > 30.0 * low && low > 0.0;  // no linear axis would show the small ones
  constexpr double room = 1.06;                          // for the last symbol
  panel.x.low = 0.0, panel.x.high = room * largest_factor(v);
  return panel;
}

/// What follows the number in all values of a parameter: " GPa/m"; empty if they differ.
std::string common_unit(const VariedParameter& p) {
  std::string unit;
  for (const VariedSetting& s : p.settings) {
    const std::string own = s.text.substr(std::min(s.text.find(' '), s.text.size()));
    // Then each value keeps its own in the key.
    if (&s != &p.settings.front() && own != unit) return "";
    unit = own;
  }
  return unit;
}

Series eq1_line(const theory::Eq1Fit& fit) {
  Series s{"", Mark::line};
  for (int half_degrees = 0; fit.ok() && half_degrees <= 180; ++half_degrees) {
    const double theta = 0.5 * half_degrees;
    s.points.push_back({theta, 1e-9 * theory::goodman_E(fit.rock, theta)});
  }
  return s;
}

/// Values over the inclination: points with intervals, and Eq. 1 or lines through them.
Panel angle_panel(const Variation& v, const VariedParameter& p, bool modulus) {
  const std::string unit = common_unit(p);
  Panel panel;
  panel.title = symbol_of(p.key) + (unit.empty() ? "" : " [" + unit.substr(1) + "]");
  panel.y = modulus ? Axis{"E", "GPa"} : axis_of(Property::ucs);
  const auto last = static_cast<double>(p.settings.size()) - 1.0;
  for (std::size_t i = 0; i < p.settings.size(); ++i) {
    const VariedSetting& setting = p.settings[i];
    Series look{setting.text.substr(0, setting.text.size() - unit.size()) + (setting.base ? " (base)" : ""),
                Mark::points, Role::ordered, i};
    // A single value has no place in an order: the middle.
    look.shade = last > 0.0 ? static_cast<double>(i) / last : 0.5, look.strong = setting.base;
    Means means(look);
    for (const AngleValue& a : modulus ? setting.E : setting.ucs)
      means.add(a.theta, a.value, modulus ? 1e-9 : 1e-6);
    if (means.empty()) continue;
    Series line;
    // Without planes in isotropic rock there is no Eq. 1.
    if (modulus && v.spacing > 0.0) line = eq1_line(fit_moduli(setting.E, v.E_intact));
    line.role = look.role, line.shade = look.shade, line.strong = look.strong;
    if (!line.points.empty()) panel.series.push_back(line);
    means.add_to(panel, line.points.empty());
  }
  return panel;
}

Figure over_angles(const Variation& v, const std::vector<const VariedParameter*>& parameters, bool modulus) {
  Figure figure{{}, Key::inside, 0.72};
  for (const VariedParameter* p : parameters)
    if (Panel panel = angle_panel(v, *p, modulus); !panel.series.empty())
      figure.panels.push_back(std::move(panel));
  fit_over_angles(figure);
  return figure;
}

}  // namespace

Figure macro_figure(const Variation& v) {
  Figure figure{{}, Key::shared, 0.8};
  for (Panel panel : {macro_panel(v, &MacroPoint::K_n, "K_n"), macro_panel(v, &MacroPoint::K_s, "K_s")})
    if (!panel.series.empty()) figure.panels.push_back(std::move(panel));
  fit_axes(figure);
  return figure;
}

Figure parameter_figure(const Variation& v, const VariedParameter& p) {
  Figure figure{{}, Key::inside, 0.72};
  for (const bool modulus : {true, false})
    for (Panel& panel : over_angles(v, {&p}, modulus).panels) figure.panels.push_back(std::move(panel));
  return figure;
}

Figure stiffness_figure(const Variation& v) {
  Figure figure = macro_figure(v);
  if (figure.panels.empty() && v.spacing <= 0.0)
    throw InputError(Problem{"results", "K_n", "", "jointed planes in isotropic rock",
                             "other rock has no stiffness of planes by Eq. 1; draw --kind modulus"});
  if (figure.panels.empty())
    throw InputError(
        Problem{"results", "K_n", "", "E at several inclinations for a fit of Eq. 1", "run more angles"});
  return figure;
}

Figure modulus_figure(const Variation& v) {
  std::vector<const VariedParameter*> stiffnesses, all;
  for (const VariedParameter& p : v.parameters) {
    all.push_back(&p);
    // The paper's figure shows these two; E hardly depends on strengths and friction.
    if (p.key == "bedding.k_n" || p.key == "bedding.k_s") stiffnesses.push_back(&p);
  }
  return over_angles(v, stiffnesses.empty() ? all : stiffnesses, true);
}

Figure strength_figure(const Variation& v) {
  std::vector<const VariedParameter*> all;
  for (const VariedParameter& p : v.parameters) all.push_back(&p);
  Figure figure = over_angles(v, all, false);
  if (figure.panels.empty())
    throw InputError(
        Problem{"results", "ucs", "", "tests run to the peak", "name a study of solver \"dynamic\""});
  return figure;
}

}  // namespace phy::report
