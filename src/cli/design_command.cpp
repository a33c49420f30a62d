// `phyllite design CALIBRATION`: constants of a calibrated rock for other codes, with their uncertainty.
#include <fmt/format.h>

#include <filesystem>

#include "base/clock.hpp"
#include "cli/ensemble.hpp"
#include "cli/machine.hpp"
#include "cli/stresses.hpp"
#include "cli/terminal.hpp"
#include "design/sheet.hpp"
#include "jobs/design_job.hpp"
#include "report/words.hpp"

namespace phy::cli {
namespace {

struct DesignArguments {
  std::string calibration, out = "results/design", reading = "plane stress";
  std::vector<std::string> stresses = {"0 MPa", "5 MPa", "10 MPa"};
  int draws = 0;
  double nu = nan, dip = 0.0;
  bool with_untrusted = false, model_alone = false;
};

jobs::DesignRequest request_of(const DesignArguments& args) {
  jobs::DesignRequest request;
  request.calibration = args.calibration, request.out = args.out;
  request.stresses = read_stresses("--stresses", args.stresses);
  request.n_draws = static_cast<std::size_t>(args.draws), request.dip = args.dip;
  request.reading.nu = args.nu, request.model_alone = args.model_alone;
  if (args.reading == "plane strain") request.reading.state = theory::PlaneState::strain;
  return request;
}

void print_tables(const design::Design& design, int width) {
  for (const design::SheetTable& t : design::sheet_tables(design)) {
    std::vector<Column> columns;
    for (std::size_t c = 0; c < t.head.size(); ++c)
      columns.push_back(column_of(t.head[c], "", t.rows, [&](const auto& row) { return row[c]; }));
    columns.front().left = columns.back().left = true;
    print_out("\n{}\n{}", t.title,
              text_table(columns.front(), {Columns(columns.begin() + 1, columns.end())}, width));
  }
}

int design_of(const DesignArguments& args, const Session& session) {
  const jobs::DesignPlan plan = jobs::plan_design(request_of(args));
  const int width = session.terminal_width;
  print_wrapped(width, 8, "design  {}: {} draws, {} tests; constants under {} confining stresses\n",
                plan.calibration.rock, plan.draws.size(), plan.n_tests(), plan.request.stresses.size());
  flush_out();
  ProgressLine line;
  const auto simulator = calibrate::make_simulator(tests_in(args.out, args.with_untrusted, session, line));
  design::Design design;
  try {
    design = jobs::run_design(plan, *simulator);
  } catch (const calibrate::Stopped&) {
    line.finish();
    return tell_stopped(args.out, width);
  }
  line.finish();
  const std::vector<std::string> files = jobs::write_design(args.out, design);
  print_tables(design, width);
  print_out("\n");
  for (const std::string& sentence : report::sentences(design.findings))
    print_wrapped(width, 2, "- {}\n", sentence);
  print_wrapped(width, 2, "\nin {}: {}\n", args.out, fmt::join(files, ", "));
  // Scripts learn that something could not be had: constants of a part that the rock may have.
  const auto has = [&](design::Part part) { return design.part(part).ok(); };
  using enum design::Part;
  return has(elasticity) && has(tension) && (has(ubiquitous_joint) || !design.tests.weak_planes) ? 0 : 1;
}

}  // namespace

void add_design_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<DesignArguments>();
  CLI::App* verb =
      app.add_subcommand("design", "constants of a calibrated rock for FLAC, PLAXIS, RS2, OpenGeoSys");
  verb->add_option("calibration", args->calibration, "folder of a calibration, or its calibrated.toml")
      ->required()
      ->type_name("FOLDER");
  verb->add_option("--stresses", args->stresses,
                   "confining stresses that the constants are fitted to, three or more")
      ->delimiter(',')
      ->capture_default_str();
  verb->add_option("--draws", args->draws, "draws of the calibration that are tested; 0: all")
      ->check(within(0, 1000))
      ->capture_default_str();
  verb->add_option("--nu", args->nu, "Poisson's ratio in the planes of isotropy; default: nu' E/E'")
      ->check(within(-1.0, 1.0));
  verb->add_option("--elastic-reading", args->reading, "how two dimensions are read")
      ->check(CLI::IsMember({"plane stress", "plane strain"}))
      ->capture_default_str();
  verb->add_option("--dip", args->dip,
                   "inclination of the planes [deg] in the files, counter-clockwise from x")
      ->check(within(-90.0, 90.0))
      ->capture_default_str();
  verb->add_flag("--with-untrusted", args->with_untrusted,
                 "tests that are not to be trusted count like others");
  verb->add_flag("--model-alone", args->model_alone,
                 "strengths of the model, without what it misses of its table");
  verb->add_option("--out", args->out, "folder for the results")->type_name("FOLDER")->capture_default_str();
  verb->callback([args, &session] { session.exit_code = design_of(*args, session); });
}

}  // namespace phy::cli
