#include "report/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "base/text_table.hpp"
#include "records/quality.hpp"
#include "records/test_description.hpp"

namespace phy::report {
namespace {

using Results = std::vector<TestResult>;

/// A test that was interrupted is no result, whatever its curve says up to there.
std::string number(const TestResult& r, const std::string& name, double scale, int digits) {
  if (r.outcome.status == Status::interrupted) return "-";
  for (const Number& n : r.numbers) {
    if (n.name != name) continue;
    if (!std::isfinite(n.value)) return "-";
    // of a stress that loading has yet to bring: nothing below zero
    const double value = n.upper_bound ? std::max(n.value, 0.0) : n.value;
    return fmt::format("{}{:.{}f}", n.upper_bound ? "<" : "", value * scale, digits);
  }
  return "-";
}

/// "*": a strength that is none, or a bound of it; its note says why (missing_numbers).
bool has_reservation(const TestResult& r, const Number& n) {
  return n.name == r.kind->curve.quantity().number && std::isfinite(n.value) && !n.note.empty();
}

/// "*" as well: a measure of quality speaks of this number, in a line below the table (quality_lines).
bool is_marked(const TestResult& r, const Number& n) {
  if (!has_strength(r.outcome.status)) return false;
  const std::vector<QualityMark> marks = quality_marks(r.numbers);
  return std::any_of(marks.begin(), marks.end(), [&](const QualityMark& m) {
    // A measure of the whole test speaks in the column of quality; a star at every number would say nothing.
    return !m.limit->of.empty() && m.limit->speaks_of(n.name);
  });
}

/// A column of the kind of test.
Column reading(const Results& results, const TableColumn& c) {
  return column_of(c.head, c.unit, results, [&](const TestResult& r) {
    const std::string cell = number(r, c.number, c.scale, c.digits);
    const bool marked = std::any_of(r.numbers.begin(), r.numbers.end(), [&](const Number& n) {
      return n.name == c.number && (has_reservation(r, n) || is_marked(r, n));
    });
    return cell != "-" && marked ? cell + "*" : cell;
  });
}

Column cracks(const std::string& place, const Results& results) {
  return column_of("cracks " + place, "tension/shear", results, [&](const TestResult& r) {
    return number(r, "cracks_tension_" + place, 1.0, 0) + "/" + number(r, "cracks_shear_" + place, 1.0, 0);
  });
}

/// The angle if it tells the specimens apart, else their names.
Column label(const Results& results) {
  Column angles = column_of("theta", "deg", results, [](const TestResult& r) {
    return r.intact ? "intact" : fmt::format("{:g}", r.theta);
  });
  // Two specimens of one angle would be two rows that nobody can tell apart.
  if (std::set<std::string>(angles.cells.begin(), angles.cells.end()).size() == results.size()) return angles;
  Column names = column_of("specimen", "", results, [](const TestResult& r) { return r.name; });
  names.left = true;
  return names;
}

Columns curve_columns(const Results& results) {
  Columns columns;
  const TestKind kind = results.empty() ? TestKind() : results.front().kind;
  for (const TableColumn& c : kind->table) columns.push_back(reading(results, c));
  // The balance of energy stands beside every result: it is the first thing that a wrong step spoils.
  columns.push_back(reading(results, {"energy", "error", "energy_error", 1.0, 5}));
  return columns;
}

Columns run_columns(const Results& results) {
  return {
      cracks("matrix", results),
      cracks("bedding", results),
      column_of("steps", "", results, [](const TestResult& r) { return fmt::format("{}", r.n_steps); }),
      column_of("CPU", "s", results, [](const TestResult& r) { return fmt::format("{:.1f}", r.seconds); }),
      column_of("outcome", "", results, [](const TestResult& r) { return to_string(r.outcome.status); }),
      column_of("quality", "", results, [](const TestResult& r) { return to_string(grade_of(r)); })};
}

}  // namespace

std::string press_table(const Results& results, int terminal_width) {
  return text_table(label(results), {curve_columns(results), run_columns(results)}, terminal_width);
}

namespace {

/// As the head of the table has it: "BTS" for "bts".
std::string head_of(const TestResult& r, const Number& n) {
  for (const TableColumn& c : r.kind->table)
    if (n.name == c.number) return c.head;
  return n.name;
}

}  // namespace

std::string missing_numbers(const Results& results) {
  std::vector<std::pair<std::string, std::string>> reported;  // reason, tests
  for (const TestResult& r : results) {
    for (const Number& n : r.numbers) {
      // Thresholds of damage lack for physical reasons that a reader will ask for; of others the outcome
      // tells.
      const bool missing = (n.name == "sigma_ci" || n.name == "sigma_ci_strain" || n.name == "sigma_cd") &&
                           !std::isfinite(n.value);
      if (!has_strength(r.outcome.status) || (!missing && !has_reservation(r, n))) continue;
      const std::string reason = head_of(r, n) + (missing ? " -: " : " *: ") + n.note;
      const auto it =
          std::find_if(reported.begin(), reported.end(), [&](const auto& t) { return t.first == reason; });
      // Reasons are mostly common to all angles: one line with the names.
      if (it == reported.end())
        reported.emplace_back(reason, r.name);
      else
        it->second += ", " + r.name;
    }
  }
  std::string text;
  for (const auto& [reason, tests] : reported) text += fmt::format("{} ({})\n", reason, tests);
  return text;
}

namespace {

/// One line per measure and limit, with the tests and their values. Of tests that are not to be trusted, or
/// found no peak, the outcome tells the cause, and the rest follows from it.
std::string quality_lines(const Results& results) {
  std::vector<std::pair<QualityMark, std::string>> reported;  // a mark, tests with values
  for (const TestResult& r : results) {
    if (!has_strength(r.outcome.status)) continue;
    for (const QualityMark& mark : quality_marks(r.numbers)) {
      const std::string test = r.name + " " + mark.value_text();
      const auto same = [&](const auto& t) {
        return t.first.limit == mark.limit && t.first.grade == mark.grade;
      };
      if (const auto it = std::find_if(reported.begin(), reported.end(), same); it != reported.end())
        it->second += ", " + test;
      else
        reported.emplace_back(mark, test);
    }
  }
  std::string text;
  for (const auto& [mark, tests] : reported)
    text += fmt::format("{}: {}: {}; {} ({})\n", mark.heading(), mark.name(), mark.limit->says,
                        mark.limit->advice, tests);
  return text;
}

}  // namespace

std::string outcome_lines(const Results& results) {
  std::string text = missing_numbers(results) + quality_lines(results);
  for (const TestResult& r : results) {
    if (r.outcome.status == Status::peaked)
      continue;  // a knee is told: it is not what the laboratory calls UCS
    text += r.name + ": " + to_string(r.outcome.status);
    if (!r.outcome.reason.empty()) text += ": " + r.outcome.reason;
    if (!r.outcome.advice.empty()) text += "; " + r.outcome.advice;
    text += "\n";
  }
  return text;
}

}  // namespace phy::report
