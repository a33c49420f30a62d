#include "report/calibration_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/lines.hpp"
#include "base/text_table.hpp"

namespace phy::report {
namespace {

constexpr std::size_t most_lines = 10;
constexpr int usual_width = 80;  // of a terminal, where there is none

/// Is a cell, or a ratio to it, among the subjects of a finding: "E(0), E(15): ...", "UCS(30) = ..."?
bool speaks_of(const std::string& finding, const std::string& name) {
  const std::size_t end = std::min(finding.find(" = "), finding.find(": "));
  for (std::size_t at = finding.find(name); at < end; at = finding.find(name, at + 1))
    if (at == 0 || finding.substr(0, at).ends_with(", ")) return true;
  return false;
}
std::string ratio_name(const Target& t) {
  return fmt::format("UCS/{}({:g})", to_string(t.property), t.theta);
}

bool is_unresolved(const std::string& finding) { return finding.find(": not resolved") != finding.npos; }

/// Do findings that tell a miss, or those that are too coarse to tell, name it?
bool is_named(const Calibration& c, const std::string& name, bool unresolved = false) {
  return std::any_of(c.verdict.findings.begin(), c.verdict.findings.end(), [&](const std::string& finding) {
    return is_unresolved(finding) == unresolved && speaks_of(finding, name);
  });
}

/// What findings say beside cells of the table and ratios to them.
std::vector<std::string> of_no_cell(std::vector<std::string> findings, const Calibration& c) {
  std::erase_if(findings, [&](const std::string& finding) {
    return std::any_of(c.fitted.begin(), c.fitted.end(), [&](const Comparison& f) {
      return speaks_of(finding, cell_name(f.target)) || speaks_of(finding, ratio_name(f.target));
    });
  });
  return findings;
}

/// "11 - 13", or one number where both look alike.
std::string span(const std::vector<double>& values, const char* format) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const std::string a = fmt::format(fmt::runtime(format), *low), b = fmt::format(fmt::runtime(format), *high);
  return a == b ? a : a + " - " + b;
}

/// "UCS 11 - 13 % off at 30, 75, 90 degrees", of the cells of one test that findings name.
void add_cells(std::vector<std::string>& lines, const Calibration& c, const Target& test) {
  const std::string name = test_name(test);
  const bool nu = test.property == Property::nu;
  std::vector<double> off, where, silent, coarse;
  for (const Comparison& f : c.fitted) {
    if (!same_test(f.target, test)) continue;
    if (is_named(c, cell_name(f.target), true)) coarse.push_back(f.target.theta);
    if (!is_named(c, cell_name(f.target))) continue;
    const Comparison& row = judged(c, f);
    (row.answered() ? where : silent).push_back(f.target.theta);
    if (row.answered()) off.push_back(std::fabs(nu ? row.mean - row.target.mean : 100.0 * row.error()));
  }
  if (!off.empty())
    lines.push_back(fmt::format("{} {}{} off at {:g} degrees", name,
                                span(off, nu                                                 ? "{:.2f}"
                                          : *std::max_element(off.begin(), off.end()) < 9.95 ? "{:.2g}"
                                                                                             : "{:.0f}"),
                                nu ? "" : " %", fmt::join(where, ", ")));
  if (!silent.empty())
    lines.push_back(fmt::format("{}: no answer at {:g} degrees", name, fmt::join(silent, ", ")));
  if (!coarse.empty())
    lines.push_back(fmt::format(
        "{} not resolved at {:g} degrees: tables.txt says which misses would pass and what would help", name,
        fmt::join(coarse, ", ")));
}

/// "UCS/BTS 4.3 - 8.4 in the laboratory, 5.3 - 6.4 in the nearest model, at 0, 30 degrees".
void add_ratios(std::vector<std::string>& lines, const Calibration& c, Property p) {
  std::vector<double> laboratory, model;
  std::set<double> where;
  for (const Comparison& t : c.verification)
    for (const Comparison& u : c.verification)
      if (t.target.property == p && u.target.property == Property::ucs && t.target.theta == u.target.theta &&
          is_named(c, ratio_name(t.target))) {
        laboratory.push_back(u.target.mean / t.target.mean), model.push_back(u.mean / t.mean);
        where.insert(t.target.theta);
      }
  if (!laboratory.empty())
    lines.push_back(fmt::format("UCS/{} {} in the laboratory, {} in the nearest model, at {:g} degrees",
                                to_string(p), span(laboratory, "{:.1f}"), span(model, "{:.1f}"),
                                fmt::join(where, ", ")));
}

}  // namespace

const Comparison& judged(const Calibration& c, const Comparison& fitted) {
  const Comparison* unseen = row_of(c.verification, fitted.target);
  return unseen != nullptr ? *unseen : fitted;
}

std::vector<std::string> open_lines(const Calibration& c) {
  std::vector<std::string> open;
  for (const ParameterEstimate& e : c.parameters)
    if (e.open())
      add_line(open, e.symbol,
               e.next.remedy == Remedy::none
                   ? "not determined by this table; no test of a table determines it"
                   : "not determined by this table; next: " + text_of(e.next));
  return open;
}

std::vector<std::string> summary_lines(const Calibration& c) {
  std::vector<std::string> lines, open;
  for (std::size_t i = 0; i < c.fitted.size(); ++i)  // once for every test
    if (std::none_of(c.fitted.begin(), c.fitted.begin() + static_cast<std::ptrdiff_t>(i),
                     [&](const Comparison& f) { return same_test(f.target, c.fitted[i].target); }))
      add_cells(lines, c, c.fitted[i].target);
  for (const Property p : {Property::direct_tension, Property::brazilian}) add_ratios(lines, c, p);
  const std::vector<std::string> rest = of_no_cell(c.verdict.findings, c);
  for (const ParameterEstimate& e : c.parameters)
    if (e.open()) open.push_back(e.symbol);
  lines.insert(lines.end(), rest.begin(), rest.end());
  if (!open.empty()) lines.push_back(fmt::format("left open by the data: {}", fmt::join(open, ", ")));
  return lines;
}

std::string summary_text(const Calibration& c, int terminal_width) {
  std::string text;
  std::size_t used = 0, left = c.notes.size();
  for (const std::string& line : summary_lines(c)) {
    const std::string item = "- " + line + "\n";
    const std::string as_seen = wrapped(item, terminal_width > 0 ? terminal_width : usual_width, 2);
    const auto n = static_cast<std::size_t>(std::count(as_seen.begin(), as_seen.end(), '\n'));
    if (used + n < most_lines)
      text += wrapped(item, terminal_width, 2), used += n;
    else
      ++left;
  }
  const bool told_elsewhere = left > 0 && c.verdict.status != VerdictStatus::interrupted;
  return text + (told_elsewhere ? fmt::format("- {} more in tables.txt\n", left) : "");
}

}  // namespace phy::report
