// `phyllite replay FOLDER`: the stored recipes of a folder are run again, and every number is held against
// what is stored.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/check.hpp"
#include "base/clock.hpp"
#include "base/version.hpp"
#include "cli/commands.hpp"
#include "cli/machine.hpp"
#include "cli/progress.hpp"
#include "cli/provenance.hpp"
#include "cli/terminal.hpp"
#include "io/load.hpp"
#include "io/store.hpp"
#include "io/toml_in.hpp"
#include "records/test_description.hpp"
#include "study/experiment.hpp"
#include "study/replay.hpp"
#include "study/store.hpp"
#include "study/worker.hpp"

namespace phy::cli {
namespace {

namespace fs = std::filesystem;

// A store holds hundreds of tests, hours of work: a sample over kinds and angles shows a difference as well.
constexpr std::size_t of_a_store = 8;  // tests that are run again where nobody asks for more
constexpr std::size_t most_told = 6;   // differences of one test

struct ReplayArguments {
  std::string folder, out;
  std::size_t tests = 0;  ///< 0: all of a run, `of_a_store` of a store
};

/// A stored test.
struct Stored {
  std::string name, place;  ///< for people; of its own folder below --out
  Recipe recipe, single;    ///< as stored; of this specimen alone
  TestResult result;
  std::string packing_hash, key;  ///< empty: not stored
  bool direct = false;            ///< a direct solution
  bool done = false;              ///< it has been run again
  std::vector<std::string> differences;
};

/// The recipe of one specimen of a run.
Recipe single_of(const SpecimenRecord& record, const std::string& folder) {
  const std::vector<std::string> names = specimen_names(record.recipe);
  const auto it = std::find(names.begin(), names.end(), record.result.name);
  if (it == names.end())
    throw InputError(Problem{folder, "specimen", record.result.name, "one of its recipe's", ""});
  // A test is run again alone, beside other neighbours in the lanes: the bits must not depend on them.
  return study::single_recipes(record.recipe)[static_cast<std::size_t>(it - names.begin())];
}

/// The folders of a path that hold results: it, or those in it (of an envelope, of several recipes).
std::vector<std::string> runs_in(const std::string& path) {
  if (!io::result_folders(path).empty()) return {path};
  std::vector<std::string> runs;
  for (const std::string& entry : io::list_folder(path))
    // A run that was killed leaves half-written folders, which were never results.
    if (fs::is_directory(entry) && !io::is_temporary(entry) && !io::result_folders(entry).empty())
      runs.push_back(entry);
  return runs;
}

std::vector<std::string> stores_in(const std::string& path) {
  std::vector<std::string> stores;
  for (const std::string& entry : io::list_folder(path))
    if (fs::path(entry).extension() == ".sqlite") stores.push_back(entry);
  return stores;
}

/// The results of a run; 3 where some cannot be read.
int read_run(const std::string& folder, const std::string& path, std::vector<Stored>& all, int width) {
  RunRecord run = io::read_run(folder);
  const std::string part = folder == path ? "" : fs::path(folder).filename().string() + "/";
  for (SpecimenRecord& record : run.tests) {
    Stored s;
    s.name = part + record.result.name, s.place = part + io::folder_name(record.result.name);
    s.single = single_of(record, folder);
    s.recipe = record.recipe, s.packing_hash = record.packing_hash;
    s.result = std::move(record.result);
    all.push_back(std::move(s));
  }
  return tell_provenance(run, width);
}

/// Some of the tests of a store, with their histories.
void read_store(const std::string& file, std::size_t n, std::vector<Stored>& all, int width) {
  const study::Store store(file, study::Sharing::reading);
  const std::vector<study::StoredResult> rows = store.rows();
  std::vector<Recipe> singles;
  // From the recipe in the row and not from files beside the store, which may have been edited since.
  for (const study::StoredResult& row : rows) singles.push_back(io::parse_recipe(row.recipe, file));
  std::vector<std::optional<study::StoredResult>> chosen;
  for (const std::size_t i : study::spread(singles, n)) {
    chosen.push_back(store.find(rows[i].key));
    Stored s;
    s.result = std::move(chosen.back()->result);
    s.key = rows[i].key, s.place = s.key, s.direct = s.key.starts_with("direct-");
    s.name = fmt::format("{} {}, {}", s.key, s.direct ? "direct solution" : singles[i].test.kind->name,
                         s.result.name);
    s.recipe = s.single = singles[i];
    all.push_back(std::move(s));
  }
  print_wrapped(width, 10, "store     {}: {} of its {} tests, spread over kinds and angles\n", file,
                chosen.size(), rows.size());
  tell_versions(chosen, width);
}

/// Everything that is to be run again. Throws InputError where there is nothing.
std::vector<Stored> read_all(const ReplayArguments& args, int width, int& code) {
  std::vector<Stored> all;
  const std::vector<std::string> runs = runs_in(args.folder), stores = stores_in(args.folder);
  for (const std::string& run : runs) code = std::max(code, read_run(run, args.folder, all, width));
  // Chosen after all runs were read, so that the number holds for the folder and not for each run.
  if (args.tests > 0 && args.tests < all.size()) {
    std::vector<Recipe> singles;
    for (const Stored& s : all) singles.push_back(s.single);
    std::vector<Stored> some;
    for (const std::size_t i : study::spread(singles, args.tests)) some.push_back(std::move(all[i]));
    all = std::move(some);
  }
  for (const std::string& store : stores)
    read_store(store, args.tests > 0 ? args.tests : of_a_store, all, width);
  if (all.empty())
    throw InputError(Problem{args.folder, "", "", "a folder with results that can be run again",
                             "name the --out of `phyllite run`, `envelope`, `study` or `calibrate`"});
  return all;
}

/// Holds what was run again against what is stored, and writes it where that is wanted.
void compare(Stored& s, const study::PlannedTest& test, const TestResult& now, const std::string& out) {
  const bool was_made = !now.snapshots.empty();
  // A direct solution has no snapshots: there is no specimen to write.
  if (was_made && (!s.packing_hash.empty() || !out.empty())) {
    const auto specimen = study::specimen_of(study::packing_of(s.single), s.single);
    if (const std::string& hash = specimen->packing->hash; !s.packing_hash.empty() && s.packing_hash != hash)
      s.differences.push_back(
          fmt::format("packing: other discs, stored with hash {}, now {}", s.packing_hash, hash));
    if (!out.empty())
      io::write_result((fs::path(out) / s.place).string(), s.recipe, phy::version, *specimen, now);
  }
  // A key is the fingerprint of the completed recipe: equal numbers under another key would never be found
  // again.
  const std::string key = (s.direct ? "direct-" : "") + test.key;
  if (!s.key.empty() && s.key != key)
    s.differences.push_back("key: its recipe has another one now, " + key +
                            ": it was stored by a version of other physics, or imported discs have changed");
  for (std::string& d : study::differences(s.result, now)) s.differences.push_back(std::move(d));
  // Only now: what was interrupted must not count as equal.
  s.done = true;
}

/// Runs the tests of one solver again.
void run_again(const std::vector<Stored*>& tests, bool direct, const ReplayArguments& args,
               const study::MachineOptions& machine, ProgressLine& line) {
  std::vector<Recipe> singles;
  for (const Stored* s : tests) singles.push_back(s->single);
  study::Plan plan = study::plan_of(singles);
  // One plan holds one solver.
  plan.study.solver = direct ? study::Solver::direct : study::Solver::dynamic;
  std::size_t n_done = 0;
  study::Hooks hooks;
  hooks.stop = stop_on_interrupt();
  hooks.on_result = [&](std::size_t test, const TestResult& now) {
    if (now.outcome.status == Status::interrupted) return;
    // Equal recipes are one test of the plan, so that one result may answer several stored ones.
    for (std::size_t i = 0; i < tests.size(); ++i) {
      if (plan.runs[i].test != test) continue;
      compare(*tests[i], plan.tests[test], now, args.out), ++n_done;
      // At once: whoever sees the first difference may want to stop.
      if (!tests[i]->differences.empty()) line.note(tests[i]->name + ": differs");
    }
    line.show([&](double seconds) {
      return fmt::format("{}/{} tests run again, {:.0f} s", n_done, tests.size(), seconds);
    });
  };
  study::run_plan(plan, machine, hooks);
}

void print_test(const Stored& s, int width) {
  if (!s.done) return print_wrapped(width, 4, "  {}: not run\n", s.name);
  if (s.differences.empty())
    return print_wrapped(width, 4, "  {}: equal ({} numbers, {} rows, {} cracks, hash {})\n", s.name,
                         s.result.numbers.size(), s.result.history.rows.size(), s.result.cracks.size(),
                         s.result.hash);
  print_wrapped(width, 4, "  {}: DIFFERS\n", s.name);
  for (std::size_t i = 0; i < std::min(most_told, s.differences.size()); ++i)
    print_wrapped(width, 6, "    {}\n", s.differences[i]);
  if (s.differences.size() > most_told) print_out("    and {} more\n", s.differences.size() - most_told);
}

/// Prints every test and what follows; the exit code.
int conclude(const std::vector<Stored>& all, double seconds, int width) {
  for (const Stored& s : all) print_test(s, width);
  const auto n_done = std::count_if(all.begin(), all.end(), [](const Stored&s) { return s.done; }),
             n_other = std::count_if(all.begin(), all.end(),
                                     [](const Stored&s) { return s.done && !s.differences.empty(); });
  const bool stopped = n_done < static_cast<std::ptrdiff_t>(all.size());
  print_wrapped(width, 2, "{} of {} tests run again in {:.1f} s: {}{}\n", n_done, all.size(), seconds,
                n_other > 0 ? fmt::format("{} differ{} from what is stored", n_other, n_other == 1 ? "s" : "")
                : n_done > 0 ? "every number, row and crack is equal to what is stored"
                             : "nothing was compared",
                stopped ? "; stopped before the others" : "");
  if (n_other > 0)
    print_wrapped(width, 2,
                  "what was stored is not what {} computes here: if `phyllite verify --hash` finds the "
                  "recorded hashes, another version or build made it, or it was changed\n",
                  phy::program);
  // Stopped counts as failure, since a script would take 0 for "all equal".
  return n_other > 0 || stopped ? 1 : 0;
}

/// A folder for what is run again holds nothing yet.
void check_out(const std::string& out) {
  std::error_code none;
  if (fs::exists(out, none) && !io::list_folder(out).empty())
    throw InputError(Problem{"command line", "--out", out, "a folder that is empty or not there",
                             "what is stored stays beside what is run again"});
  // As for any result that may be put below it.
  io::check_result_place((fs::path(out) / "any").string());
}

int replay(const ReplayArguments& args, const Session& session) {
  const int width = session.terminal_width;
  const auto start = std::chrono::steady_clock::now();
  // Before hours of tests, whose results would find their place taken.
  if (!args.out.empty()) check_out(args.out);
  int code = 0;
  std::vector<Stored> all = read_all(args, width, code);
  print_wrapped(width, 10, "replay    {} test(s) of {}\n", all.size(), args.folder);
  flush_out();
  ProgressLine line;
  for (const bool direct : {false, true}) {
    std::vector<Stored*> tests;
    for (Stored& s : all)
      if (s.direct == direct) tests.push_back(&s);
    if (!tests.empty()) run_again(tests, direct, args, machine_of(session), line);
  }
  line.finish();
  return std::max(code, conclude(all, seconds_since(start), width));
}

}  // namespace

void add_replay_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<ReplayArguments>();
  CLI::App* verb =
      app.add_subcommand("replay", "run stored results again and compare every number with them");
  verb->add_option("folder", args->folder,
                   "folder of `phyllite run`, `envelope`, `study` or `calibrate`, or of one specimen")
      ->required()
      ->type_name("FOLDER");
  verb->add_option("--tests", args->tests,
                   "how many tests of the runs, and of each store, to run again, spread over kinds and "
                   "angles; default: all of a run, 8 of "
                   "every store")
      ->check(CLI::Range(1, 1000000));
  verb->add_option("--out", args->out,
                   "new folder for the results of the second run; default: none is written")
      ->type_name("FOLDER");
  verb->callback([args, &session] { session.exit_code = replay(*args, session); });
}

}  // namespace phy::cli
