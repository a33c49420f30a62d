#include "report/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace phy {
namespace {

struct Column {
  std::string head, unit;
  std::function<std::string(const TestResult&)> cell;
};

std::string number(const TestResult& r, const std::string& name, double scale, int digits) {
  for (const Number& n : r.numbers)
    if (n.name == name) return std::isfinite(n.value) ? fmt::format("{:.{}f}", n.value * scale, digits) : "-";
  return "-";
}

Column value(std::string head, std::string unit, std::string name, double scale, int digits) {
  return {std::move(head), std::move(unit), [name = std::move(name), scale, digits](const TestResult& r) {
            return number(r, name, scale, digits);
          }};
}

std::vector<Column> columns() {
  return {
      {"specimen", "", [](const TestResult& r) { return r.name; }},
      value("E tan 50", "GPa", "E_tangent", 1e-9, 2),
      value("E sec 50", "GPa", "E_secant", 1e-9, 2),
      value("nu", "", "nu", 1.0, 3),
      value("UCS", "MPa", "ucs", 1e-6, 2),
      value("sigma_ci", "MPa", "sigma_ci", 1e-6, 2),
      value("sigma_cd", "MPa", "sigma_cd", 1e-6, 2),
      value("tension", "matrix", "cracks_tension_matrix", 1.0, 0),
      value("shear", "matrix", "cracks_shear_matrix", 1.0, 0),
      value("tension", "bedding", "cracks_tension_bedding", 1.0, 0),
      value("shear", "bedding", "cracks_shear_bedding", 1.0, 0),
      value("energy", "error", "energy_error", 1.0, 5),
      {"steps", "", [](const TestResult& r) { return fmt::format("{}", r.n_steps); }},
      {"CPU", "s", [](const TestResult& r) { return fmt::format("{:.1f}", r.seconds); }},
      {"outcome", "", [](const TestResult& r) { return std::string(to_string(r.outcome.status)); }},
  };
}

std::size_t width_of(const Column& c, const std::vector<TestResult>& results) {
  std::size_t w = std::max(c.head.size(), c.unit.size());
  for (const TestResult& r : results) w = std::max(w, c.cell(r).size());
  return w;
}

std::string render(const std::vector<Column>& cols, const std::vector<TestResult>& results) {
  std::string heads, units, rule;
  std::vector<std::string> rows(results.size());
  for (std::size_t i = 0; i < cols.size(); ++i) {
    const std::size_t w = width_of(cols[i], results);
    const char* gap = i == 0 ? "" : "  ";
    const auto cell = [&](const std::string& s) {
      return i == 0 ? fmt::format("{}{:<{}}", gap, s, w) : fmt::format("{}{:>{}}", gap, s, w);
    };
    heads += cell(cols[i].head);
    units += cell(cols[i].unit);
    rule += gap + std::string(w, '-');
    for (std::size_t k = 0; k < results.size(); ++k) rows[k] += cell(cols[i].cell(results[k]));
  }
  std::string text = heads + "\n" + units + "\n" + rule + "\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

std::string as_list(const std::vector<Column>& cols, const std::vector<TestResult>& results) {
  std::string text;
  for (const TestResult& r : results) {
    text += r.name + "\n";
    for (std::size_t i = 1; i < cols.size(); ++i)
      text += fmt::format("  {:<9}{:<8}{}\n", cols[i].head, cols[i].unit, cols[i].cell(r));
  }
  return text;
}

}  // namespace

std::string press_table(const std::vector<TestResult>& results, int width) {
  const std::vector<Column> all = columns();
  if (width < 60) return as_list(all, results);
  std::string text;
  std::vector<Column> part = {all[0]};
  std::size_t used = width_of(all[0], results);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const std::size_t w = width_of(all[i], results) + 2;
    if (used + w > static_cast<std::size_t>(width) && part.size() > 1) {
      text += render(part, results) + "\n";
      part = {all[0]};
      used = width_of(all[0], results);
    }
    part.push_back(all[i]);
    used += w;
  }
  return text + render(part, results);
}

std::string outcome_lines(const std::vector<TestResult>& results) {
  std::string text;
  for (const TestResult& r : results) {
    if (r.outcome.status == Status::peaked) continue;
    text += fmt::format("{}: {}: {}{}{}\n", r.name, to_string(r.outcome.status), r.outcome.reason,
                        r.outcome.advice.empty() ? "" : "; ", r.outcome.advice);
  }
  return text;
}

}  // namespace phy
