// `phyllite calibrate ROCK`: laboratory data in, a verified set of micro-parameters out.
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>

#include "calibrate/calibration.hpp"
#include "cli/commands.hpp"
#include "cli/progress.hpp"
#include "io/rock_in.hpp"
#include "report/calibration_tables.hpp"

namespace phy {
namespace {

std::atomic<bool> stop_requested{false};
void on_interrupt(int) {
  stop_requested = true;
  std::signal(SIGINT, SIG_DFL);  // a second Ctrl-C ends at once; finished tests are in the store
}

struct Arguments {
  std::string rock, out = "results/calibration";
  bool elastic = false;
};

int run_calibration(const Arguments& args, const Session& session) {
  const Rock rock = read_rock(args.rock);
  fmt::print("rock      {} ({})\n", rock.name, args.rock);
  for (const std::string& note : rock.notes) fmt::print("          {}\n", note);
  fmt::print("\n{}\n", target_table(targets_of(rock)));
  std::fflush(stdout);
  ProgressLine line(isatty(STDERR_FILENO) != 0, session.terminal_width);
  SimulatorOptions machine;
  machine.threads = session.threads > 0 ? session.threads : available_cores();
  machine.stop = &stop_requested;
  CalibrationOptions options;
  options.elastic_only = args.elastic;
  options.say = [&](const std::string& text) { line.note(text); };
  const auto simulator = make_simulator(machine);
  const Calibration result = calibrate(rock, options, *simulator);
  line.finish();
  fmt::print("{}\n{}\n{}\n", parameter_tables(result), macro_table(result), verdict_text(result));
  fmt::print("{} tests of strength, {} direct elastic solutions, {:.1f} s\n", result.n_strength_tests,
             result.n_elastic, result.seconds);
  const VerdictStatus status = result.verdict.status;
  return status == VerdictStatus::out_of_reach || status == VerdictStatus::interrupted ? 1 : 0;
}

}  // namespace

void add_calibrate_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<Arguments>();
  CLI::App* verb = app.add_subcommand("calibrate", "micro-parameters from a laboratory table");
  verb->add_option("rock", args->rock, "rock file (TOML)")->required();
  verb->add_option("--out", args->out, "folder for the results")->capture_default_str();
  verb->add_flag("--elastic", args->elastic, "elastic stage only");
  verb->callback([args, &session] {
    std::signal(SIGINT, on_interrupt);
    session.exit_code = run_calibration(*args, session);
  });
}

}  // namespace phy
