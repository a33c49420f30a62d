// `phyllite report RESULT`: writes report.html anew: of a run, a study or a calibration.
#include <fmt/format.h>

#include <chrono>

#include "base/clock.hpp"
#include "cli/commands.hpp"
#include "cli/provenance.hpp"
#include "cli/terminal.hpp"
#include "io/output.hpp"
#include "jobs/report.hpp"
#include "jobs/run_folder.hpp"
#include "rock/file.hpp"

namespace phy::cli {
namespace {

struct ReportArguments {
  std::string result, rock, out;
};

/// The exit code.
int report(const ReportArguments& args) {
  auto [run, extras] = jobs::read_report(args.result);
  // Only values that are asked for: a run does not know which rock it stands for.
  if (!args.rock.empty()) extras.laboratory = targets_of(rock::read_rock(args.rock));
  const std::string out = args.out.empty() ? jobs::page_of(args.result) : args.out;
  io::check_ending(out, {".html", ".htm"});
  // A page that somebody edited by hand is not overwritten.
  io::check_outputs({out});
  const auto start = std::chrono::steady_clock::now();
  const std::string page = report::report_page(run, extras);
  io::write_output(out, page);
  const double seconds = seconds_since(start);
  print_out("{}: {}{:.1f} MB, written in {:.2f} s\n", out,
            // A study or an elastic calibration has a page without specimens.
            run.tests.empty()
                ? ""
                : fmt::format("{} specimen{}, ", run.tests.size(), run.tests.size() == 1 ? "" : "s"),
            1e-6 * static_cast<double>(page.size()), seconds);
  return tell_provenance(run, 0);
}

}  // namespace

void write_report(const std::string& folder) { report({folder, "", ""}); }

void add_report_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<ReportArguments>();
  CLI::App* verb = app.add_subcommand("report", "write report.html of a result anew");
  verb->add_option("result", args->result, "folder of a run (or one specimen of it), study or calibration")
      ->required()
      ->type_name("FOLDER");
  verb->add_option("--rock", args->rock, "rock file (TOML): its laboratory values beside the model")
      ->type_name("FILE");
  verb->add_option("--out", args->out, "file; default: report.html in the folder")->type_name("FILE");
  verb->callback([args, &session] { session.exit_code = report(*args); });
}

}  // namespace phy::cli
