// Calibrations and studies.
#include <pybind11/stl.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "base/clock.hpp"
#include "base/option.hpp"
#include "base/version.hpp"
#include "calibrate/discrepancy.hpp"
#include "io/load_variation.hpp"
#include "io/regressions.hpp"
#include "jobs/calibration_job.hpp"
#include "jobs/machine.hpp"
#include "jobs/report.hpp"
#include "jobs/study_folder.hpp"
#include "python/module.hpp"
#include "python/released.hpp"
#include "report/calibration_figures.hpp"
#include "report/calibration_files.hpp"
#include "report/figure_json.hpp"
#include "report/figures.hpp"
#include "study/store_queue.hpp"
#include "study/study_in.hpp"
#include "study/table.hpp"
#include "study/worker.hpp"

namespace phy::python {
namespace {

py::object value_of(const OptionValue& value) {
  // None is Python's word for "not asked for"; an empty text would be shown as a default to be typed.
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
  // Before the interpreter is released: a dict must not be read without it.
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
    // As the command: a page of half a calibration would be taken for a whole one.
    if (request.out.empty() || result.verdict.status == VerdictStatus::interrupted) return;
    jobs::write_report(request.out);
    job.finish();
  });
  return result;
}

void save(const Calibration& c, const std::string& folder) {
  // All files are looked at before the first is written: half of a calibration is none.
  jobs::check_calibration_outputs(folder);
  jobs::write_calibration(folder, c);
  jobs::write_report(folder);
}

/// What its figure shows (report/figure.hpp), as JSON. `json`: the text of calibration.json, `file`: its
/// name.
std::string calibration_figure(const std::string& json, const std::string& file) {
  // From the text, so that a calibration that was loaded is drawn in the same way.
  return report::figure_json(report::calibration_figure(report::comparisons_of(json, file))).dump();
}

/// rock/model of a strength, its relative standard deviation, and the factor of every draw; None: the table
/// has no such strength.
py::object missed(const std::string& json, const std::string& file, const std::string& name, double theta,
                  double confining) {
  const MeasuredProperty* property = find_property(name);
  // ValueError: what Python raises for a word that is none of its list.
  if (property == nullptr) throw py::value_error(name + ": no property of a table");
  const calibrate::Discrepancy discrepancy(report::comparisons_of(json, file).residuals);
  if (!discrepancy.knows(property->property)) return py::none();
  Target test;
  test.property = property->property, test.theta = theta, test.confining = confining;
  const calibrate::Discrepancy::Term term = discrepancy.at(test);
  std::vector<double> of_draws;
  for (std::size_t k = 0; k < discrepancy.n_draws(); ++k)
    of_draws.push_back(std::exp(discrepancy.of_draw(term, k)));
  py::dict row;
  // The discrepancy lives in logarithms, where factors of 2 and of 1/2 weigh alike.
  row["factor"] = std::exp(term.mean), row["sd"] = std::sqrt(term.variance), row["of_draws"] = of_draws;
  return row;
}

study::Study study_from(const py::dict& keys, const py::object& recipe) {
  const auto base = recipe.cast<Recipe>();
  // The reader of study files wants a name there; the recipe itself is handed over beside it.
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

using StudyTexts = std::map<std::string, std::string>;

/// By name: the tables as CSV, the text that the program prints, the hash. Empty where nothing has finished.
StudyTexts texts_of(const study::Plan& plan, const study::StudyRows& rows) {
  // Effects of nothing would be tables of headers alone.
  if (std::none_of(rows.begin(), rows.end(), [](const auto& row) { return row.has_value(); })) return {};
  const std::vector<study::Response> all = study::all_responses(plan, rows);
  return {{"table", study::study_csv(plan, rows)},
          {"responses", study::responses_csv(plan, all)},
          {"effects", study::effects_csv(plan, all)},
          {"text", study::effects_text(plan, rows)},
          {"hash", study::hash_of(rows)}};
}

StudyTexts run_study(const py::object& source, const py::dict& keys, const std::string& folder, int threads,
                     const py::object& progress) {
  const bool from_file = py::isinstance<py::str>(source);
  // A text is the name of a file, as in all of the package; keys come as a dict beside a Recipe.
  const std::string path = from_file ? source.cast<std::string>() : "";
  // Keys hold objects of Python and are read here; a file is read below, where it may be slow.
  study::Study wanted = from_file ? study::Study() : study_from(keys, source);
  StudyTexts answer;
  run_released(progress, [&](Watch& watch) {
    if (from_file) wanted = study::read_study(path);
    jobs::check_study_outputs(study::study_files(wanted), folder, {});
    jobs::refuse_other_study(wanted, folder), jobs::refuse_unmerged(folder);
    const study::Plan plan = study::make_plan(wanted);
    const study::StudyRows rows = finished_rows(wanted, plan, folder, threads, watch);
    answer = texts_of(plan, rows);
    if (answer.empty()) return;
    jobs::write_tables(plan, rows, folder);
    if (!plan.study.vary.empty()) jobs::write_report(folder);
  });
  return answer;
}

/// A study as far as it has run.
StudyTexts load_study(const std::string& folder) {
  const study::Plan plan = study::make_plan(jobs::study_in(folder));
  return texts_of(plan,
                  study::rows_of(plan, study::Store(jobs::store_file(folder, {}), study::Sharing::reading)));
}

/// What a figure of a study shows, as JSON.
std::string study_figure(const std::string& folder, const std::string& word) {
  const report::FigureKind& kind = report::figure_kind(word);
  if (!kind.varied)
    throw InputError(option_problem("kind", word, "a chart of a study: stiffness, modulus or strength", ""));
  report::FigureData data;
  data.variation = io::read_variation(folder);
  return report::figure_json(kind.make(data)).dump();
}

}  // namespace

void add_calibrations(py::module_& m) {
  py::class_<Calibration>(m, "CalibrationRecord")
      .def_readonly("recipe", &Calibration::recipe)
      .def_readonly("ensemble", &Calibration::ensemble)
      .def("text", [](const Calibration& c) { return jobs::screen_of(c, 0); })
      .def("json", [](const Calibration& c) { return report::calibration_json(c, phy::version); })
      .def("save", &save, py::arg("folder"));
  // Python makes its keyword arguments and their help of this list.
  m.def("calibration_options", &calibration_options);
  m.def("calibrate", &calibrate, py::arg("rock"), py::arg("options"), py::arg("threads"),
        py::arg("progress"));
  m.def("calibration_figure", &calibration_figure, py::arg("json"), py::arg("file"));
  m.def("missed", &missed, py::arg("json"), py::arg("file"), py::arg("property"), py::arg("theta"),
        py::arg("confining"));
  m.def("load_study", &load_study, py::arg("folder"));
  m.def("study_figure", &study_figure, py::arg("folder"), py::arg("kind"));
  m.def("study", &run_study, py::arg("source"), py::arg("keys"), py::arg("folder"), py::arg("threads"),
        py::arg("progress"));
}

}  // namespace phy::python
