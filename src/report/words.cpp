#include "report/words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/check.hpp"
#include "base/text_table.hpp"

namespace phy::report {
namespace {

std::map<FindingKind, Wording> all_words() {
  std::map<FindingKind, Wording> all;
  for (const auto* list : {&words_of_table(), &words_of_maps(), &words_of_calibration(), &words_of_notes(),
                           &words_of_course(), &words_of_design()})
    for (const Wording& w : *list) all[w.kind] = w;
  return all;
}

const Wording& wording_of(FindingKind kind) {
  static const std::map<FindingKind, Wording> all = all_words();
  const auto it = all.find(kind);
  PHY_CHECK(it != all.end(), "a sentence for " + std::string(to_string(kind)));
  return it->second;
}

}  // namespace

std::string sentence(const Finding& finding) {
  const Wording& w = wording_of(finding.kind);
  return w.of_cells ? cells_text(finding.cells) + ": " + w.text(finding) : w.text(finding);
}

std::vector<std::string> sentences(const std::vector<Finding>& findings) {
  std::vector<Finding> merged;
  for (const Finding& f : findings) {
    // cells apart, the same kind says the same: the first takes the cells of the others
    const auto said = std::find_if(merged.begin(), merged.end(), [&](const Finding& m) {
      const Wording& w = wording_of(f.kind);
      return m.kind == f.kind && w.of_cells && w.text(m) == w.text(f);
    });
    if (said == merged.end())
      merged.push_back(f);
    else
      said->cells.insert(said->cells.end(), f.cells.begin(), f.cells.end());
  }
  std::vector<std::string> lines;
  for (const Finding& m : merged) lines.push_back(sentence(m));
  return lines;
}

std::string number_text(double v) {
  const double size = std::fabs(v);
  return !std::isfinite(v) ? "-"
         : size >= 99.95   ? fmt::format("{:.0f}", v)
         : size >= 9.995   ? fmt::format("{:.1f}", v)
         : size >= 0.9995  ? fmt::format("{:.2f}", v)
                           : fmt::format("{:.3f}", v);
}

std::string value_text(Property property, double si) {
  const ShownUnit unit = shown_unit(property);
  const std::string number = number_text(si * unit.factor);
  return *unit.name == '\0' ? number : number + " " + unit.name;
}

std::string percent_text(double share) {
  const double percent = 100.0 * share;
  return std::fabs(percent) < 9.95 ? fmt::format("{:.1f} %", percent) : fmt::format("{:.0f} %", percent);
}

double miss(Property property, double model, double laboratory) {
  return measured(property).absolute ? model - laboratory : model / laboratory - 1.0;
}

std::string miss_text(Property property, double miss) {
  if (!std::isfinite(miss)) return "-";
  return measured(property).absolute ? fmt::format("{:.3f}", miss) : percent_text(miss);
}

std::string miss_text(const Finding& f) {
  const Property p = f.cells.front().property;
  const double off = miss(p, f.number("model"), f.number("laboratory"));
  return fmt::format("{} too {}", miss_text(p, std::fabs(off)), off < 0.0 ? "low" : "high");
}

std::string range_text(double low, double high, const char* format) {
  const std::string a = fmt::format(fmt::runtime(format), low), b = fmt::format(fmt::runtime(format), high);
  return a == b ? a : a + " to " + b;
}

std::string parameter_text(double value, const std::string& unit) {
  if (!unit.starts_with("Pa")) return fmt::format("{:.3g}", value);
  const bool giga = value >= 1e9;
  return fmt::format("{:.3g} {}{}", value * (giga ? 1e-9 : 1e-6), giga ? 'G' : 'M', unit);
}

std::string duration_text(double seconds) {
  if (seconds < 90.0) return fmt::format("{:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("{:.0f} min", seconds / 60.0);
  return fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string duration_text(double low, double high) {
  const std::string from = duration_text(low), to = duration_text(high);
  if (from == to) return to;
  const std::string unit = to.substr(to.rfind(' '));
  return (from.ends_with(unit) ? from.substr(0, from.rfind(' ')) : from) + " to " + to;
}

std::string counted_text(double n, const std::string& noun) {
  return fmt::format("{:.0f} {}{}", n, noun, n == 1.0 ? "" : "s");
}

std::string list_text(const std::vector<std::string>& items) { return joined_text(items, ", ", " and "); }

std::string at_text(const std::vector<double>& angles) {
  std::vector<std::string> items;
  for (const double theta : angles)
    if (std::isfinite(theta)) items.push_back(fmt::format("{:g}", theta));
  return items.empty() ? "" : " at " + list_text(items) + " degrees";
}

std::string test_text(const Cell& c) {
  std::vector<std::string> own;
  if (c.diameter > 0.0) own.push_back(fmt::format("{:g} mm", c.diameter * 1e3));
  if (c.confining > 0.0) own.push_back(fmt::format("{:.3g} MPa", c.confining * 1e-6));
  const std::string name = to_string(c.property);
  return own.empty() ? name : fmt::format("{} ({})", name, fmt::join(own, ", "));
}

std::string cells_text(const std::vector<Cell>& cells) {
  std::vector<std::pair<std::string, std::vector<double>>> tests;
  for (const Cell& c : cells) {
    const std::string name = test_text(c);
    auto at = std::find_if(tests.begin(), tests.end(), [&](const auto& t) { return t.first == name; });
    if (at == tests.end()) at = tests.insert(at, {name, {}});
    at->second.push_back(measured(c.property).along_bedding ? nan : c.theta);
  }
  std::string text;
  for (const auto& [name, angles] : tests) text += (text.empty() ? "" : ", ") + name + at_text(angles);
  return text;
}

}  // namespace phy::report
