// `phyllite report RESULT`: writes report.html anew: of a run, a study or a calibration.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>

#include "base/check.hpp"
#include "base/clock.hpp"
#include "cli/commands.hpp"
#include "cli/provenance.hpp"
#include "cli/terminal.hpp"
#include "io/file.hpp"
#include "io/json.hpp"
#include "io/load.hpp"
#include "io/load_variation.hpp"
#include "io/output.hpp"
#include "io/rock_in.hpp"
#include "io/table.hpp"
#include "io/toml_in.hpp"
#include "report/page.hpp"

namespace phy::cli {
namespace {

namespace fs = std::filesystem;

struct ReportArguments {
  std::string result, rock, out;
};

bool has(const std::string& folder, const char* file) {
  std::error_code none;
  return fs::exists(fs::path(folder) / file, none);
}
std::string text_of(const std::string& folder, const char* file) {
  return has(folder, file) ? io::read_written((fs::path(folder) / file).string()) : "";
}

/// The table that a calibration went by.
std::vector<Target> laboratory_of(const nlohmann::json& calibration) {
  std::vector<Target> targets;
  for (const nlohmann::json& row : calibration.at("fitted")) {
    Target t;
    for (int i = 0; i < n_properties; ++i)
      if (row.at("property") == to_string(static_cast<Property>(i))) t.property = static_cast<Property>(i);
    t.theta = row.at("theta [deg]"), t.mean = row.at("laboratory").at("mean");
    t.sd = row.at("laboratory").at("sd"), t.n = io::whole_number<int>(row.at("laboratory").at("n"));
    t.diameter = row.value("diameter [m]", 0.0), t.confining = row.value("confining [Pa]", 0.0);
    targets.push_back(t);
  }
  return targets;
}

report::PageExtras of_calibration(const std::string& folder) {
  report::PageExtras extras;
  extras.calibration = text_of(folder, "calibration.json");
  try {
    const auto j = io::parse_json<nlohmann::json>(extras.calibration);
    if (j.at("format") != 1) throw std::out_of_range("another version of the format");
    extras.name = j.at("rock");
    extras.laboratory = laboratory_of(j);
  } catch (const std::exception& e) {
    throw InputError(Problem{folder + "/calibration.json", "", "", "a calibration of format 1", e.what()});
  }
  extras.recipe = text_of(folder, "calibrated.toml");
  return extras;
}

report::PageExtras of_study(const std::string& folder) {
  report::PageExtras extras;
  extras.variation = io::read_variation(folder);
  extras.name = extras.variation->name;
  extras.recipe = text_of(folder, "recipe.toml");
  if (has(folder, "effects.csv")) {
    const io::Table table = io::parse_table(text_of(folder, "effects.csv"), folder + "/effects.csv");
    if (!table.problems.empty()) throw InputError(table.problems);
    extras.effects.push_back(table.header);
    for (const io::TableRow& row : table.rows) extras.effects.push_back(row.cells);
  }
  return extras;
}

/// The exit code.
int report(const ReportArguments& args) {
  RunRecord run;
  report::PageExtras extras;
  if (has(args.result, "calibration.json"))
    extras = of_calibration(args.result);
  else if (io::holds_variation(args.result))
    extras = of_study(args.result);
  else
    run = io::read_run(args.result);
  if (!args.rock.empty()) extras.laboratory = targets_of(io::read_rock(args.rock));
  const std::string out = args.out.empty() ? (fs::path(args.result) / "report.html").string() : args.out;
  io::check_outputs({out});
  const auto start = std::chrono::steady_clock::now();
  const std::string page = report::report_page(run, extras);
  io::write_output(out, page);
  const double seconds = seconds_since(start);
  print_out("{}: {}{:.1f} MB, written in {:.2f} s\n", out,
            run.tests.empty() ? "" : fmt::format("{} specimens, ", run.tests.size()),
            1e-6 * static_cast<double>(page.size()), seconds);
  return tell_provenance(run, 0);
}

}  // namespace

void write_report(const std::string& folder) { report({folder, "", ""}); }

void add_report_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<ReportArguments>();
  CLI::App* verb = app.add_subcommand("report", "write report.html of a result anew");
  verb->add_option("result", args->result, "folder of a run (or one specimen of it), study or calibration")
      ->required();
  verb->add_option("--rock", args->rock, "rock file (TOML): its laboratory values beside the model");
  verb->add_option("--out", args->out, "file; default: report.html in the folder");
  verb->callback([args, &session] { session.exit_code = report(*args); });
}

}  // namespace phy::cli
