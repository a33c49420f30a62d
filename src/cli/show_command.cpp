// `phyllite show RESULT`: the tables of a result, read back from its folder.
#include <fmt/format.h>

#include <algorithm>

#include "cli/commands.hpp"
#include "cli/provenance.hpp"
#include "cli/terminal.hpp"
#include "io/load.hpp"
#include "report/tables.hpp"

namespace phy::cli {
namespace {

int show(const std::string& path, const Session& session) {
  const RunRecord run = io::read_run(path);
  // A run puts specimens of one recipe and packing into a folder, so the first speaks for all.
  const SpecimenRecord& first = run.tests.front();
  std::vector<TestResult> results;
  bool all_strong = run.missing.empty();
  for (const SpecimenRecord& t : run.tests) {
    results.push_back(t.result);
    all_strong = all_strong && has_strength(t.result.outcome.status);
  }
  const int width = session.terminal_width;
  print_wrapped(width, 10, "recipe    {} ({})\n", first.recipe.name, first.program);
  print_wrapped(width, 10, "packing   {} discs, porosity {:.4f}, coordination {:.3f}\n\n", first.n_grains,
                first.packing.porosity, first.packing.coordination);
  print_out("{}\n", report::press_table(results, width));
  print_wrapped(width, 2, "{}", report::outcome_lines(results));
  // As when the run ended: a script that looks later gets the same code.
  return std::max(tell_provenance(run, width), all_strong ? 0 : 1);
}

}  // namespace

void add_show_command(CLI::App& app, Session& session) {
  auto path = std::make_shared<std::string>();
  CLI::App* verb = app.add_subcommand(
      "show", "print the tables of a run again (of a study: `study status`, `study effects`)");
  verb->add_option("result", *path,
                   "folder that `phyllite run` wrote, `specimens` of a calibration, or one specimen of them")
      ->required()
      ->type_name("FOLDER");
  verb->callback([path, &session] { session.exit_code = show(*path, session); });
}

}  // namespace phy::cli
