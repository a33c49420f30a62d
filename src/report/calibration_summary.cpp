#include "report/calibration_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text_table.hpp"
#include "records/measured_property.hpp"
#include "report/words.hpp"

namespace phy::report {
namespace {

constexpr std::size_t most_lines = 10;
constexpr int usual_width = 80;  // of a terminal, where there is none

bool is_in(const std::vector<FindingKind>& kinds, FindingKind kind) {
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}
// Kinds that are gathered by test: values that are missed, that have no answer, that nothing resolves.
const std::vector<FindingKind> missed = {FindingKind::fit_missed, FindingKind::value_missed,
                                         FindingKind::packings_differ};
const std::vector<FindingKind> unanswered = {FindingKind::fit_unanswered, FindingKind::value_unanswered,
                                             FindingKind::no_usable_peak, FindingKind::search_unanswered};
const std::vector<FindingKind> coarse = {FindingKind::value_unresolved};

/// The cell as a finding of these kinds names it, without an angle where the rock has no bedding; nullptr:
/// none does.
const Cell* named_cell(const Calibration& c, const Target& t, const std::vector<FindingKind>& kinds) {
  for (const Finding& f : c.verdict.findings) {
    if (!is_in(kinds, f.kind)) continue;
    for (const Cell& named : f.cells) {
      Cell cell = named;
      if (std::isnan(cell.theta)) cell.theta = t.theta;
      if (cell == cell_of(t)) return &named;
    }
  }
  return nullptr;
}

std::string span(const std::vector<double>& values, const char* format) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return range_text(*low, *high, format);
}

/// "UCS is 11 to 13 % off at 30, 75 and 90 degrees.", of the cells of one test that findings name.
void add_cells(std::vector<std::string>& lines, const Calibration& c, const Target& test) {
  const std::string name = test_name(test);
  const bool nu = test.property == Property::nu;
  std::vector<double> off, where, silent, unresolved;
  for (const Comparison& f : c.fitted) {
    if (!same_test(f.target, test)) continue;
    if (const Cell* cell = named_cell(c, f.target, coarse)) unresolved.push_back(cell->theta);
    if (const Cell* cell = named_cell(c, f.target, unanswered)) silent.push_back(cell->theta);
    const Cell* cell = named_cell(c, f.target, missed);
    if (cell == nullptr) continue;
    where.push_back(cell->theta);
    off.push_back((nu ? 1.0 : 100.0) * std::fabs(miss(judged(c, f))));
  }
  if (!off.empty())
    lines.push_back(fmt::format("{} is {}{} off{}.", name,
                                span(off, nu                                                 ? "{:.2f}"
                                          : *std::max_element(off.begin(), off.end()) < 9.95 ? "{:.2g}"
                                                                                             : "{:.0f}"),
                                nu ? "" : " %", at_text(where)));
  if (!silent.empty()) lines.push_back(fmt::format("{} has no answer{}.", name, at_text(silent)));
  if (!unresolved.empty())
    lines.push_back(
        fmt::format("{} is not resolved{}; tables.txt has the errors that would pass, and what would help.",
                    name, at_text(unresolved)));
}

/// "UCS/BTS is 4.3 to 8.4 in the table and 5.3 to 6.4 in the nearest model at 0 and 30 degrees."
void add_ratios(std::vector<std::string>& lines, const Calibration& c, Property p) {
  std::vector<double> laboratory, model, where;
  for (const Finding& f : c.verdict.findings) {
    if (f.kind != FindingKind::ratio_missed || f.cells[1].property != p) continue;
    laboratory.push_back(f.number("laboratory")), model.push_back(f.number("model"));
    where.push_back(f.cells[1].theta);
  }
  if (!laboratory.empty())
    lines.push_back(fmt::format("UCS/{} is {} in the table and {} in the nearest model{}.", to_string(p),
                                span(laboratory, "{:.1f}"), span(model, "{:.1f}"), at_text(where)));
}

}  // namespace

const Comparison& judged(const Calibration& c, const Comparison& fitted) {
  const Comparison* unseen = row_of(c.verification, fitted.target);
  return unseen != nullptr ? *unseen : fitted;
}

std::string open_parameters(const Calibration& c) {
  std::vector<std::string> open;
  for (const ParameterEstimate& e : c.parameters)
    if (e.open()) open.push_back(e.symbol);
  return list_text(open);
}

std::vector<std::string> open_lines(const Calibration& c) {
  std::vector<std::pair<std::string, std::vector<std::string>>>
      open;  // by the test that would determine them
  for (const ParameterEstimate& e : c.parameters) {
    if (!e.open()) continue;
    auto at =
        std::find_if(open.begin(), open.end(), [&](const auto& o) { return o.first == text_of(e.next); });
    if (at == open.end()) at = open.insert(at, {text_of(e.next), {}});
    at->second.push_back(e.symbol);
  }
  std::vector<std::string> lines;
  for (const auto& [test, symbols] : open)
    lines.push_back(fmt::format("{}: not determined by this table; {}.", list_text(symbols),
                                test.empty() ? "no test of a table would" : "next: " + test));
  return lines;
}

std::vector<std::string> summary_lines(const Calibration& c) {
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < c.fitted.size(); ++i)  // once for every test
    if (std::none_of(c.fitted.begin(), c.fitted.begin() + static_cast<std::ptrdiff_t>(i),
                     [&](const Comparison& f) { return same_test(f.target, c.fitted[i].target); }))
      add_cells(lines, c, c.fitted[i].target);
  for (const MeasuredProperty& p : measured_properties())
    if (is_tensile(p.property)) add_ratios(lines, c, p.property);
  std::vector<Finding> others = c.verdict.findings;
  std::erase_if(others, [](const Finding& f) {
    return is_in(missed, f.kind) || is_in(unanswered, f.kind) || is_in(coarse, f.kind) ||
           f.kind == FindingKind::ratio_missed;
  });
  for (std::string& line : sentences(others)) lines.push_back(std::move(line));
  const std::string open = open_parameters(c);
  if (!open.empty() && c.verdict.status != VerdictStatus::calibrated)  // else the verdict says so
    lines.push_back(fmt::format("The data do not determine {}.", open));
  return lines;
}

std::string summary_text(const Calibration& c, int terminal_width) {
  std::string text;
  std::size_t used = 0, left = sentences(c.notes).size();
  for (const std::string& line : summary_lines(c)) {
    const std::string item = "- " + line + "\n";
    const std::string as_seen = wrapped(item, terminal_width > 0 ? terminal_width : usual_width, 2);
    const auto n = static_cast<std::size_t>(std::count(as_seen.begin(), as_seen.end(), '\n'));
    if (used + n < most_lines)
      text += wrapped(item, terminal_width, 2), used += n;
    else
      ++left;
  }
  const bool goes_on = left > 0 && c.verdict.status != VerdictStatus::interrupted;
  return text + (goes_on ? fmt::format("- {} more in tables.txt\n", left) : "");
}

}  // namespace phy::report
