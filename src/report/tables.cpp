#include "report/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <utility>

#include "records/quality.hpp"
#include "report/text_table.hpp"

namespace phy {
namespace {

using Results = std::vector<TestResult>;

Column column(std::string head, std::string unit, const Results& results,
              const std::function<std::string(const TestResult&)>& cell) {
  Column c{std::move(head), std::move(unit), {}};
  for (const TestResult& r : results) c.cells.push_back(cell(r));
  return c;
}

/// A test that was interrupted is no result, whatever its curve says up to there.
std::string number(const TestResult& r, const std::string& name, double scale, int digits) {
  if (r.outcome.status == Status::interrupted) return "-";
  for (const Number& n : r.numbers) {
    if (n.name != name) continue;
    if (!std::isfinite(n.value)) return "-";
    const bool bound =
        n.note.starts_with("below");  // of a stress that loading has yet to bring: nothing below zero
    return fmt::format("{}{:.{}f}", bound ? "<" : "", (bound ? std::max(n.value, 0.0) : n.value) * scale,
                       digits);
  }
  return "-";
}

Column reading(std::string head, std::string unit, const Results& results, const char* name, double scale,
               int digits) {
  return column(std::move(head), std::move(unit), results,
                [=](const TestResult& r) { return number(r, name, scale, digits); });
}

/// "*": a strength that is none, or a bound of it; its note says why (missing_numbers).
bool has_reservation(const Number& n) {
  return (n.name == "bts" || n.name == "sigma_t") && std::isfinite(n.value) && !n.note.empty();
}
Column strength(std::string head, const Results& results, const char* name) {
  return column(std::move(head), "MPa", results, [=](const TestResult& r) {
    const auto n =
        std::find_if(r.numbers.begin(), r.numbers.end(), [&](const Number& x) { return x.name == name; });
    const std::string cell = number(r, name, 1e-6, 2);
    return cell != "-" && has_reservation(*n) ? cell + "*" : cell;
  });
}

Column cracks(const std::string& place, const Results& results) {
  return column("cracks " + place, "tension/shear", results, [&](const TestResult& r) {
    return number(r, "cracks_tension_" + place, 1.0, 0) + "/" + number(r, "cracks_shear_" + place, 1.0, 0);
  });
}

/// The angle if it tells the specimens apart, else their names.
Column label(const Results& results) {
  Column angles = column("theta", "deg", results, [](const TestResult& r) {
    return r.intact ? "intact" : fmt::format("{:g}", r.theta);
  });
  if (std::set<std::string>(angles.cells.begin(), angles.cells.end()).size() == results.size()) return angles;
  Column names = column("specimen", "", results, [](const TestResult& r) { return r.name; });
  names.left = true;
  return names;
}

Columns tension_columns(const Results& results) {
  return {reading("E tan50", "GPa", results, "E_tangent", 1e-9, 2), reading("nu", "", results, "nu", 1.0, 3),
          strength("sigma_t", results, "sigma_t"), reading("sigma_ci", "MPa", results, "sigma_ci", 1e-6, 2),
          reading("cracks at", "the grips", results, "failure_at_grip", 1.0, 2)};
}

Columns disc_columns(const Results& results) {
  return {strength("BTS", results, "bts"), reading("sigma_ci", "MPa", results, "sigma_ci", 1e-6, 2),
          reading("1st crack", "y/D", results, "first_crack_y", 1.0, 2),
          reading("1st crack", "x/D", results, "first_crack_x", 1.0, 2),
          reading("cracks in", "central third", results, "central_cracks", 1.0, 2)};
}

Columns confined_columns(const Results& results) {
  return {reading("E tan50", "GPa", results, "E_tangent", 1e-9, 2),
          reading("nu", "", results, "nu", 1.0, 3),
          reading("sigma_3", "MPa", results, "sigma_3", 1e-6, 2),
          reading("sigma_1", "MPa", results, "sigma_1", 1e-6, 2),
          reading("sigma_ci", "MPa, q", results, "sigma_ci", 1e-6, 2),
          reading("sigma_cd", "MPa, q", results, "sigma_cd", 1e-6, 2),
          reading("confinem.", "error", results, "confinement_error", 1.0, 4)};
}

Columns shear_columns(const Results& results) {
  return {reading("sigma_n", "MPa", results, "sigma_n", 1e-6, 2),
          reading("tau peak", "MPa", results, "tau_peak", 1e-6, 2),
          reading("u peak", "um", results, "u_peak", 1e6, 2),
          reading("tau resid.", "MPa", results, "tau_residual", 1e-6, 2),
          reading("K_s", "GPa/m", results, "K_s", 1e-9, 1),
          reading("dilation", "deg", results, "dilation", 1.0, 2)};
}

Columns numbers_of_kind(const Results& results) {
  switch (results.empty() ? TestKind::uniaxial : results.front().kind) {
    case TestKind::uniaxial: break;
    case TestKind::direct_tension: return tension_columns(results);
    case TestKind::brazilian: return disc_columns(results);
    case TestKind::biaxial: return confined_columns(results);
    case TestKind::direct_shear: return shear_columns(results);
  }
  return {reading("E tan50", "GPa", results, "E_tangent", 1e-9, 2),
          reading("E sec50", "GPa", results, "E_secant", 1e-9, 2),
          reading("nu", "", results, "nu", 1.0, 3),
          reading("UCS", "MPa", results, "ucs", 1e-6, 2),
          reading("sigma_ci", "MPa", results, "sigma_ci", 1e-6, 2),
          reading("sigma_cd", "MPa", results, "sigma_cd", 1e-6, 2)};
}

Columns curve_columns(const Results& results) {
  Columns columns = numbers_of_kind(results);
  columns.push_back(reading("energy", "error", results, "energy_error", 1.0, 5));
  return columns;
}

Columns run_columns(const Results& results) {
  return {cracks("matrix", results),
          cracks("bedding", results),
          column("steps", "", results, [](const TestResult& r) { return fmt::format("{}", r.n_steps); }),
          column("CPU", "s", results, [](const TestResult& r) { return fmt::format("{:.1f}", r.seconds); }),
          column("outcome", "", results, [](const TestResult& r) { return to_string(r.outcome.status); }),
          column("quality", "", results, [](const TestResult& r) {
            const bool ended = r.outcome.status == Status::peaked || r.outcome.status == Status::not_peaked ||
                               r.outcome.status == Status::untrusted;
            if (!ended) return "-";
            return to_string(grade_of(r.numbers));
          })};
}

}  // namespace

std::string press_table(const Results& results, int terminal_width) {
  return text_table(label(results), {curve_columns(results), run_columns(results)}, terminal_width);
}

std::string missing_numbers(const Results& results) {
  std::vector<std::pair<std::string, std::string>> told;  // reason, tests
  for (const TestResult& r : results) {
    for (const Number& n : r.numbers) {
      const bool missing = (n.name == "sigma_ci" || n.name == "sigma_cd") && !std::isfinite(n.value);
      if (r.outcome.status != Status::peaked || (!missing && !has_reservation(n))) continue;
      const std::string reason = (n.name == "bts" ? "BTS" : n.name) + (missing ? " -: " : " *: ") + n.note;
      const auto it =
          std::find_if(told.begin(), told.end(), [&](const auto& t) { return t.first == reason; });
      if (it == told.end())
        told.emplace_back(reason, r.name);
      else
        it->second += ", " + r.name;
    }
  }
  std::string text;
  for (const auto& [reason, tests] : told) text += fmt::format("{} ({})\n", reason, tests);
  return text;
}

namespace {

/// One line per measure and limit, with the tests and their values. Of tests that are not to be trusted, or
/// found no peak, the outcome tells the cause, and the rest follows from it.
std::string quality_lines(const Results& results) {
  std::vector<std::pair<QualityMark, std::string>> told;  // a mark, tests with values
  for (const TestResult& r : results) {
    if (r.outcome.status != Status::peaked) continue;
    for (const QualityMark& mark : quality_marks(r.numbers)) {
      const std::string test = fmt::format("{} {:.2g}", r.name, mark.value);
      const auto same = [&](const auto& t) {
        return t.first.limit == mark.limit && t.first.grade == mark.grade;
      };
      if (const auto it = std::find_if(told.begin(), told.end(), same); it != told.end())
        it->second += ", " + test;
      else
        told.emplace_back(mark, test);
    }
  }
  std::string text;
  for (const auto& [mark, tests] : told)
    text += fmt::format("{}: {}: {}; {} ({})\n", to_string(mark.grade), mark.name(), mark.limit->says,
                        mark.limit->advice, tests);
  return text;
}

}  // namespace

std::string outcome_lines(const Results& results) {
  std::string text = missing_numbers(results) + quality_lines(results);
  for (const TestResult& r : results) {
    if (r.outcome.status == Status::peaked) continue;
    text += r.name + ": " + to_string(r.outcome.status);
    if (!r.outcome.reason.empty()) text += ": " + r.outcome.reason;
    if (!r.outcome.advice.empty()) text += "; " + r.outcome.advice;
    text += "\n";
  }
  return text;
}

}  // namespace phy
