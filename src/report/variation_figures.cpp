#include "report/variation_figures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "base/quote.hpp"
#include "report/curves.hpp"
#include "report/palette.hpp"
#include "report/panel_grid.hpp"

namespace phy::report {
namespace {

using Row = GnuplotScript::Row;

/// For parameters: differ in lightness too (Okabe & Ito 2008).
constexpr std::array<Color, 8> line_colors = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                              0x56b4e9, 0xe69f00, 0x000000, 0x7f7f7f};
constexpr std::array<int, 7> symbols = {7, 5, 9, 11, 13, 15, 6};

/// As in the paper; other keys as they stand in the recipe. With markup.
std::string symbol_of(const std::string& key) {
  static const std::map<std::string, std::string> known = {
      {"bedding.k_n", "{/:Italic k}_n"},    {"bedding.k_s", "{/:Italic k}_s"},
      {"bedding.mu", "{/:Italic μ}"},       {"bedding.sigma_n", "{/:Italic σ}_n"},
      {"bedding.cohesion", "{/:Italic C}"}, {"bedding.zone_thickness", "{/:Italic d}"},
      {"bedding.spacing", "{/:Italic δ}"}};
  if (const auto it = known.find(key); it != known.end()) return it->second;
  return gnuplot_plain(key);
}

/// Place, mean, 95 % interval; of two values these themselves, as an interval of one degree of freedom is
/// 12.7 standard errors wide and says less than they do.
Row bar(double x, const Summary& s, double factor) {
  const double half = s.n > 2 && std::isfinite(s.half_width) ? s.half_width : 0.0;
  const double apart = s.n == 2 ? s.sd / std::numbers::sqrt2 : nan;  // from the mean
  return {x,
          factor * s.mean,
          factor * (s.mean - half),
          factor * (s.mean + half),
          factor * (s.mean - apart),
          factor * (s.mean + apart)};
}

/// Points as `how` says, with bars where there are intervals, small ones where there are two values.
void add_points(GnuplotScript& s, std::vector<std::string>& parts, const std::vector<Row>& rows,
                const std::string& how, const std::string& look) {
  const std::string data = s.block(rows);
  if (std::any_of(rows.begin(), rows.end(), [](const Row& r) { return r[3] > r[2]; }))
    parts.push_back(data + " using 1:2:3:4 with yerrorbars pt -1 lw 1 " + look + " notitle");
  if (std::any_of(rows.begin(), rows.end(), [](const Row& r) { return std::isfinite(r[4]); }))
    for (const char* column : {"5", "6"})
      parts.push_back(fmt::format("{} using 1:{} with points pt 7 ps 0.25 {} notitle", data, column, look));
  parts.push_back(data + " using 1:2 " + how);
}

/// What others found for a macro stiffness over a parameter.
void add_regressions(GnuplotScript& s, std::vector<std::string>& parts, const Variation& v,
                     const VariedParameter& p, const char* number) {
  for (const Regression& line : v.regressions) {
    if (line.number != number || line.key != p.key) continue;
    std::vector<Row> rows;
    for (const VariedSetting& setting : p.settings)
      rows.push_back({setting.factor, 1e-9 * (line.slope * setting.value + line.intercept)});
    parts.push_back(s.block(rows) + " using 1:2 with lines dt 2 lw 1.4 lc rgb '#444444' title " +
                    gnuplot_string(gnuplot_plain(line.source)));
  }
}

/// One panel of Fig. 4: k = 0 K_n, 1 K_s.
void stiffness_panel(GnuplotScript& s, const Variation& v, std::size_t k) {
  std::vector<std::string> parts, found;
  std::size_t n_series = 0;
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const VariedParameter& p : v.parameters) {
    std::vector<Row> rows;
    for (const MacroPoint& m : macro_points(v, p))
      if (const Summary& K = k == 0 ? m.K_n : m.K_s; K.n > 0) rows.push_back(bar(m.factor, K, 1e-9));
    if (rows.empty()) continue;
    const std::size_t i = n_series++;
    const std::string look = fmt::format("lc rgb '{}'", hex_color(line_colors[i % 8]));
    add_points(s, parts, rows,
               fmt::format("with linespoints lw 1.4 pt {} ps 0.55 {} title {}", symbols[i % 7], look,
                           gnuplot_string(symbol_of(p.key))),
               look);
    for (const Row& row : rows) low = std::min(low, row[1]), high = std::max(high, row[1]);
    add_regressions(s, found, v, p, k == 0 ? "K_n" : "K_s");
  }
  if (parts.empty() && v.spacing <= 0.0)
    throw InputError(Problem{"results", k == 0 ? "K_n" : "K_s", "", "jointed planes in isotropic rock",
                             "other rock has no stiffness of planes by Eq. 1; draw --kind modulus"});
  if (parts.empty())
    throw InputError(Problem{"results", k == 0 ? "K_n" : "K_s", "",
                             "E at several inclinations for a fit of Eq. 1", "run more angles"});
  const bool wide = high > 30.0 * low;  // no linear axis would show the small ones
  s.add("{}", wide ? "set logscale y; set yrange [*:*]; set format y '10^{%L}'; set key top right"
                   : "unset logscale y; set yrange [0:*]; set format y '%g'; set key top left");
  parts.insert(parts.end(), found.begin(), found.end());
  s.add("set ylabel 'macro {} stiffness {{/:Italic K}}_{} [GPa/m]' offset {}", k == 0 ? "normal" : "shear",
        k == 0 ? "n" : "s", wide ? 0 : 1);
  s.add("set xlabel 'parameter / base'");
  s.plot(parts);
}

/// What follows the number in all values of a parameter: " GPa/m"; empty if they differ.
std::string common_unit(const VariedParameter& p) {
  std::string unit;
  for (const VariedSetting& s : p.settings) {
    const std::string own = s.text.substr(std::min(s.text.find(' '), s.text.size()));
    if (&s != &p.settings.front() && own != unit) return "";
    unit = own;
  }
  return unit;
}

std::vector<Row> eq1_line(const theory::Eq1Fit& fit) {
  std::vector<Row> line;
  for (int half_degrees = 0; fit.ok() && half_degrees <= 180; ++half_degrees) {
    const double theta = 0.5 * half_degrees;
    line.push_back({theta, 1e-9 * theory::goodman_E(fit.rock, theta)});
  }
  return line;
}

/// Of value i of n, from small to large.
Color value_color(std::size_t i, std::size_t n) {
  return color_at(ramp, n < 2 ? 0.5 : static_cast<double>(i) / static_cast<double>(n - 1));
}

/// Values over the inclination: points with intervals, and lines through them or Eq. 1.
void angle_panel(GnuplotScript& s, const Variation& v, const VariedParameter& p, bool modulus) {
  std::vector<std::string> parts;
  const std::size_t unit = common_unit(p).size();
  for (std::size_t i = 0; i < p.settings.size(); ++i) {
    const VariedSetting& setting = p.settings[i];
    std::vector<Row> rows;
    for (const AngleValue& a : modulus ? setting.E : setting.ucs)
      if (a.value.n > 0) rows.push_back(bar(a.theta, a.value, modulus ? 1e-9 : 1e-6));
    if (rows.empty()) continue;
    // Without planes in isotropic rock there is no Eq. 1.
    const std::vector<Row> line =
        modulus && v.spacing > 0.0 ? eq1_line(fit_moduli(setting.E, v.E_intact)) : std::vector<Row>();
    const std::string look = fmt::format("lc rgb '{}'", hex_color(value_color(i, p.settings.size())));
    if (!line.empty()) parts.push_back(fmt::format("{} with lines lw 1.2 {} notitle", s.block(line), look));
    const std::string name =
        setting.text.substr(0, setting.text.size() - unit) + (setting.base ? " (base)" : "");
    add_points(
        s, parts, rows,
        fmt::format("with {} pt {} ps 0.5 lw {} {} title {}", line.empty() ? "linespoints" : "points",
                    symbols[i % 7], setting.base ? 2.0 : 1.2, look, gnuplot_string(gnuplot_plain(name))),
        look);
  }
  s.plot(parts);
}

std::vector<const VariedParameter*> modulus_parameters(const Variation& v) {
  std::vector<const VariedParameter*> chosen;
  for (const VariedParameter& p : v.parameters)
    if (p.key == "bedding.k_n" || p.key == "bedding.k_s") chosen.push_back(&p);
  if (chosen.empty())
    for (const VariedParameter& p : v.parameters) chosen.push_back(&p);
  return chosen;
}

std::vector<const VariedParameter*> strength_parameters(const Variation& v) {
  std::vector<const VariedParameter*> chosen;
  for (const VariedParameter& p : v.parameters)
    if (std::any_of(p.settings.begin(), p.settings.end(),
                    [](const VariedSetting& s) { return !s.ucs.empty(); }))
      chosen.push_back(&p);
  return chosen;
}

/// Returns the height of the figure [mm].
double angle_panels(GnuplotScript& s, const Variation& v,
                    const std::vector<const VariedParameter*>& parameters, bool modulus, double width) {
  const double height = begin_panels(s, parameters.size(), width, 0.72);
  s.add("set xrange [-5:95]; set xtics 15; set xlabel 'inclination {{/:Italic θ}} [°]'");
  s.add("set ylabel '{}' offset 1; set yrange [0:*]",
        modulus ? "{/:Italic E}_{/:Italic θ} [GPa]" : "UCS [MPa]");
  if (modulus)
    s.add("set key top left reverse Left");
  else  // room for the key above the curves
    s.add(
        "set offsets 0,0,graph 0.42,0; set key top center reverse Left maxrows 3 samplen 1.2 font ',6' width "
        "-2");
  char letter = 'a';
  for (const VariedParameter* p : parameters) {
    const std::string unit = common_unit(*p);
    const std::string which = parameters.size() > 1 ? fmt::format("({}) ", letter++) : "";
    const std::string in_unit = unit.empty() ? "" : " [" + gnuplot_plain(unit.substr(1)) + "]";
    s.add("set title {} offset 0,-0.6",
          gnuplot_string(fmt::format("{}{}{}", which, symbol_of(p->key), in_unit)));
    angle_panel(s, v, *p, modulus);
  }
  s.add("unset multiplot");
  return height;
}

}  // namespace

double draw_stiffness(GnuplotScript& s, const Variation& v, double width) {
  s.add("set multiplot layout 1,2 margins 0.09,0.985,0.16,0.96 spacing 0.11,0");
  double largest = 0.0;
  for (const VariedParameter& p : v.parameters)
    for (const VariedSetting& setting : p.settings) largest = std::fmax(largest, setting.factor);
  s.add("set key reverse Left; set xrange [0:{:.4g}]", 1.06 * largest);  // with room for the last symbol
  stiffness_panel(s, v, 0);
  stiffness_panel(s, v, 1);
  s.add("unset multiplot");
  return 0.44 * width;
}

double draw_modulus(GnuplotScript& s, const Variation& v, double width) {
  return angle_panels(s, v, modulus_parameters(v), true, width);
}

double draw_strength(GnuplotScript& s, const Variation& v, double width) {
  const auto parameters = strength_parameters(v);
  if (parameters.empty())
    throw InputError(
        Problem{"results", "ucs", "", "tests run to the peak", "name a study of solver \"dynamic\""});
  return angle_panels(s, v, parameters, false, width);
}

}  // namespace phy::report
