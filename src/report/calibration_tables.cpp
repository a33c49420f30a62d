#include "report/calibration_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace phy {
namespace {

/// Factor and name of the unit in which a property is printed.
double shown(Property p) { return p == Property::E ? 1e-9 : p == Property::nu ? 1.0 : 1e-6; }
const ParameterEstimate* find(const Calibration& c, const std::string& key) {
  for (const ParameterEstimate& e : c.parameters)
    if (e.key == key) return &e;
  return nullptr;
}

/// "38.0 [36.9, 39.2]": value and interval in a friendly unit; a parameter that was not fitted stands alone.
std::string cell(const Calibration& c, const std::string& key, double value, double unit) {
  const ParameterEstimate* e = find(c, key);
  if (e == nullptr) return fmt::format("{:.4g} (given)", value / unit);
  return fmt::format("{:.4g} [{:.3g}, {:.3g}]{}", value / unit, e->low / unit, e->high / unit,
                     e->determined ? "" : " open");
}

const Comparison* row_of(const std::vector<Comparison>& rows, const Target& t) {
  for (const Comparison& c : rows)
    if (c.target.property == t.property && c.target.theta == t.theta && c.target.diameter == t.diameter)
      return &c;
  return nullptr;
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

const char* unit_shown(Property p) { return p == Property::E ? "GPa" : p == Property::nu ? "1" : "MPa"; }

}  // namespace

std::string target_table(const std::vector<Target>& targets) {
  std::map<double, std::map<Property, const Target*>> rows;
  std::map<Property, bool> columns;
  for (const Target& t : targets) rows[t.theta][t.property] = &t, columns[t.property] = true;
  std::string text = fmt::format("{:>6}", "theta"), units = fmt::format("{:>6}", "deg");
  for (const auto& [p, used] : columns) {
    text += fmt::format("  {:>9} {:>8} {:>3}", to_string(p), "+- SD", "n");
    units += fmt::format("  {:>9} {:>8} {:>3}", unit_shown(p), unit_shown(p), "");
  }
  text += "\n" + units + "\n";
  for (const auto& [theta, cells] : rows) {
    text += fmt::format("{:>6g}", theta);
    for (const auto& [p, used] : columns) {
      const auto it = cells.find(p);
      if (it == cells.end()) {
        text += fmt::format("  {:>9} {:>8} {:>3}", "-", "-", "-");
        continue;
      }
      const Target& t = *it->second;
      text += fmt::format("  {:>9.4g} {:>8} {:>3}", t.mean * shown(p),
                          fmt::format("{:.2g}{}", t.sd * shown(p), t.sd_assumed ? "*" : ""), t.n);
    }
    text += "\n";
  }
  for (const Target& t : targets)
    if (t.sd_assumed) return text + "* no scatter in the table: assumed\n";
  return text;
}

std::string foresight_table(const std::vector<ParameterEstimate>& estimates) {
  std::string text = fmt::format("{:<16} {:<12} {:<18} {}\n", "parameter", "determined", "expected interval",
                                 "rests on / what would pin it");
  for (const ParameterEstimate& e : estimates) {
    const std::string interval =
        std::isfinite(e.low) ? fmt::format("x {:.2f} ... {:.2f}", e.low, e.high) : "known after the fit";
    text += fmt::format("{:<16} {:<12} {:<18} {}\n", e.symbol, e.determined ? "yes" : "no",
                        e.determined || !std::isfinite(e.low) ? interval : "wide",
                        e.determined ? e.rests_on : "would need: " + e.next_test);
  }
  return text;
}

std::string parameter_tables(const Calibration& c) {
  const MatrixRecipe& m = c.recipe.matrix;
  std::string text = "Table 1. Intact rock: value [95 % interval]\n";
  const auto line = [&](const std::string& left, const std::string& a, const std::string& right,
                        const std::string& b) {
    text += fmt::format("{:<24} {:<24} {:<30} {}\n", left, a, right, b);
  };
  const double GPa = 1e9, MPa = 1e6;
  const std::string E_c = cell(c, "matrix.E_c", m.E_c, GPa),
                    q = cell(c, "matrix.ks_over_kn", m.ks_over_kn, 1.0);
  line("Ball parameters", "", "Parallel bond parameters", "");
  line("Ball density [kg/m^3]", fmt::format("{:g} (given)", m.density), "Modulus E_c [GPa]", E_c);
  line("Modulus E_c [GPa]", E_c, "Stiffness ratio k_s/k_n", q);
  line("Stiffness ratio k_s/k_n", q, "Mean normal strength [MPa]", cell(c, "matrix.sigma_c", m.sigma_c, MPa));
  line("Friction coefficient mu", cell(c, "matrix.mu", m.mu, 1.0), "Mean shear strength [MPa]",
       cell(c, "matrix.tau_c", m.tau_c, MPa));
  line("", "", "SD of both / mean", fmt::format("{:.3g} (given)", m.sigma_c_sd / m.sigma_c));
  if (c.recipe.bedding.empty()) return text;
  const BeddingRecipe& b = c.recipe.bedding.front();
  text += "\nTable 2. Smooth joints: value [95 % interval]\n";
  const auto row = [&](const char* name, const std::string& value) {
    text += fmt::format("{:<38} {}\n", name, value);
  };
  row("Normal stiffness k_n,sj [GPa/m]", cell(c, "bedding[0].k_n", b.k_n, GPa));
  row("Shear stiffness k_s,sj [GPa/m]", cell(c, "bedding[0].k_s", b.k_s, GPa));
  row("Friction coefficient mu_sj", cell(c, "bedding[0].mu", b.mu, 1.0));
  row("Normal strength sigma_n,sj [MPa]", cell(c, "bedding[0].sigma_n", b.sigma_n, MPa));
  row("Cohesion C_sj [MPa]", cell(c, "bedding[0].cohesion", b.cohesion, MPa));
  row("Thickness d [mm]", fmt::format("{:g} (given)", b.zone_thickness * 1e3));
  row("Spacing [mm]", fmt::format("{:g} (given)", b.spacing * 1e3));
  return text;
}

std::string macro_table(const Calibration& c) {
  std::string text =
      fmt::format("{:<5} {:>6} {:>5} {:>10} {:>8} {:>10} {:>19} {:>8} {:>10} {:>8}\n", "", "theta", "unit",
                  "lab", "+- se", "fit", "95 % interval", "error", "unseen", "error");
  const auto number = [](double v) { return std::isfinite(v) ? fmt::format("{:.4g}", v) : std::string("-"); };
  const auto error = [](const Comparison* r) {
    if (r == nullptr || !std::isfinite(r->mean)) return std::string("-");
    return r->target.property == Property::nu ? fmt::format("{:+.3f}", r->mean - r->target.mean)
                                              : fmt::format("{:+.1f} %", 100.0 * r->error());
  };
  for (const Comparison& f : c.fitted) {
    const Target& t = f.target;
    const double s = shown(t.property);
    const Comparison* v = row_of(c.verification, t);
    text += fmt::format("{:<5} {:>6g} {:>5} {:>10} {:>8.2g} {:>10} {:>19} {:>8} {:>10} {:>8}\n",
                        to_string(t.property), t.theta, unit_shown(t.property), number(t.mean * s),
                        t.standard_error() * s, number(f.mean * s),
                        fmt::format("{} ... {}", number(f.low * s), number(f.high * s)), error(&f),
                        v != nullptr ? number(v->mean * s) : "-", error(v));
  }
  for (int i = 0; i < n_properties; ++i) {
    const auto p = static_cast<Property>(i);
    if (rms(c.fitted, p) == "-") continue;
    text +=
        fmt::format("RMSE {}: {} fitted, {} on {} unseen packings{}\n", to_string(p), rms(c.fitted, p),
                    rms(c.verification, p), c.verification.empty() ? 0 : c.verification.front().n_packings,
                    rms(c.left_out, p) == "-" ? "" : ", " + rms(c.left_out, p) + " at angles left out");
  }
  return text;
}

std::string verdict_text(const Calibration& c) {
  std::string text = fmt::format("verdict: {}\n", to_string(c.verdict.status));
  for (const std::string& finding : c.verdict.findings) text += "- " + finding + "\n";
  for (const ParameterEstimate& e : c.parameters)
    if (!e.determined)
      text += fmt::format("- {} is left open by the data; it would take {}\n", e.symbol, e.next_test);
  for (const std::string& note : c.notes) text += "- " + note + "\n";
  return text;
}

std::string budget_text(const Calibration& c) {
  return fmt::format("{} tests of UCS{}; {} of all tests on coarse grains; {} direct elastic solutions\n",
                     c.n_strength_tests - c.n_tension_tests,
                     c.n_tension_tests > 0 ? fmt::format(" and {} in tension", c.n_tension_tests) : "",
                     c.n_coarse_tests, c.n_elastic);
}

}  // namespace phy
