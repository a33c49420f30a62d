#include "design/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/stats.hpp"
#include "report/figure_json.hpp"
#include "report/finding_json.hpp"
#include "report/page.hpp"
#include "report/words.hpp"

namespace phy::design {
namespace {

using report::Figure;
using report::Mark;
using report::Panel;
using report::Role;
using report::Series;
using Json = nlohmann::ordered_json;

constexpr double step_of_curves = 1.0;  // [deg]

std::string shown(Constant constant, double value) {
  const ConstantInfo& c = info(constant);
  return fmt::format("{:.{}f}", value * c.factor, c.digits);
}
std::string interval(const ConstantEstimate& e) {
  return shown(e.key.constant, e.low) + " to " + shown(e.key.constant, e.high);
}

std::string title_of(Part part, const Pooled& p) {
  std::string text = word_of(part);
  if (part == Part::tension) return text;
  text += ": fit " + report::percent_text(p.error);
  return std::isfinite(p.left_out) ? text + ", stress left out " + report::percent_text(p.left_out) : text;
}

SheetTable plain_table(Part part, const Pooled& p) {
  SheetTable t{title_of(part, p), {"constant", "value", "95 % interval", "meaning"}, {}};
  for (const ConstantEstimate& e : p.constants) {
    const ConstantInfo& c = info(e.key.constant);
    const std::string unit = *c.shown_unit == '\0' ? "" : std::string(" [") + c.shown_unit + "]";
    t.rows.push_back({c.symbol + unit, shown(c.constant, e.value), interval(e), c.meaning});
  }
  return t;
}

/// Inclinations down, constants across.
SheetTable angle_table(Part part, const Pooled& p) {
  SheetTable t{title_of(part, p),
               {"theta [deg]", "beta [deg]", "sigma_ci [MPa]", "95 % of sigma_ci", "m", "95 % of m", "k_beta",
                "95 % of k_beta"},
               {}};
  for (const ConstantEstimate& e : p.constants) {
    if (e.key.constant != Constant::sigma_ci) continue;
    std::vector<std::string> row = {fmt::format("{:g}", e.key.theta),
                                    fmt::format("{:g}", 90.0 - e.key.theta)};
    for (const Constant c : {Constant::sigma_ci, Constant::m, Constant::k_beta}) {
      const ConstantEstimate* of = p.find({c, e.key.theta});
      row.push_back(of != nullptr ? shown(c, of->value) : "-");
      row.push_back(of != nullptr ? interval(*of) : "-");
    }
    t.rows.push_back(std::move(row));
  }
  return t;
}

// ---- figure

double shade_of(std::size_t i, std::size_t n) {
  return n < 2 ? 0.5 : static_cast<double>(i) / static_cast<double>(n - 1);
}

/// Mean and range of the draws at an inclination; nothing where no draw has a value.
void add_point(Series& series, double theta, const std::vector<double>& values) {
  if (values.empty()) return;
  // The range of few draws says more than a standard deviation.
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  series.points.push_back({theta, summarise(values).mean, *low, *high});
}

Series model_series(const std::string& name, double shade) {
  return {.name = name, .mark = Mark::points, .role = Role::ordered, .shade = shade};
}

template <class At>
Series curve(const std::string& name, Role role, double shade, const At& at) {
  Series s{.name = name, .mark = Mark::line, .role = role, .shade = shade};
  for (double theta = 0.0; theta <= 90.0; theta += step_of_curves)
    if (const double y = at(theta); std::isfinite(y)) s.points.push_back({theta, y});
  return s;
}

std::vector<double> angles_of(const Design& d) {
  std::vector<double> angles;
  for (const DrawTests& draw : d.tests.draws)
    for (const StrengthPoint& p : draw.compression) angles.push_back(p.theta);
  // Each once, whatever draws have no strength there.
  std::sort(angles.begin(), angles.end());
  angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
  return angles;
}

/// The laboratory's values of a property; of strengths those under this stress.
Series laboratory_series(const Design& d, Property property, double stress) {
  Series s{.name = "laboratory", .mark = Mark::points, .role = Role::laboratory};
  if (property == Property::E && d.tests.E_is != ModulusReading::small_strain)
    s.name += std::string(", ") + to_string(d.tests.E_is);
  // UCS is the strength under no stress.
  for (const Target& t : d.tests.laboratory) {
    const bool strength = property == Property::confined;
    const bool of = strength ? (t.property == Property::ucs || t.property == Property::confined) &&
                                   same_stress(t.confining, stress)
                             : t.property == property;
    if (of) s.points.push_back({t.theta, t.mean * shown_unit(t.property).factor});
  }
  return s;
}

/// The law of all inclinations, which draws the lines: the joint, or the fabric that stands in for it.
const StrengthLaw* law_of_lines(const Design& d) {
  for (const StrengthLaw& law : strength_laws())
    if (law.part != Part::hoek_brown && d.part(law.part).ok()) return &law;
  return nullptr;
}

Panel strength_panel(const Design& d) {
  Panel panel;
  panel.x = {.quantity = "θ", .unit = "°", .low = 0.0, .high = 90.0, .step = 15.0};
  panel.y = {.quantity = "σ_1", .unit = "MPa"};
  const StrengthLaw* law = law_of_lines(d);
  const std::size_t n = d.tests.stresses.size();
  for (std::size_t i = 0; i < n; ++i) {
    const double stress = d.tests.stresses[i], shade = shade_of(i, n);
    const std::string name = fmt::format("σ_3 = {:g} MPa", stress * 1e-6);
    Series tested = model_series(name, shade);
    for (const double theta : angles_of(d)) {
      std::vector<double> values;
      for (const DrawTests& draw : d.tests.draws)
        for (const StrengthPoint& p : draw.compression)
          if (p.theta == theta && p.sigma_3 == stress) values.push_back(p.ucs * 1e-6);
      add_point(tested, theta, values);
    }
    panel.series.push_back(std::move(tested));
    if (law != nullptr) {
      const Fit mean = d.part(law->part).mean();
      panel.series.push_back(curve("", Role::ordered, shade,
                                   [&](double theta) { return law->sigma_1(mean, theta, stress) * 1e-6; }));
    }
    if (Series lab = laboratory_series(d, Property::confined, stress); !lab.points.empty())
      panel.series.push_back(std::move(lab));
  }
  panel.caption = d.tests.of_rock
                      ? "Points: mean and range of the draws, corrected by what they miss of the table."
                      : "Points: mean and range of the draws.";
  if (law != nullptr) panel.caption += fmt::format(" Lines: the {} law.", word_of(law->part));
  return panel;
}

Panel elastic_panel(const Design& d, Property property) {
  Panel panel;
  const double factor = shown_unit(property).factor;
  panel.x = {.quantity = "θ", .unit = "°", .low = 0.0, .high = 90.0, .step = 15.0};
  panel.y = {.quantity = measured(property).axis, .unit = shown_unit(property).name};
  Series tested{.name = "draws", .mark = Mark::points, .role = Role::model};
  const std::size_t n = d.tests.draws.empty() ? 0 : d.tests.draws.front().elasticity.size();
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> values;
    for (const DrawTests& draw : d.tests.draws) {
      const ElasticPoint& p = draw.elasticity[i];
      if (const double v = property == Property::E ? p.E : p.nu; std::isfinite(v))
        values.push_back(v * factor);
    }
    add_point(tested, d.tests.draws.front().elasticity[i].theta, values);
  }
  panel.series.push_back(std::move(tested));
  if (const Pooled& p = d.part(Part::elasticity); p.ok()) {
    const auto S = plane_compliance(body_of(p.mean()), d.tests.reading.state);
    panel.series.push_back(curve("elasticity", Role::theory, nan, [&](double theta) {
      const theory::PlaneConstants at = theory::seen_at(S, theta);
      return (property == Property::E ? at.E : at.nu) * factor;
    }));
  }
  if (Series lab = laboratory_series(d, property, 0.0); !lab.points.empty())
    panel.series.push_back(std::move(lab));
  return panel;
}

Json table_json(const SheetTable& t) { return {{"title", t.title}, {"head", t.head}, {"rows", t.rows}}; }

}  // namespace

std::vector<SheetTable> sheet_tables(const Design& design) {
  std::vector<SheetTable> tables;
  for (std::size_t p = 0; p < n_parts; ++p) {
    const auto part = static_cast<Part>(p);
    const Pooled& pooled = design.part(part);
    // Why a part is missing stands among the findings.
    if (pooled.ok())
      tables.push_back(part == Part::hoek_brown ? angle_table(part, pooled) : plain_table(part, pooled));
  }
  return tables;
}

Figure design_figure(const Design& design) {
  Figure figure;
  figure.aspect = 0.65;  // low: all of it is one sheet of paper
  figure.panels = {strength_panel(design), elastic_panel(design, Property::E),
                   elastic_panel(design, Property::nu)};
  fit_axes(figure);
  return figure;
}

Json sheet_json(const Design& design) {
  Json j = {{"format", 1},
            {"rock", design.tests.rock},
            {"stresses [Pa]", design.tests.stresses},
            {"draws", design.tests.draws.size()}};
  j["tables"] = Json::array();
  for (const SheetTable& t : sheet_tables(design)) j["tables"].push_back(table_json(t));
  j["findings"] = report::findings_json(design.findings);
  j["figure"] = report::figure_json(design_figure(design));
  return j;
}

std::string sheet_page(const Design& design) {
  report::PageExtras extras;
  extras.name = design.tests.rock;
  extras.design_json = sheet_json(design).dump();
  return report::report_page({}, extras);
}

}  // namespace phy::design
