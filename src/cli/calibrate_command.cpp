// `phyllite calibrate ROCK`: laboratory data in, a verified set of micro-parameters out.
#include <fmt/format.h>

#include "base/quote.hpp"
#include "cli/machine.hpp"
#include "cli/progress.hpp"
#include "cli/study_words.hpp"
#include "cli/terminal.hpp"
#include "jobs/calibration_folder.hpp"
#include "jobs/calibration_watch.hpp"
#include "report/calibration_summary.hpp"
#include "report/calibration_tables.hpp"
#include "report/words.hpp"
#include "rock/file.hpp"
#include "survey/doubts.hpp"

namespace phy::cli {
namespace {

/// How to go on with what was stopped.
std::string resume_command(jobs::CalibrationRequest args) {
  args.resume = true;
  std::string command = "phyllite";
  for (const std::string& word : jobs::words_of(args)) command += " " + sh_word(word);
  return command;
}

int run_calibration(const jobs::CalibrationRequest& args, const Session& session) {
  const calibrate::Evidence evidence(jobs::with_matrix(rock::read_rock(args.rock), args));
  const Rock& rock = evidence.rock;
  const int width = session.terminal_width;
  calibrate::SimulatorOptions machine;
  machine.threads = n_threads(session);
  machine.stop = stop_on_interrupt();
  machine.with_untrusted = args.with_untrusted;
  calibrate::CalibrationOptions options = jobs::options_of(args);
  calibrate::check_possible(evidence, options);
  const jobs::BegunCalibration begun = jobs::begin_calibration(evidence, args);
  machine.store = begun.store;
  jobs::SpecimenFolder specimens(args.out);
  machine.gallery = &specimens;
  const std::vector<Finding> doubts = survey::doubts_about(evidence);
  for (const std::string& doubt : report::sentences(doubts)) print_wrapped(width, 2, "{}\n", doubt);
  if (!doubts.empty()) print_out("\n");
  print_wrapped(width, 10, "rock      {} ({})\n", rock.name, args.rock);
  print_notes(rock.notes, width);
  print_out("\n{}\n", report::target_table(evidence.targets, width));
  flush_out();
  ProgressLine line;
  jobs::CalibrationWatch watch(args.out);
  machine.on_progress = [&](const calibrate::TestProgress& p) {
    line.show([&](double) { return jobs::progress_text(p); });
    watch.tests(p);
  };
  machine.on_reading = [&](const Recipe& r, double strain, double stress) {
    watch.reading(r, strain, stress);
  };
  study::WorkReport work;
  machine.on_work = [&](const study::WorkReport& some) {
    work.cpu_seconds += some.cpu_seconds, work.lanes.add(some.lanes);
  };
  options.listener.say = [&](const std::string& text) { line.stage(text), watch.say(text); };
  options.listener.estimates = [&](const std::vector<ParameterEstimate>& known) { watch.estimates(known); };
  const auto simulator = calibrate::make_simulator(machine);
  const Calibration result = calibrate::calibrate(evidence, options, *simulator);
  line.finish();
  const bool interrupted = result.verdict.status == VerdictStatus::interrupted;
  if (!interrupted) jobs::write_calibration(args.out, result);  // first: the output may be full
  const std::string lanes = lanes_text(work.lanes);
  print_out("{}", jobs::screen_of(result, width));
  print_wrapped(width, 2, "{:.1f} s in all{}\n", result.seconds,
                lanes.empty() ? "" : fmt::format("; tests {:.1f} s CPU, {}", work.cpu_seconds, lanes));
  if (interrupted) {
    watch.end("stopped");
    print_wrapped(width, 2, "to go on: {}\n", resume_command(args));
    return 1;
  }
  write_report(args.out);
  watch.end("finished");
  print_wrapped(width, 2, "calibrated.toml, {}PFC and Yade files, calibration.json and every run in {}\n",
                result.ensemble.empty() ? "" : fmt::format("{} draws in ensemble, ", result.ensemble.size()),
                args.out);
  print_out("\n{}", report::sentence_text(result, width));  // where a long output ends
  flush_out();
  specimens.check();
  return result.verdict.status == VerdictStatus::out_of_reach ? 1 : 0;
}

}  // namespace

void add_calibrate_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<jobs::CalibrationRequest>();
  args->out = "results/calibration";
  CLI::App* verb = app.add_subcommand("calibrate", "micro-parameters from a laboratory table");
  verb->add_option("rock", args->rock, "rock file (TOML)")->required()->type_name("FILE");
  verb->add_option("--out", args->out, "folder for the results")->capture_default_str()->type_name("FOLDER");
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
  std::vector<std::string> efforts;
  for (const calibrate::Effort& e : calibrate::efforts) efforts.emplace_back(e.name);
  verb->add_option("--effort", args->effort,
                   "how many tests the search of strengths takes: quick half of the usual, thorough twice as "
                   "many (docs/calibration.md, Effort)")
      ->check(CLI::IsMember(efforts))
      ->capture_default_str();
  verb->add_flag("--with-untrusted", args->with_untrusted,
                 "count tests that have a strength but are not to be trusted (docs/reliability.md)");
  verb->add_option("--max-tests", args->max_tests, "budget: tests in compression, verification included")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  verb->callback([args, &session] { session.exit_code = run_calibration(*args, session); });
}

}  // namespace phy::cli
