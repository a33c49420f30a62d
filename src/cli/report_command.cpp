// `phyllite report RESULT`: writes report.html anew, with laboratory data beside the model if a rock is
// named.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "cli/commands.hpp"
#include "io/file.hpp"
#include "io/load.hpp"
#include "io/rock_in.hpp"
#include "report/page.hpp"

namespace phy {
namespace {

struct ReportArguments {
  std::string result, rock, out;
};

void report(const ReportArguments& args) {
  const RunRecord run = read_run(args.result);
  PageExtras extras;
  if (!args.rock.empty()) extras.laboratory = targets_of(read_rock(args.rock));
  const std::string out =
      args.out.empty() ? (std::filesystem::path(args.result) / "report.html").string() : args.out;
  const auto start = std::chrono::steady_clock::now();
  const std::string page = report_page(run, extras);
  write_file(out, page);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("{}: {} specimens, {:.1f} MB, written in {:.2f} s\n", out, run.tests.size(),
             1e-6 * static_cast<double>(page.size()), seconds);
  for (const MissingTest& m : run.missing) fmt::print("{}: missing: {}\n", m.name, m.reason);
}

}  // namespace

void add_report_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<ReportArguments>();
  CLI::App* verb = app.add_subcommand("report", "write report.html of a result anew");
  verb->add_option("result", args->result, "folder that `phyllite run` wrote, or one specimen of it")
      ->required();
  verb->add_option("--rock", args->rock, "rock file (TOML): its laboratory values beside the model");
  verb->add_option("--out", args->out, "file; default: report.html in the folder");
  verb->callback([args, &session] {
    session.exit_code = 0;
    report(*args);
  });
}

}  // namespace phy
