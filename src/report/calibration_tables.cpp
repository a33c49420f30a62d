#include "report/calibration_tables.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace phy {
namespace {

/// Factor and name of the unit in which a property is printed.
double shown(Property p) { return p == Property::E ? 1e-9 : p == Property::nu ? 1.0 : 1e-6; }
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

}  // namespace phy
