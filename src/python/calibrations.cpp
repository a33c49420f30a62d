// Calibrations and studies.
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "base/clock.hpp"
#include "base/version.hpp"
#include "calibrate/discrepancy.hpp"
#include "io/regressions.hpp"
#include "jobs/calibration_job.hpp"
#include "jobs/machine.hpp"
#include "jobs/report.hpp"
#include "jobs/study_folder.hpp"
#include "python/module.hpp"
#include "python/released.hpp"
#include "report/calibration_files.hpp"
#include "report/words.hpp"
#include "study/store_queue.hpp"
#include "study/study_in.hpp"
#include "study/table.hpp"
#include "study/worker.hpp"

namespace phy::python {
namespace {

py::object value_of(const OptionValue& value) {
  if (value == OptionValue(std::string())) return py::none();
  return std::visit([](const auto& v) -> py::object { return py::cast(v); }, value);
}

/// Name, default, what it may be and meaning of every argument.
py::list calibration_options() {
  py::list rows;
  for (const jobs::CalibrationOption& o : jobs::calibration_options()) {
    const Field field = o.field();
    rows.append(py::make_tuple(o.key, value_of(o.value(jobs::CalibrationRequest())), range_text(field),
                               field.meaning));
  }
  return rows;
}

Calibration calibrate(const NamedRock& rock, const py::dict& options, int threads,
                      const py::object& progress) {
  jobs::CalibrationRequest request = jobs::request_of(tree_of(options, ""), "");
  request.rock = rock.source;
  Calibration result;
  run_released(progress, [&](Watch& watch) {
    jobs::CalibrationJob job(rock.rock, request);
    jobs::CalibrationHooks hooks;
    hooks.threads = jobs::n_threads(threads), hooks.stop = &watch.stop;
    hooks.tests = [&](const calibrate::TestProgress& p, const std::string& text) {
      watch.show({text, p.n_done, p.n_total});
    };
    hooks.say = [&](const std::string& text) { watch.say(text); };
    result = job.run(hooks);
    if (request.out.empty() || result.verdict.status == VerdictStatus::interrupted) return;
    jobs::write_report(request.out);
    job.finish();
  });
  return result;
}

void save(const Calibration& c, const std::string& folder) {
  jobs::check_calibration_outputs(folder);
  jobs::write_calibration(folder, c);
  jobs::write_report(folder);
}

py::dict row_of_estimate(const ParameterEstimate& p) {
  py::dict row;
  row["key"] = p.key, row["symbol"] = p.symbol, row["value"] = p.value, row["low"] = p.low,
  row["high"] = p.high;
  row["unit"] = p.unit, row["determined"] = p.determined;
  row["rests_on"] = text_of(p.rests_on), row["next_test"] = text_of(p.next);
  return row;
}

py::list rows_of(const std::vector<Finding>& findings) {
  py::list rows;
  for (const Finding& f : findings) {
    py::dict row, numbers;
    py::list cells;
    for (const Cell& c : f.cells) {
      py::dict cell;
      cell["property"] = to_string(c.property), cell["theta"] = c.theta;
      cell["confining"] = c.confining, cell["diameter"] = c.diameter;
      cells.append(cell);
    }
    for (const NamedNumber& q : f.numbers) numbers[py::str(std::string(q.name))] = q.value;
    row["kind"] = to_string(f.kind), row["cells"] = cells, row["numbers"] = numbers;
    row["names"] = f.names, row["advice"] = to_string(f.advice), row["text"] = report::sentence(f);
    rows.append(row);
  }
  return rows;
}

py::list rows_of(const std::vector<Comparison>& table) {
  py::list rows;
  for (const Comparison& c : table) {
    py::dict row;
    row["property"] = to_string(c.target.property), row["theta"] = c.target.theta;
    row["confining"] = c.target.confining, row["diameter"] = c.target.diameter;
    row["laboratory"] = c.target.mean, row["laboratory_sd"] = c.target.sd, row["n"] = c.target.n;
    row["model"] = c.mean, row["model_sd"] = c.sd, row["n_packings"] = c.n_packings, row["error"] = c.error();
    row["with_discrepancy"] = c.with_discrepancy;
    row["low"] = c.low, row["high"] = c.high, row["missing"] = c.missing;
    row["bedding_share"] = c.failure.bedding_share, row["bedding_share_sd"] = c.failure.bedding_share_sd;
    row["failure_angle"] = c.failure.angle, row["failure_angle_sd"] = c.failure.angle_sd;
    rows.append(row);
  }
  return rows;
}

/// rock/model of a strength, its relative standard deviation, and the factor of every draw; None: the table
/// has no such strength.
py::object missed(const Calibration& c, const std::string& name, double theta, double confining) {
  const MeasuredProperty* property = find_property(name);
  if (property == nullptr) throw py::value_error(name + ": no property of a table");
  const calibrate::Discrepancy discrepancy(c.residuals);
  if (!discrepancy.knows(property->property)) return py::none();
  Target test;
  test.property = property->property, test.theta = theta, test.confining = confining;
  const calibrate::Discrepancy::Term term = discrepancy.at(test);
  std::vector<double> of_draws;
  for (std::size_t k = 0; k < discrepancy.n_draws(); ++k)
    of_draws.push_back(std::exp(discrepancy.of_draw(term, k)));
  py::dict row;
  row["factor"] = std::exp(term.mean), row["sd"] = std::sqrt(term.variance), row["of_draws"] = of_draws;
  return row;
}

study::Study study_from(const py::dict& keys, const py::object& recipe) {
  const auto base = recipe.cast<Recipe>();
  keys["recipe"] = base.name;
  return study::study_of(tree_of(keys, "study"), "study", base);
}

/// Runs what the folder has not yet.
study::StudyRows finished_rows(const study::Study& wanted, const study::Plan& plan, const std::string& folder,
                               int threads, Watch& watch) {
  const auto store = jobs::begin_study(study::study_files(wanted), folder, {});
  const auto start = std::chrono::steady_clock::now();
  study::Hooks hooks;
  hooks.stop = &watch.stop;
  hooks.on_progress = [&](const study::Progress& p) {
    watch.show({jobs::progress_text(p, seconds_since(start)), p.n_done, p.n_total});
  };
  hooks.on_result = [&](std::size_t, const TestResult& r) {
    if (!has_answer(r.outcome.status)) watch.say(r.name + ": " + r.outcome.reason);
  };
  const study::MachineOptions machine = jobs::machine_of(threads);
  {
    study::StoreQueue queue(plan, *store, hooks, machine.threads);  // its end writes the last rows
    study::work_at(queue, plan, machine);
  }
  return study::rows_of(plan, *store);
}

/// By name: the tables as CSV, the text that the program prints, the hash. Empty where nothing has finished.
std::map<std::string, std::string> run_study(const py::object& source, const py::dict& keys,
                                             const std::string& folder, int threads,
                                             const py::object& progress) {
  const bool from_file = py::isinstance<py::str>(source);
  const std::string path = from_file ? source.cast<std::string>() : "";
  study::Study wanted = from_file ? study::Study() : study_from(keys, source);
  std::map<std::string, std::string> answer;
  run_released(progress, [&](Watch& watch) {
    if (from_file) wanted = study::read_study(path);
    jobs::check_study_outputs(study::study_files(wanted), folder, {});
    jobs::refuse_other_study(wanted, folder), jobs::refuse_unmerged(folder);
    const study::Plan plan = study::make_plan(wanted);
    const study::StudyRows rows = finished_rows(wanted, plan, folder, threads, watch);
    if (std::none_of(rows.begin(), rows.end(), [](const auto& row) { return row.has_value(); })) return;
    jobs::write_tables(plan, rows, folder);
    if (!plan.study.vary.empty()) jobs::write_report(folder);
    const std::vector<study::Response> all = study::all_responses(plan, rows);
    answer = {{"table", study::study_csv(plan, rows)},
              {"responses", study::responses_csv(plan, all)},
              {"effects", study::effects_csv(plan, all)},
              {"text", study::effects_text(plan, rows)},
              {"hash", study::hash_of(rows)}};
  });
  return answer;
}

}  // namespace

void add_calibrations(py::module_& m) {
  py::class_<Calibration>(m, "CalibrationRecord")
      .def_property_readonly("name", [](const Calibration& c) { return c.rock; })
      .def_readonly("recipe", &Calibration::recipe)
      .def_readonly("ensemble", &Calibration::ensemble)
      .def_property_readonly("notes", [](const Calibration& c) { return rows_of(c.notes); })
      .def_property_readonly("status", [](const Calibration& c) { return to_string(c.verdict.status); })
      .def_property_readonly("sentence", [](const Calibration& c) { return report::verdict_words(c); })
      .def_property_readonly("findings", [](const Calibration& c) { return rows_of(c.verdict.findings); })
      .def_property_readonly("causes", [](const Calibration& c) { return rows_of(c.verdict.causes); })
      .def_property_readonly("lines", [](const Calibration& c) { return report::verdict_lines(c); })
      .def_property_readonly("good_for", [](const Calibration& c) { return rows_of(c.verdict.good_for); })
      .def_property_readonly("not_good_for",
                             [](const Calibration& c) { return rows_of(c.verdict.not_good_for); })
      .def_property_readonly("next", [](const Calibration& c) { return report::next_words(c); })
      .def_property_readonly("parameters",
                             [](const Calibration& c) {
                               py::list rows;
                               for (const ParameterEstimate& p : c.parameters)
                                 rows.append(row_of_estimate(p));
                               return rows;
                             })
      .def_property_readonly("fitted", [](const Calibration& c) { return rows_of(c.fitted); })
      .def_property_readonly("verification", [](const Calibration& c) { return rows_of(c.verification); })
      .def_property_readonly("left_out", [](const Calibration& c) { return rows_of(c.left_out); })
      .def_property_readonly("compared", [](const Calibration& c) { return rows_of(c.compared); })
      .def("missed", &missed, py::arg("property"), py::arg("theta"), py::arg("confining"))
      .def("text", [](const Calibration& c) { return jobs::screen_of(c, 0); })
      .def("json", [](const Calibration& c) { return report::calibration_json(c, phy::version); })
      .def("save", &save, py::arg("folder"));
  m.def("calibration_options", &calibration_options);
  m.def("calibrate", &calibrate, py::arg("rock"), py::arg("options"), py::arg("threads"),
        py::arg("progress"));
  m.def("study", &run_study, py::arg("source"), py::arg("keys"), py::arg("folder"), py::arg("threads"),
        py::arg("progress"));
}

}  // namespace phy::python
