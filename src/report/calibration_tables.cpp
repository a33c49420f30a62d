#include "report/calibration_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/lines.hpp"
#include "base/text_table.hpp"

namespace phy::report {
namespace {

/// Factor and name of the unit in which a property is printed.
double shown(Property p) { return p == Property::E ? 1e-9 : p == Property::nu ? 1.0 : 1e-6; }

/// "38.0 [36.9, 39.2]": a number of the calibration's recipe and its interval in a friendly unit; one that
/// was not fitted stands alone.
std::string cell(const Calibration& c, const double& number, double unit) {
  for (const ParameterEstimate& e : c.parameters)
    if (e.number != nullptr && &e.number(c.recipe) == &number)
      return fmt::format("{:.4g} [{:.3g}, {:.3g}]{}", number / unit, e.low / unit, e.high / unit,
                         e.determined ? "" : " open");
  return fmt::format("{:.4g} (given)", number / unit);
}

/// Root mean square error of a property; relative, of nu absolute.
std::string rms(const std::vector<Comparison>& rows, Property property) {
  double squares = 0.0;
  int n = 0;
  for (const Comparison& c : rows)
    if (c.target.property == property) {
      const double error = property == Property::nu ? c.mean - c.target.mean : c.error();
      squares += error * error, ++n;
    }
  if (n == 0) return "-";
  const double root = std::sqrt(squares / n);
  return property == Property::nu ? fmt::format("{:.3f}", root) : fmt::format("{:.1f} %", 100.0 * root);
}

const char* unit_head(Property p) { return p == Property::E ? "GPa" : p == Property::nu ? "" : "MPa"; }

/// What the strengths left out are off by, beside what straight lines between their neighbours in the table
/// are off by: those that have two.
std::string left_out_text(const std::vector<Comparison>& left_out, Property p) {
  if (rms(left_out, p) == "-") return "";
  std::vector<Comparison> inside, lines;
  for (const Comparison& c : left_out) {
    const double line = interpolated(left_out, c.target);
    if (!std::isfinite(line)) continue;
    inside.push_back(c), lines.push_back(c);
    lines.back().mean = line;
  }
  const std::string text = ", " + rms(left_out, p) + " at angles left out";
  if (rms(inside, p) == "-") return text;
  return fmt::format(
      "{} ({} at those with neighbours on both sides, where straight lines between these give {})", text,
      rms(inside, p), rms(lines, p));
}

std::string rms_text(const Calibration& c) {
  std::string text;
  for (int i = 0; i < n_properties; ++i) {
    const auto p = static_cast<Property>(i);
    if (rms(c.fitted, p) == "-") continue;
    text +=
        fmt::format("RMSE {}: {} fitted, {} on {} unseen packings{}\n", to_string(p), rms(c.fitted, p),
                    rms(c.verification, p), c.verification.empty() ? 0 : c.verification.front().n_packings,
                    left_out_text(c.left_out, p));
  }
  return text;
}

}  // namespace

std::string target_table(const std::vector<Target>& targets, int terminal_width) {
  std::map<std::pair<double, int>, std::map<Property, const Target*>>
      rows;  // discs of another size: a row more
  std::set<Property> properties;
  bool assumed = false, sizes = false;
  for (const Target& t : targets) {
    int row = 0;
    while (rows[{t.theta, row}].contains(t.property)) ++row;
    rows[{t.theta, row}][t.property] = &t;
    properties.insert(t.property);
    assumed = assumed || t.sd_assumed, sizes = sizes || t.diameter > 0.0;
  }
  Column theta{"theta", "deg", {}};
  for (const auto& [place, cells] : rows) theta.cells.push_back(fmt::format("{:g}", place.first));
  std::vector<Columns> groups;
  for (const Property p : properties) {
    Column value{to_string(p), unit_head(p), {}}, scatter{"+- SD", unit_head(p), {}}, n{"n", "", {}},
        disc{"disc", "mm", {}};
    for (const auto& [place, cells] : rows) {
      const auto it = cells.find(p);
      const Target* t = it == cells.end() ? nullptr : it->second;
      value.cells.push_back(t == nullptr ? "-" : fmt::format("{:.4g}", t->mean * shown(p)));
      scatter.cells.push_back(
          t == nullptr ? "-" : fmt::format("{:.2g}{}", t->sd * shown(p), t->sd_assumed ? "*" : ""));
      n.cells.push_back(t == nullptr ? "-" : fmt::format("{}", t->n));
      disc.cells.push_back(t == nullptr || t->diameter == 0.0 ? "-" : fmt::format("{:g}", t->diameter * 1e3));
    }
    groups.push_back({value, scatter, n});
    if (p == Property::brazilian && sizes) groups.back().push_back(disc);
  }
  return text_table(theta, groups, terminal_width) +
         (assumed ? "* hardly any scatter in the table: the usual one is assumed\n" : "");
}

std::string identifiability_table(const std::vector<ParameterEstimate>& estimates, int terminal_width) {
  Column symbol{"parameter", "", {}, true}, determined{"determined", "", {}, true},
      interval{"expected interval", "", {}, true}, why{"rests on / what would tell more", "", {}, true};
  for (const ParameterEstimate& e : estimates) {
    const std::string range =
        std::isfinite(e.low) ? fmt::format("x {:.2f} ... {:.2f}", e.low, e.high) : "known after the fit";
    symbol.cells.push_back(e.symbol);
    determined.cells.emplace_back(e.determined ? "yes" : "no");
    interval.cells.push_back(e.determined || !std::isfinite(e.low) ? range : "wide");
    why.cells.push_back(e.determined          ? e.rests_on
                        : e.next_test.empty() ? "no test that a table holds tells much"
                                              : "would tell more: " + e.next_test);
  }
  return wrapped(text_table(symbol, {{determined, interval}, {why}}, terminal_width), terminal_width,
                 symbol.width() + 2);
}

/// What the matrix has beside the bonds of the paper: the same everywhere and in every direction, the moment
/// counting in full, no friction.
std::vector<std::pair<const char*, std::string>> departures(const Calibration& c) {
  const MatrixRecipe& m = c.recipe.matrix;
  std::vector<std::pair<const char*, std::string>> rows;
  if (m.moment_contribution < 1.0)
    rows.emplace_back("Moment contribution beta", cell(c, m.moment_contribution, 1.0));
  if (m.shear_strength == ShearStrength::cohesion_friction)
    rows.emplace_back("Friction angle phi [deg]", cell(c, m.phi, 1.0));
  if (m.unbonded_fraction > 0.0) rows.emplace_back("Share without a bond", cell(c, m.unbonded_fraction, 1.0));
  if (m.directional())
    rows.insert(rows.end(), {{"Stiffness along/across r_E", cell(c, m.stiffness_ratio, 1.0)},
                             {"Normal strength along/across r_t", cell(c, m.tension_ratio, 1.0)},
                             {"Shear strength along/across r_c", cell(c, m.cohesion_ratio, 1.0)},
                             {"Shear strength oblique q_c", cell(c, m.cohesion_oblique, 1.0)}});
  return rows;
}

std::string parameter_tables(const Calibration& c, int terminal_width) {
  const MatrixRecipe& m = c.recipe.matrix;
  const double GPa = 1e9, MPa = 1e6;
  using Rows = std::vector<std::pair<const char*, std::string>>;
  const auto table = [&](const char* head, const Rows& rows) {
    Column name{head, "", {}, true}, value{"value [95 % interval]", "", {}, true};
    for (const auto& [n, v] : rows) name.cells.emplace_back(n), value.cells.push_back(v);
    return text_table(name, {{value}}, terminal_width);
  };
  const std::string E_c = cell(c, m.E_c, GPa), q = cell(c, m.ks_over_kn, 1.0);
  std::string text = "Table 1. Intact rock\n" +
                     table("balls", {{"Density [kg/m^3]", fmt::format("{:g} (given)", m.density)},
                                     {"Modulus E_c [GPa]", E_c},
                                     {"Stiffness ratio k_s/k_n", q},
                                     {"Friction coefficient mu", cell(c, m.mu, 1.0)}}) +
                     "\n" +
                     table("parallel bonds",
                           {{"Modulus E_c [GPa]", E_c},
                            {"Stiffness ratio k_s/k_n", q},
                            {"Mean normal strength [MPa]", cell(c, m.sigma_c, MPa)},
                            {"Mean shear strength [MPa]", cell(c, m.tau_c, MPa)},
                            {"SD of both / mean", fmt::format("{:.3g} (given)", m.sigma_c_sd / m.sigma_c)}});
  if (const Rows more = departures(c); !more.empty()) text += "\n" + table("bonds, more", more);
  if (c.recipe.bedding.empty()) return text;
  const BeddingRecipe& b = c.recipe.bedding.front();
  Rows joints = {{"Normal stiffness k_n,sj [GPa/m]", cell(c, b.k_n, GPa)},
                 {"Shear stiffness k_s,sj [GPa/m]", cell(c, b.k_s, GPa)},
                 {"Friction coefficient mu_sj", cell(c, b.mu, 1.0)},
                 {"Normal strength sigma_n,sj [MPa]", cell(c, b.sigma_n, MPa)},
                 {"Cohesion C_sj [MPa]", cell(c, b.cohesion, MPa)}};
  if (b.rule == BeddingRule::zone)
    joints.emplace_back("Thickness d [mm]", fmt::format("{:g} (given)", b.zone_thickness * 1e3));
  joints.emplace_back("Spacing [mm]", fmt::format("{:g} (given)", b.spacing * 1e3));
  return text + "\nTable 2. Bedding\n" +
         table(b.rule == BeddingRule::crossing ? "joints on contacts that cross" : "smooth joints", joints);
}

std::string macro_table(const Calibration& c, int terminal_width) {
  const auto column = [&](const char* head, const auto& cell) {
    Column col{head, "", {}};
    for (const Comparison& f : c.fitted) col.cells.push_back(cell(f));
    return col;
  };
  using R = const Comparison&;
  const auto number = [](R r, double v) {
    return std::isfinite(v) ? fmt::format("{:.4g}", v * shown(r.target.property)) : std::string("-");
  };
  const auto error = [](const Comparison* r) {
    if (r == nullptr || !std::isfinite(r->mean)) return std::string("-");
    return r->target.property == Property::nu ? fmt::format("{:+.3f}", r->mean - r->target.mean)
                                              : fmt::format("{:+.1f} %", 100.0 * r->error());
  };
  Column label = column("at theta [deg]", [](R r) {
    const std::string unit = unit_head(r.target.property);
    const double d = r.target.diameter;
    return fmt::format("{:<3} {:>4g}{}{}", to_string(r.target.property), r.target.theta,
                       unit.empty() ? "" : " [" + unit + "]",
                       d > 0.0 ? fmt::format(", {:g} mm", d * 1e3) : "");
  });
  label.left = true;
  const auto value = [&](const Comparison* r) {
    return r != nullptr ? number(*r, r->mean) : std::string("-");
  };
  const Columns laboratory = {
      column("lab", [&](R r) { return number(r, r.target.mean); }),
      column("+- se",
             [](R r) { return fmt::format("{:.2g}", r.target.standard_error() * shown(r.target.property)); }),
      column("rock, 95 %",
             [&](R r) { return fmt::format("{} ... {}", number(r, r.low), number(r, r.high)); })};
  const Columns fit = {column("fit", [&](R r) { return value(&r); }),
                       column("error", [&](R r) { return error(&r); })};
  const Columns unseen = {column("unseen", [&](R r) { return value(row_of(c.verification, r.target)); }),
                          column("error", [&](R r) { return error(row_of(c.verification, r.target)); })};
  std::vector<Columns> groups = {laboratory, fit, unseen};
  std::string legend = "rock, 95 %: where the rock's own value lies, by laboratory and model together\n";
  if (c.E_is != ModulusReading::small_strain)
    legend += fmt::format("E: {}, of the laboratory and of the press alike\n", to_string(c.E_is));
  if (!c.tangent_from_test.empty()) {
    groups.push_back(
        {column("at 50 % UCS", [&](R r) { return value(row_of(c.tangent_from_test, r.target)); })});
    legend +=
        "at 50 % UCS: tangent E and nu of the press at 40 - 60 % of UCS, unseen packings; fit and unseen: at "
        "small "
        "strain\n";
  }
  return text_table(label, groups, terminal_width) + wrapped(legend + rms_text(c), terminal_width, 2);
}

std::string verdict_text(const Calibration& c, int terminal_width) {
  std::string text = fmt::format("verdict: {}\n", to_string(c.verdict.status));
  for (const std::string& finding : c.verdict.findings) text += "- " + finding + "\n";
  std::vector<std::string> open;
  for (const ParameterEstimate& e : c.parameters)
    if (!e.determined)
      add_line(open, e.symbol,
               e.next_test.empty() ? "left open by the data; no test that a table holds tells much of it"
                                   : "left open by the data; would tell more: " + e.next_test);
  for (const std::string& line : open) text += "- " + line + "\n";
  for (const std::string& note : c.notes) text += "- " + note + "\n";
  return wrapped(text, terminal_width, 2);
}

std::string budget_text(const Calibration& c, int terminal_width) {
  return wrapped(
      fmt::format("{} tests of UCS{}; {} of all tests on coarse grains; {} direct elastic solutions\n",
                  c.n_strength_tests - c.n_tension_tests,
                  c.n_tension_tests > 0 ? fmt::format(" and {} in tension", c.n_tension_tests) : "",
                  c.n_coarse_tests, c.n_elastic),
      terminal_width, 2);
}

}  // namespace phy::report
