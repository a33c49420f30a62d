// `phyllite calibrate ROCK`: laboratory data in, a verified set of micro-parameters out.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "base/hash.hpp"
#include "base/quote.hpp"
#include "calibrate/calibration.hpp"
#include "calibrate/posterior_ensemble.hpp"
#include "cli/ensemble.hpp"
#include "cli/machine.hpp"
#include "cli/other_results.hpp"
#include "cli/press.hpp"
#include "cli/progress.hpp"
#include "cli/study_words.hpp"
#include "cli/terminal.hpp"
#include "genesis/settle.hpp"
#include "genesis/specimen.hpp"
#include "io/file.hpp"
#include "io/load.hpp"
#include "io/output.hpp"
#include "io/rock_in.hpp"
#include "io/store.hpp"
#include "io/toml_in.hpp"
#include "records/recipe_schema.hpp"
#include "report/calibration_files.hpp"
#include "report/calibration_summary.hpp"
#include "report/calibration_tables.hpp"
#include "report/methods.hpp"
#include "report/pfc_commands.hpp"
#include "study/experiment.hpp"
#include "study/store.hpp"

namespace phy::cli {
namespace {

struct Arguments {
  std::string rock, out = "results/calibration", method = "posterior", matrix;
  bool elastic = false, resume = false, with_untrusted = false;
  std::int64_t max_tests = 1000;
  bool by_sequence() const { return method == "sequence"; }
};

/// Everything that the answer follows from.
std::string fingerprint(const calibrate::Evidence& evidence, const Arguments& args) {
  const Rock& rock = evidence.rock;
  Hash hash;
  hash.add(rock.name);
  hash.add(keys_not_by_default(rock.model));
  hash.add(rock.bedded), hash.add(static_cast<int>(rock.E_is)), hash.add(static_cast<int>(rock.layers));
  hash.add(rock.matrix ? static_cast<int>(*rock.matrix) : -1);
  hash.add(args.elastic), hash.add(args.max_tests);
  if (args.with_untrusted) hash.add(true);
  if (args.by_sequence()) hash.add(args.method);
  for (const Target& t : evidence.targets) {
    hash.add(static_cast<int>(t.property)), hash.add(t.n), hash.add(t.sd_assumed);
    hash.add(t.theta), hash.add(t.mean), hash.add(t.sd), hash.add(t.diameter);
    if (t.confining > 0.0) hash.add(t.confining);
  }
  return hash.text();
}

/// What a folder holds, in words; the fingerprint of the rock stands in the last line.
std::string label(const calibrate::Evidence& evidence, const Arguments& args) {
  return fmt::format("calibration of \"{}\" ({}){}{}{}{}, --max-tests {}\n{}\n", evidence.rock.name,
                     comment_text(args.rock), args.matrix.empty() ? "" : ", --matrix " + args.matrix,
                     args.by_sequence() ? ", --method sequence" : "", args.elastic ? ", --elastic" : "",
                     args.with_untrusted ? ", --with-untrusted" : "", args.max_tests,
                     fingerprint(evidence, args));
}

/// Throws InputError where --resume would write one calibration over another.
void check_same(const std::string& file, const std::string& expected, const Arguments& args) {
  const std::string found = std::filesystem::exists(file) ? io::read_file(file) : "";
  const auto key = [](const std::string& text) {  // the rock file may have moved
    const std::size_t end = text.find('\n');
    return end == text.npos ? "" : text.substr(end + 1);
  };
  if (!found.empty() && key(found) == key(expected)) return;
  const std::string holds = found.empty() ? "a calibration of an earlier version of this program"
                                          : found.substr(0, found.find('\n'));
  throw InputError(
      Problem{"command line", "--out", args.out, "a folder of this same calibration for --resume",
              "it holds: " + holds + "; its table, recipe or options differ: another --out begins afresh"});
}

/// All that is written beside the store.
std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const char* name : {"calibration-of.txt", "calibrated.toml", "calibrated.p2dat", "calibrated-yade.py",
                           "calibration.json", "tables.txt", "report.html"})
    files.push_back((std::filesystem::path(folder) / name).string());
  for (std::size_t k = 0; k < calibrate::ensemble_size; ++k) files.push_back(ensemble_file(folder, k));
  return files;
}

/// Folder of the calibrated rock as it broke (docs/formats.md, "Calibration").
std::string specimens_in(const std::string& folder) {
  return (std::filesystem::path(folder) / "specimens").string();
}

bool holds_results(const std::string& folder) {
  return std::filesystem::is_directory(folder) && !io::result_folders(folder).empty();
}

/// The store beside the results. An earlier one is used only when asked for: a calibration begins afresh.
std::string store_in(const Arguments& args, const std::string& label) {
  namespace fs = std::filesystem;
  const fs::path folder(args.out);
  std::string store = (folder / "runs.sqlite").string();
  const std::string label_file = (folder / "calibration-of.txt").string();
  io::check_outputs(files_in(args.out));
  io::check_writable(args.out);
  const bool begun =
      fs::exists(folder / "calibration.json") || (fs::exists(store) && study::Store(store).size() > 0);
  if (begun && !args.resume)
    throw InputError(Problem{"command line", "--out", args.out, "a folder without an earlier calibration",
                             "--resume goes on with it; another --out begins afresh"});
  if (begun) check_same(label_file, label, args);
  if (const std::string others = specimens_in(args.out); !begun && holds_results(others))
    throw InputError(Problem{"command line", "--out", args.out, "a folder without " + others,
                             "results of before lie there: move them, or use another --out"});
  io::write_output(label_file, label);
  return store;
}

std::string progress_text(const calibrate::TestProgress& p) {
  const std::string left = p.seconds_left > 90.0  ? fmt::format("{:.0f} min", p.seconds_left / 60.0)
                           : p.seconds_left > 0.0 ? fmt::format("{:.0f} s", p.seconds_left)
                                                  : "not yet known";
  return fmt::format("{}/{} tests of this batch, time left for the calibration: {}", p.n_done, p.n_total,
                     left);
}

/// What a screen shows: the verdict first, parameters before comparisons.
std::string screen_of(const Calibration& c, int width) {
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}", report::sentence_text(c, width),
                     report::parameter_tables(c, width), report::angle_table(c, width),
                     report::error_table(c, width), report::summary_text(c, width),
                     report::budget_text(c, width));
}

/// The same with every detail.
std::string tables_of(const Calibration& c) {
  return fmt::format("{}\nDetails\n{}\n{}\nMethods\n{}\n\n{}", screen_of(c, 0), report::macro_table(c, 0),
                     report::verdict_text(c, 0), fmt::join(report::methods_text(c, PHY_VERSION), "\n"),
                     report::sentence_text(c, 0));
}

void write_files(const std::string& folder, const Calibration& c, const std::string& tables) {
  const std::filesystem::path out(folder);
  io::write_output((out / "calibrated.toml").string(),
                   report::recipe_comments(c) + io::write_recipe(c.recipe));
  for (std::size_t k = 0; k < c.ensemble.size(); ++k)
    io::write_output(ensemble_file(folder, k),
                     report::draw_comments(c, k + 1) + io::write_recipe(c.ensemble[k]));
  io::write_output((out / "calibrated.p2dat").string(), report::pfc_commands(c.recipe));
  io::write_output((out / "calibrated-yade.py").string(), report::yade_script(c.recipe));
  io::write_output((out / "calibration.json").string(), report::calibration_json(c, PHY_VERSION));
  io::write_output((out / "tables.txt").string(), tables);
}

/// Whether the folder holds these very tests, all of them.
bool is_pressed(const std::string& folder, const Recipe& recipe) {
  for (const std::string& name : specimen_names(recipe))
    if (!std::filesystem::exists(std::filesystem::path(folder) / io::folder_name(name) / "result.json"))
      return false;
  return results_of_others(folder, recipe).empty();
}

/// Presses the calibrated rock once, for pictures and curves: the verification keeps numbers alone. How many
/// tests are missing: stopped by the user.
std::size_t press_calibrated(const Calibration& c, const Arguments& args, const Session& session) {
  const auto is_ucs = [](const Comparison& row) {
    return row.target.property == Property::ucs && row.answered();
  };
  if (std::none_of(c.verification.begin(), c.verification.end(), is_ucs)) return 0;
  const Recipe recipe = calibrate::on_unseen_packing(c);
  const std::string folder = specimens_in(args.out);
  if (is_pressed(folder, recipe)) return 0;
  for (const auto& [other, difference] : results_of_others(folder, recipe)) {  // of another version
    io::check_result_place(other);
    io::remove_folder(other);
  }
  std::vector<std::shared_ptr<const Specimen>> specimens;
  try {
    const auto packing = study::packing_of(recipe, [stop = stop_on_interrupt()] { return stop->load(); });
    for (Specimen& s : genesis::make_specimens(packing, recipe))
      specimens.push_back(std::make_shared<const Specimen>(std::move(s)));
  } catch (const genesis::Interrupted&) {
    return specimen_names(recipe).size();
  }
  print_wrapped(session.terminal_width, 2, "the calibrated rock on a packing that the fit has not seen:\n");
  flush_out();
  const std::vector<TestResult> results = press(recipe, specimens, folder, machine_of(session));
  return static_cast<std::size_t>(std::count_if(results.begin(), results.end(), [](const TestResult& r) {
    return r.outcome.status == Status::interrupted;
  }));
}

/// How to go on with what was stopped.
std::string resume_command(const Arguments& args) {
  return fmt::format("phyllite calibrate {} --out {} --max-tests {}{}{}{}{} --resume", sh_word(args.rock),
                     sh_word(args.out), args.max_tests, args.matrix.empty() ? "" : " --matrix " + args.matrix,
                     args.by_sequence() ? " --method sequence" : "", args.elastic ? " --elastic" : "",
                     args.with_untrusted ? " --with-untrusted" : "");
}

/// The rock of the file, with the matrix that the command line asks for.
Rock rock_of(const Arguments& args) {
  Rock rock = io::read_rock(args.rock);
  if (args.matrix.empty()) return rock;
  rock.matrix.reset();
  if (args.matrix != "choose")
    rock.matrix = args.matrix == "flat_joint" ? MatrixModel::flat_joint : MatrixModel::parallel_bond;
  if (rock.matrix == MatrixModel::flat_joint && rock.bedded && is_directed(rock.layers))
    throw InputError(
        Problem{"command line", "--matrix", args.matrix, "parallel_bond or choose",
                "the layers of this rock are directions of bonds, which flat joints do not have"});
  return rock;
}

int run_calibration(const Arguments& args, const Session& session) {
  const calibrate::Evidence evidence(rock_of(args));
  const Rock& rock = evidence.rock;
  const int width = session.terminal_width;
  calibrate::SimulatorOptions machine;
  machine.threads = n_threads(session);
  machine.stop = stop_on_interrupt();
  machine.with_untrusted = args.with_untrusted;
  machine.store = store_in(args, label(evidence, args));
  print_wrapped(width, 10, "rock      {} ({})\n", rock.name, args.rock);
  print_notes(rock.notes, width);
  print_out("\n{}\n", report::target_table(evidence.targets, width));
  flush_out();
  ProgressLine line;
  machine.on_progress = [&](const calibrate::TestProgress& p) {
    line.show([&](double) { return progress_text(p); });
  };
  study::WorkReport work;
  machine.on_work = [&](const study::WorkReport& some) {
    work.cpu_seconds += some.cpu_seconds, work.lanes.add(some.lanes);
  };
  calibrate::CalibrationOptions options;
  if (args.by_sequence()) options.method = CalibrationMethod::sequence;
  options.elastic_only = args.elastic, options.max_tests = args.max_tests;
  options.say = [&](const std::string& text) { line.note(text); };
  const auto simulator = calibrate::make_simulator(machine);
  const Calibration result = calibrate::calibrate(evidence, options, *simulator);
  line.finish();
  const bool interrupted = result.verdict.status == VerdictStatus::interrupted;
  std::size_t n_missing = 0;
  if (!interrupted) {
    write_files(args.out, result, tables_of(result));  // first: the output may be full
    n_missing = press_calibrated(result, args, session);
  }
  const std::string lanes = lanes_text(work.lanes);
  print_out("{}{:.1f} s in all{}\n", screen_of(result, width), result.seconds,
            lanes.empty() ? "" : fmt::format("; tests {:.1f} s CPU, {}", work.cpu_seconds, lanes));
  if (interrupted) {
    print_wrapped(width, 2, "to go on: {}\n", resume_command(args));
    return 1;
  }
  write_report(args.out);
  print_wrapped(width, 2, "calibrated.toml, {}PFC and Yade files, calibration.json and every run in {}\n",
                result.ensemble.empty() ? "" : fmt::format("{} draws in ensemble, ", result.ensemble.size()),
                args.out);
  if (n_missing > 0)
    print_wrapped(width, 2, "stopped: {} specimens were not pressed for the report; to go on: {}\n",
                  n_missing, resume_command(args));
  print_out("\n{}", report::sentence_text(result, width));  // where a long output ends
  if (n_missing > 0) return 1;
  return result.verdict.status == VerdictStatus::out_of_reach ? 1 : 0;
}

}  // namespace

void add_calibrate_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<Arguments>();
  CLI::App* verb = app.add_subcommand("calibrate", "micro-parameters from a laboratory table");
  verb->add_option("rock", args->rock, "rock file (TOML)")->required();
  verb->add_option("--out", args->out, "folder for the results")->capture_default_str();
  verb->add_flag("--resume", args->resume, "go on with an interrupted calibration in the same folder");
  verb->add_flag("--elastic", args->elastic, "elastic stage only");
  verb->add_option("--method", args->method,
                   "posterior, or sequence: the paper's way, one parameter after the other")
      ->check(CLI::IsMember({"posterior", "sequence"}))
      ->capture_default_str();
  verb->add_option("--matrix", args->matrix,
                   "what holds the grains together, whatever the rock file says: parallel_bond, flat_joint, "
                   "or choose")
      ->check(CLI::IsMember({"choose", "parallel_bond", "flat_joint"}));
  verb->add_flag("--with-untrusted", args->with_untrusted,
                 "count tests that have a strength but are not to be trusted (docs/reliability.md)");
  verb->add_option("--max-tests", args->max_tests, "budget: tests in compression, verification included")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  verb->callback([args, &session] {
    stop_on_interrupt();
    session.exit_code = run_calibration(*args, session);
  });
}

}  // namespace phy::cli
