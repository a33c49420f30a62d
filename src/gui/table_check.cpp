#include "gui/table_check.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "calibrate/outlook.hpp"
#include "gui/project.hpp"
#include "io/table.hpp"
#include "jobs/check_summary.hpp"
#include "jobs/machine.hpp"
#include "jobs/time_left.hpp"
#include "report/angle_panels.hpp"
#include "report/calibration_figures.hpp"
#include "report/figure_json.hpp"
#include "report/finding_json.hpp"
#include "rock/file.hpp"

namespace phy::gui {
namespace {

/// The line behind the name of a file, "shale.csv:12"; 0: another file, or none named.
int line_in(const std::string& where, const std::string& file) {
  if (!where.starts_with(file + ":")) return 0;
  int line = 0;
  std::from_chars(where.data() + file.size() + 1, where.data() + where.size(), line);
  return line;
}

/// The one cell of a line that holds what a problem quotes; -1: none, or several.
int column_of(const io::Table& table, int line, const Problem& problem) {
  const auto quoted = [&](const std::string& cell) {
    return !cell.empty() && (problem.value == cell || problem.value.starts_with(cell + " ") ||
                             (line == table.header_line && problem.key == cell));
  };
  const std::vector<std::string>* cells = line == table.header_line ? &table.header : nullptr;
  for (const io::TableRow& row : table.rows)
    if (row.line == line) cells = &row.cells;
  if (cells == nullptr) return -1;
  int found = -1;
  for (std::size_t i = 0; i < cells->size(); ++i) {
    if (!quoted((*cells)[i])) continue;
    // Two equal cells: pointing at the wrong one is worse than pointing at the line.
    if (found >= 0) return -1;
    found = static_cast<int>(i);
  }
  return found;
}

Json problem_json(Problem problem, const std::string& toml_file, const std::string& table_file,
                  const io::Table& table) {
  const int in_table = line_in(problem.where, table_file), in_rock = line_in(problem.where, toml_file);
  const bool of_table =
      // Sheets of a workbook are named in brackets.
      in_table > 0 || problem.where == table_file || problem.where.starts_with(table_file + " [");
  const int line = of_table ? in_table : in_rock;
  const int column = in_table > 0 ? column_of(table, in_table, problem) : -1;
  // The page shows where: the name of a file would stand in every message.
  if (of_table || in_rock > 0 || problem.where == toml_file) problem.where.clear();
  if (problem.key.empty()) std::swap(problem.key, problem.value);  // "4 cells: expected ..."
  return {{"where", of_table ? "table" : "rock"},
          {"line", line > 0 ? Json(line) : Json(nullptr)},
          {"column", column >= 0 ? Json(column) : Json(nullptr)},
          {"text", to_line(problem)}};
}

Json target_json(const Target& t) {
  const double half = t.half_width();
  Json j = {{"property", to_string(t.property)},
            {"title", report::axis_of(t.property).label() + particulars(t)},
            {"factor", shown_unit(t.property).factor},
            {"unit", inner_unit(measured(t.property).dimension)},
            {"theta", t.theta},
            {"mean", t.mean},
            {"sd", t.sd},
            {"n", t.n},
            {"sd_assumed", t.sd_assumed},
            {"low", t.mean - half},
            {"high", t.mean + half},
            {"specimens", t.specimens}};
  if (t.confining > 0.0) j["confining"] = t.confining;
  if (t.diameter > 0.0) j["diameter"] = t.diameter;
  return j;
}

Json parameter_json(const ParameterEstimate& e) {
  const Json interval = !std::isfinite(e.low) ? Json(nullptr)
                        : e.determined        ? Json(fmt::format("x {:.2f} ... {:.2f}", e.low, e.high))
                                              : Json("wide");
  return {{"symbol", e.symbol},
          {"determined", e.determined},
          {"interval", interval},
          {"rests_on", report::support_json(e.rests_on)},
          {"next", report::next_json(e.next)}};
}

/// Tests and time by each effort; empty where nothing can be fitted.
Json course_json(const Evidence& evidence) {
  Json list = Json::array();
  for (const calibrate::Effort& effort : calibrate::efforts) try {
      calibrate::CalibrationOptions options;
      options.effort = effort;
      const Finding course =
          jobs::expected_course(calibrate::outlook_of(evidence, options), jobs::n_threads(0));
      list.push_back(report::finding_json(course));
      list.back()["effort"] = effort.name;
    } catch (const InputError&) {
    }
  return list;
}

void add_check(const Rock& rock, Json& answer) {
  const jobs::RockCheck found = jobs::check(rock);
  answer["bedded"] = rock.bedded;
  answer["doubts"] = report::findings_json(found.doubts);
  answer["notes"] = rock.notes;
  for (const Target& t : found.evidence.targets) answer["targets"].push_back(target_json(t));
  answer["figure"] = report::figure_json(report::laboratory_figure(found.evidence.targets));
  answer["statements"] = report::findings_json(found.statements);
  for (const ParameterEstimate& e : found.parameters) answer["parameters"].push_back(parameter_json(e));
  answer["models"] = found.models;
  answer["limits"] = report::findings_json(found.limits);
  answer["in_maps"] = found.in_maps;
  answer["summary"] = report::findings_json(jobs::summary_of(found, jobs::n_threads(0)));
  answer["forecast"] = report::findings_json(found.forecast);
  const Recipe& model = found.evidence.rock.model;
  answer["grains"] = {{"number", model.packing.n_grains}, {"diameter [m]", grain_size(model)}};
  answer["course"] = course_json(found.as_read);
}

}  // namespace

Json check_answer(const std::string& name, const std::string& toml, const std::optional<std::string>& table) {
  Json answer = {{"bedded", nullptr}, {"figure", nullptr}, {"grains", nullptr}};
  // Every key in every answer: the page draws empty lists and needs no case for a table that is wrong.
  for (const char* list : {"problems", "doubts", "notes", "targets", "statements", "parameters", "models",
                           "limits", "in_maps", "summary", "forecast", "course"})
    answer[list] = Json::array();
  const std::string toml_file = name + ".toml", table_file = table_named_in(toml, name + ".csv");
  try {
    add_check(rock::parse_rock(toml, toml_file, {table, {}}), answer);
  } catch (const InputError& e) {
    // Read once more for the places of the cells, which the reader of rocks does not keep.
    const io::Table cells = io::parse_table(table.value_or(""), table_file);
    for (const Problem& p : e.problems())
      answer["problems"].push_back(problem_json(p, toml_file, table_file, cells));
  } catch (const IoError& e) {
    answer["problems"].push_back(
        {{"where", "rock"}, {"line", nullptr}, {"column", nullptr}, {"text", e.what()}});
  }
  return answer;
}

}  // namespace phy::gui
