// `phyllite export pfc2d`: specimens for another program, disc by disc and bond by bond.
#include <fmt/format.h>

#include <filesystem>

#include "base/check.hpp"
#include "cli/commands.hpp"
#include "cli/machine.hpp"
#include "cli/terminal.hpp"
#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "io/load.hpp"
#include "io/output.hpp"
#include "io/store.hpp"
#include "io/toml_in.hpp"
#include "report/pfc_specimen.hpp"

namespace phy::cli {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string what, out = "pfc2d";
};

/// A recipe, which of its specimens (empty: all), and the discs that they must have.
struct Wanted {
  Recipe recipe;
  std::string specimen, packing_hash;
};

std::vector<Wanted> wanted_of(const std::string& path) {
  if (!fs::is_directory(path)) return {{io::read_recipe(path), "", ""}};
  std::vector<Wanted> all;
  for (const SpecimenRecord& t : io::read_run(path).tests)
    // Results keep no bonds: they are made again from the recipe, and the hash shows that the discs are the
    // same.
    all.push_back({t.recipe, t.result.name, t.packing_hash});
  return all;
}

struct File {
  std::string path, content;
};

/// The files of what is wanted; too many bodies are told.
std::vector<File> files_of(const Wanted& w, const ExportArguments& args, int width) {
  const auto packing = genesis::packing_of(w.recipe, genesis::default_cache_folder(),
                                           [stop = stop_on_interrupt()] { return stop->load(); });
  // The cache may be gone and the version another: other discs are another specimen.
  if (!w.packing_hash.empty() && packing->hash != w.packing_hash)
    throw InputError(Problem{args.what, "packing", packing->hash,
                             w.packing_hash + ", the discs of the result",
                             "the recipe makes other discs now: run it again, or name the recipe"});
  // Told, not refused: somebody with a licence has no limit.
  if (packing->discs.size() + 2 > report::pfc_free_bodies)
    print_wrapped(width, 2,
                  "{} discs and two platens: PFC2D without a licence is said to take {} bodies; with one "
                  "this is no matter, else lower packing.n_grains and the specimen's size with it\n",
                  packing->discs.size(), report::pfc_free_bodies);
  std::vector<File> files;
  for (const Specimen& s : genesis::make_specimens(packing, w.recipe)) {
    if (!w.specimen.empty() && s.name != w.specimen) continue;
    const std::string stem = io::folder_name(s.name);
    report::PfcFiles made = report::pfc_specimen(w.recipe, s, stem);
    const std::string path = (fs::path(args.out) / stem).string();
    files.push_back({path + "-specimen.p2dat", std::move(made.specimen)});
    files.push_back({path + "-test.p2dat", std::move(made.test)});
  }
  return files;
}

void export_pfc2d(const ExportArguments& args, const Session& session) {
  const std::vector<Wanted> wanted = wanted_of(args.what);
  // Packings are made anew where the cache lacks them, which takes minutes.
  stop_on_interrupt();
  // All recipes first: half a set of files is worse than none.
  for (const Wanted& w : wanted) report::check_pfc_export(w.recipe, args.what);
  std::vector<File> files;
  std::vector<std::string> names;
  for (const Wanted& w : wanted)
    for (File& f : files_of(w, args, session.terminal_width)) {
      names.push_back(f.path);
      files.push_back(std::move(f));
    }
  // All names are known before the first file is written.
  io::check_outputs(names);
  for (const File& f : files) io::write_output(f.path, f.content);
  for (const std::string& name : names) print_out("{}\n", name);
  print_wrapped(session.terminal_width, 2,
                "Call a -test file in PFC2D; it writes ...-pfc.csv, which `phyllite compare` lays beside a "
                "result. Not yet run in PFC2D.\n");
}

}  // namespace

void add_export_command(CLI::App& app, Session& session) {
  CLI::App* verb = app.add_subcommand("export", "write a specimen and its test for another program");
  // One word for the target: another program gets a verb beside pfc2d, and no option changes its meaning.
  verb->require_subcommand(1);
  auto args = std::make_shared<ExportArguments>();
  CLI::App* pfc =
      verb->add_subcommand("pfc2d", "command files of PFC2D: discs, bonds, joints, platens, test");
  pfc->add_option("what", args->what, "folder of a run or of one specimen, or a recipe (TOML)")
      ->required()
      ->type_name("PATH");
  pfc->add_option("--out", args->out, "folder for the files")->capture_default_str()->type_name("FOLDER");
  pfc->callback([args, &session] {
    session.exit_code = 0;
    export_pfc2d(*args, session);
  });
}

}  // namespace phy::cli
