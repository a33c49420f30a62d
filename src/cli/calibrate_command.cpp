// `phyllite calibrate ROCK`: laboratory data in, a verified set of micro-parameters out.
#include <fmt/format.h>

#include <type_traits>

#include "base/quote.hpp"
#include "cli/machine.hpp"
#include "cli/progress.hpp"
#include "cli/study_words.hpp"
#include "cli/terminal.hpp"
#include "jobs/calibration_job.hpp"
#include "jobs/calibration_reference.hpp"
#include "report/calibration_summary.hpp"
#include "report/calibration_tables.hpp"
#include "report/words.hpp"
#include "rock/file.hpp"
#include "survey/doubts.hpp"

namespace phy::cli {
namespace {

/// How to go on with what was stopped.
std::string resume_command(jobs::CalibrationRequest args) {
  // The rest of the request stays: --resume refuses a folder whose options differ from what is asked now.
  args.resume = true;
  return command_of(jobs::command_line_of(args));
}

/// What is known before anything runs.
void print_table(const Evidence& evidence, const std::string& file, int width) {
  // Doubts stand above the table: a typing error found now saves the hours of a calibration to a wrong value.
  const std::vector<Finding> doubts = survey::doubts_about(evidence);
  for (const std::string& doubt : report::sentences(doubts)) print_wrapped(width, 2, "{}\n", doubt);
  if (!doubts.empty()) print_out("\n");
  print_wrapped(width, 10, "rock      {} ({})\n", evidence.rock.name, file);
  print_notes(evidence.rock.notes, width);
  print_out("\n{}\n", report::target_table(evidence.targets, evidence.rock.bedded, width));
  // The first packing takes minutes; meanwhile a pipe should show how the table was read.
  flush_out();
}

void print_result(const Calibration& result, const study::WorkReport& work, int width) {
  const std::string lanes = lanes_text(work.lanes);
  print_out("{}", jobs::screen_of(result, width));
  print_wrapped(width, 2, "{:.1f} s in all{}\n", result.seconds,
                lanes.empty() ? "" : fmt::format("; tests {:.1f} s CPU, {}", work.cpu_seconds, lanes));
}

int run_calibration(const jobs::CalibrationRequest& args, const Session& session) {
  // The job checks options and folder when it is made, so nothing is printed of a request that is refused.
  jobs::CalibrationJob job(rock::read_rock(args.rock), args);
  const int width = session.terminal_width;
  print_table(job.evidence(), args.rock, width);
  // No error: a script may give --resume always. But somebody who mistyped --out should see why it starts
  // afresh.
  if (args.resume && !job.resumes())
    print_wrapped(width, 2, "{} holds no test of an earlier run: the calibration begins afresh.\n", args.out);
  ProgressLine line;
  study::WorkReport work;
  jobs::CalibrationHooks hooks;
  hooks.threads = n_threads(session), hooks.stop = stop_on_interrupt();
  hooks.say = [&](const std::string& text) { line.stage(text); };
  hooks.tests = [&](const calibrate::TestProgress&, const std::string& text) {
    line.show([&](double) { return text; });
  };
  // Tests run in batches, one report each: the last line tells of all of them.
  hooks.work = [&](const study::WorkReport& some) {
    work.cpu_seconds += some.cpu_seconds, work.lanes.add(some.lanes);
  };
  const Calibration result = job.run(hooks);  // writes its files: the output may be full
  line.finish();
  print_result(result, work, width);
  if (result.verdict.status == VerdictStatus::interrupted) {
    print_wrapped(width, 2, "to go on: {}\n", resume_command(args));
    return 1;
  }
  // Only a whole calibration gets a page. Of an interrupted one the page would show half a fit as a result.
  write_report(args.out);
  print_wrapped(width, 2, "calibrated.toml, {}PFC and Yade files, calibration.json and every run in {}\n",
                result.ensemble.empty() ? "" : fmt::format("{} draws in ensemble, ", result.ensemble.size()),
                args.out);
  print_out("\n{}", report::sentence_text(result, width));  // where a long output ends
  flush_out();
  // Last, because it throws when a specimen could not be written: by then the user has seen the verdict.
  job.finish();
  // A calibration with doubts has still an answer. Only one without a usable model counts as failed for
  // scripts.
  return misses_table(result.verdict.status) ? 1 : 0;
}

void add_option(CLI::App& verb, const jobs::CalibrationOption& option, jobs::CalibrationRequest& args) {
  const auto add = [&](auto place) {
    auto& value = args.*place;
    const std::string name = "--" + option.word();
    using Value = std::remove_reference_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, bool>) {
      verb.add_flag(name, value, option.meaning);
    } else {
      CLI::Option* added = verb.add_option(name, value, option.meaning)->capture_default_str();
      // From 1: a budget without a test can fit nothing.
      if constexpr (!std::is_same_v<Value, std::string>)
        added->check(CLI::Range(Value{1}, Value{option.most}));
      else if (option.words.empty())
        added->type_name("FOLDER");
      else
        added->check(CLI::IsMember(option.words));
    }
  };
  std::visit(add, option.place);
}

}  // namespace

void add_calibrate_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<jobs::CalibrationRequest>();
  CLI::App* verb = app.add_subcommand(
      "calibrate", "calibrate a model from a laboratory table: parameters with intervals, and a verdict");
  verb->add_option("rock", args->rock, "rock file (TOML)")->required()->type_name("FILE");
  for (const jobs::CalibrationOption& option : jobs::calibration_options()) add_option(*verb, option, *args);
  add_reference(*verb, jobs::calibration_reference,
                "print the tables of parameters, models, efforts, packings and keys");
  verb->callback([args, &session] { session.exit_code = run_calibration(*args, session); });
}

}  // namespace phy::cli
