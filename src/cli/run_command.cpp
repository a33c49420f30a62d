// `phyllite run RECIPE...`: packing, specimens, tests, results on disk, one table.
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <optional>

#include "base/check.hpp"
#include "base/clock.hpp"
#include "base/units.hpp"
#include "cli/commands.hpp"
#include "cli/ensemble.hpp"
#include "cli/machine.hpp"
#include "cli/press.hpp"
#include "cli/terminal.hpp"
#include "engine/isa.hpp"
#include "genesis/cache.hpp"
#include "genesis/specimen.hpp"
#include "io/load.hpp"
#include "io/new_folder.hpp"
#include "io/output.hpp"
#include "io/store.hpp"
#include "io/toml_in.hpp"
#include "jobs/result_reference.hpp"
#include "jobs/run_folder.hpp"
#include "lab/load_path.hpp"
#include "lab/scene_room.hpp"
#include "report/tables.hpp"
#include "study/expected.hpp"

namespace phy::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct RunArguments {
  std::vector<std::string> recipes;
  std::string out = "results";
  int lanes = 0;
  int skew = 8;
  bool no_cache = false, replace = false;
  bool ensemble = false, with_untrusted = false;
};

constexpr double least_overlap = 1e-6;  // of the radius; below it a relaxed packing carries nothing

void print_packing(const Packing& p, double seconds, bool cached, int width) {
  const PackingReport& r = p.report;
  print_wrapped(
      width, 10,
      "packing   {} discs, porosity {:.4f}, coordination {:.3f}, fabric <cos 2a> {:+.4f}, rattlers {}\n",
      p.discs.size(), r.porosity, r.coordination, r.fabric, r.n_rattlers);
  print_wrapped(width, 10,
                "          {}, mean overlap {:.2e} of the radius, unbalanced {:.1e}; {} in {:.2f} s\n",
                p.stress_free ? "overlaps stress-free"
                              : fmt::format("locked-in stress {:.3f} MPa", r.stress_left * 1e-6),
                r.mean_overlap, r.unbalanced, cached ? "from the cache" : "made", seconds);
}

void print_bedding(const Specimen& s, int width) {
  for (std::size_t i = 0; i < s.bedding.size(); ++i) {
    const BeddingReport& b = s.bedding_report[i];
    const double theta = s.bedding[i].theta;
    if (b.dispersed)
      print_wrapped(
          width, 10,
          "bedding   set {} at {:g} deg: oriented rule, no planes, {:.1f} % of all contacts are joints\n",
          i + 1, theta, 100.0 * b.joint_fraction);
    else if (s.bedding[i].unjointed())
      print_wrapped(width, 10, "bedding   set {} at {:g} deg: layers of {} without joints, {} apart\n", i + 1,
                    theta, print_quantity(s.bedding[i].layer_thickness, Dimension::length),
                    print_quantity(s.bedding[i].spacing, Dimension::length));
    else
      print_wrapped(
          width, 10,
          "bedding   set {} at {:g} deg: {} rule, sum(A)/L {:.3f}, bridges {:.1f} %, joints off the plane "
          "{:.1f} %\n",
          i + 1, theta, s.bedding[i].rule == BeddingRule::zone ? "zone" : "crossing", b.overlap_ratio,
          100.0 * b.bridge_fraction, 100.0 * b.non_crossing_fraction);
  }
}

/// Discs that found room without pressing on each other: where they meet is chance, not a packing.
void tell_loose_packing(const Packing& p, const Recipe& recipe, int width) {
  const bool made = recipe.packing.file.empty() && p.stress_free;
  // Imported discs are as somebody wanted them.
  if (!made || p.report.mean_overlap > least_overlap) return;
  print_wrapped(
      width, 10,
      "          LOOSE: the discs do not press on each other at this porosity, and bonds are where gaps "
      "are below matrix.bond_gap; lower the porosity for contacts\n");
}

struct Made {
  std::shared_ptr<const Packing> packing;
  std::vector<std::shared_ptr<const Specimen>> specimens;
};

Made make_all(const Recipe& recipe, bool no_cache, int width) {
  const auto start = Clock::now();
  // An empty folder switches the cache off, for reading as for writing.
  const fs::path folder = no_cache ? "" : genesis::default_cache_folder();
  // Asked before: afterwards it is there in either case.
  const bool cached = genesis::is_cached(recipe, folder);
  Made made;
  made.packing = genesis::packing_of(recipe, folder, [stop = stop_on_interrupt()] { return stop->load(); });
  const double seconds = seconds_since(start);
  print_packing(*made.packing, seconds, cached, width);
  // Still not there: the cache cannot be written, and each run would make the packing again.
  if (recipe.packing.file.empty() && !folder.empty() && !genesis::is_cached(recipe, folder)) {
    const std::string key = genesis::packing_key(recipe.specimen, recipe.packing, recipe.matrix);
    print_wrapped(width, 10, "          it is not kept for the next run: {} cannot be written\n",
                  genesis::cache_file(folder, key).string());
  }
  tell_loose_packing(*made.packing, recipe, width);
  for (Specimen& s : genesis::make_specimens(made.packing, recipe))
    made.specimens.push_back(std::make_shared<const Specimen>(std::move(s)));
  // The first angle speaks for all: lines for seven angles would hide the rest. `specimen` prints each.
  if (!made.specimens.empty()) print_bedding(*made.specimens.front(), width);
  return made;
}

/// Threads, lanes and instruction set; prints them.
study::MachineOptions chosen_machine(const Recipe& recipe, const RunArguments& args, const Session& session,
                                     std::size_t n_specimens) {
  study::MachineOptions machine = machine_of(session);
  machine.lanes = args.lanes;
  machine.skew = args.skew;
  print_wrapped(session.terminal_width, 10,
                "press     {} specimens, {}, {} precision, {} of {}, {} thread(s)\n", n_specimens,
                speed_words(recipe.test),
                recipe.engine.precision == Precision::double_precision ? "double" : "single",
                args.lanes > 0 ? fmt::format("{} lane(s)", args.lanes) : "lanes as they fit",
                engine::to_string(machine.isa), machine.threads);
  return machine;
}

/// A recipe of the command line and the folder of its results.
struct RecipeRun {
  std::string path, folder;
  Recipe recipe;
};

/// What is wrong with so many lanes for a recipe; 0: as many as fit.
std::optional<Problem> lanes_problem(const RecipeRun& job, int lanes) {
  const engine::Isa isa = engine::native_isa();
  const Precision precision = job.recipe.engine.precision;
  const std::vector<int> some = engine::lanes_of(precision, isa);
  // Registers hold as many numbers as their width divided by the precision: few counts are possible.
  if (lanes == 0 || std::find(some.begin(), some.end(), lanes) != some.end()) return std::nullopt;
  return Problem{"command line", "--lanes", std::to_string(lanes),
                 fmt::format("{}: what {} registers hold in {} precision, which {} asks for",
                             fmt::join(some, ", "), engine::to_string(isa),
                             precision == Precision::double_precision ? "double" : "single", job.path),
                 "leave it out: lanes are chosen as they fit"};
}

/// The recipes, all read and their folders looked at before anything runs. Several have a folder each, named
/// after their files.
std::vector<RecipeRun> jobs_of(const RunArguments& args) {
  std::vector<RecipeRun> jobs;
  std::vector<std::string> pages;
  std::vector<Problem> problems;
  for (const std::string& path : args.recipes) {
    const bool several = args.recipes.size() > 1;
    // One recipe needs no folder below --out, and a long path would be in the way.
    const std::string folder = several ? (fs::path(args.out) / fs::path(path).stem()).string() : args.out;
    for (const RecipeRun& other : jobs)
      // Folders are named after files: a/x.toml and b/x.toml would share one.
      if (other.folder == folder)
        problems.push_back({"command line", "recipe", path, "another file name than " + other.path,
                            "both would write into " + folder + ": run them one by one, with an --out each"});
    jobs.push_back({path, folder, {}});
  }
  // Before the files are read: two recipes of one name would be compared with one folder.
  if (!problems.empty()) throw InputError(std::move(problems));
  for (RecipeRun& job : jobs) {
    job.recipe = io::read_recipe(job.path);
    pages.push_back(jobs::page_of(job.folder));
    for (Problem& p : jobs::run_folder_problems(job.folder, job.recipe, job.path, args.replace))
      problems.push_back(std::move(p));
  }
  for (const RecipeRun& job : jobs)
    if (std::optional<Problem> p = lanes_problem(job, args.lanes)) problems.push_back(std::move(*p));
  if (!problems.empty()) throw InputError(std::move(problems));
  io::check_outputs(pages);
  return jobs;
}

/// Writes the page, then prints: the output may be closed or full. The exit code.
int finish(const RecipeRun& job, const std::vector<TestResult>& results, const Clock::time_point& start,
           int width) {
  const auto has = [&](auto&& wanted) {
    return std::any_of(results.begin(), results.end(),
                       [&](const TestResult& r) { return wanted(r.outcome.status); });
  };
  const bool any = has([](Status s) { return s != Status::interrupted; });
  // First to disk: printing may fail.
  if (any) jobs::write_run_report(job.folder, results);
  print_out("\n{}\n", report::press_table(results, width));
  const std::string trouble = report::outcome_lines(results);
  if (!trouble.empty()) print_wrapped(width, 2, "{}\n", trouble);
  const double seconds = seconds_since(start);
  if (any)
    print_wrapped(width, 2, "{:.1f} s in all; results in {}, to look at: {}/report.html\n", seconds,
                  job.folder, job.folder);
  else
    print_wrapped(width, 2, "{:.1f} s in all; no test was finished, nothing was written\n", seconds);
  return has([](Status s) { return !has_strength(s); }) ? 1 : 0;
}

int run_one(const RecipeRun& job, const RunArguments& args, const Session& session) {
  // Made now and removed again if nothing comes into it, so that a run that is refused leaves no trace.
  const jobs::ResultFolder folder(job.folder);
  const auto start = Clock::now();
  const int width = session.terminal_width;
  print_wrapped(width, 10, "recipe    {} ({})\n", job.recipe.name, job.path);
  // Below a gigabyte every machine has it, and the line would only be noise.
  constexpr double worth_telling = 1e9;  // bytes
  if (const double most = study::expected_memory(job.recipe, specimen_names(job.recipe).size());
      most > worth_telling)
    print_wrapped(width, 10, "memory    up to some {:.0f} GB\n", std::ceil(1e-9 * most));
  print_notes(job.recipe.notes, width);
  flush_out();  // a large packing takes minutes
  const Made made = make_all(job.recipe, args.no_cache, width);
  lab::check_load_path(*made.specimens.front(), job.recipe);  // all have the contacts of one packing
  lab::check_scene_room(*made.specimens.front(), job.recipe);
  const study::MachineOptions machine = chosen_machine(job.recipe, args, session, made.specimens.size());
  flush_out();
  if (args.replace)
    // Only now: an input that cannot be used must not cost the older results.
    for (const auto& [other, differences] : jobs::results_of_others(job.folder, job.recipe))
      io::remove_folder(other);
  return finish(job, press(job.recipe, made.specimens, job.folder, machine), start, width);
}

}  // namespace

void add_run_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<RunArguments>();
  CLI::App* run = app.add_subcommand("run", "run the laboratory test of one or more recipes");
  run->add_option("recipe", args->recipes, "recipe files (TOML)")->required()->type_name("FILE");
  run->add_option("--out", args->out, "folder for the results")->capture_default_str()->type_name("FOLDER");
  run->add_option("--lanes", args->lanes,
                  "specimens side by side, as far as a register holds them: 1, 2, 4, 8 (double), 1, 4, 8, 16 "
                  "(float); 0 = automatic")
      ->check(CLI::IsMember({0, 1, 2, 4, 8, 16}))
      ->capture_default_str();
  run->add_option("--skew", args->skew, "cycles per sweep; changes the speed only")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  run->add_flag("--replace", args->replace, "remove results of another recipe from the folder");
  run->add_flag("--no-cache", args->no_cache, "make the packing anew");
  CLI::Option* ensemble = run->add_flag("--ensemble", args->ensemble,
                                        "the test of calibrated.toml on every draw of the calibration, and "
                                        "the band of all (docs/calibration.md)");
  for (const char* other : {"--lanes", "--skew", "--replace", "--no-cache"})
    // Draws run in a study's way, which chooses lanes and keeps packings by itself.
    ensemble->excludes(run->get_option(other));
  run->add_flag("--with-untrusted", args->with_untrusted,
                "count tests that have a strength but are not to be trusted (docs/reliability.md)")
      ->needs(ensemble);
  add_reference(*run, jobs::result_reference, "print the tables of measures, columns and keys of a result");
  run->callback([args, &session] {
    if (args->ensemble) {
      session.exit_code = run_ensemble({args->recipes, args->out, args->with_untrusted}, session);
      return;
    }
    const std::vector<RecipeRun> jobs = jobs_of(*args);
    stop_on_interrupt();
    for (const RecipeRun& job : jobs)
      // The worst of all recipes: one that failed must not be hidden by the next.
      session.exit_code = std::max(session.exit_code, run_one(job, *args, session));
  });
}

void add_specimen_command(CLI::App& app, Session& session) {
  auto path = std::make_shared<std::string>();
  auto out = std::make_shared<std::string>();
  CLI::App* verb =
      app.add_subcommand("specimen", "make the packing and bedding of a recipe and report on them");
  verb->add_option("recipe", *path, "recipe file (TOML)")->required()->type_name("FILE");
  verb->add_option("--out", *out, "folder for discs.csv and contacts.csv")->type_name("FOLDER");
  verb->callback([path, out, &session] {
    session.exit_code = 0;
    const Recipe recipe = io::read_recipe(*path);
    const fs::path folder(*out);
    const std::string discs = (folder / "discs.csv").string();
    const auto contacts = [&](const std::string& name) {
      return (folder / ("contacts_" + io::folder_name(name) + ".csv")).string();
    };
    if (!out->empty()) {
      std::vector<std::string> files = {discs};
      for (const std::string& name : specimen_names(recipe)) files.push_back(contacts(name));
      io::check_outputs(files);
      io::check_writable(*out);
    }
    print_notes(recipe.notes, session.terminal_width);
    const Made made = make_all(recipe, false, session.terminal_width);
    // The first was printed with the packing.
    for (std::size_t i = 1; i < made.specimens.size(); ++i)
      print_bedding(*made.specimens[i], session.terminal_width);
    if (!out->empty()) {
      // Those that are left where the test takes some away: contacts number them.
      io::write_output(discs, io::discs_csv(*made.specimens.front()->packing));
      for (const auto& s : made.specimens) io::write_output(contacts(s->name), io::contacts_csv(*s));
      print_out("discs and contacts in {}\n", *out);
    }
  });
}

}  // namespace phy::cli
