// `phyllite study STUDY` and `study status | resume | export | effects | merge`: a folder with study.toml,
// recipe.toml and the store study.sqlite (of a shard: shard-I-of-N.sqlite).
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "base/check.hpp"
#include "base/quote.hpp"
#include "cli/commands.hpp"
#include "cli/machine.hpp"
#include "cli/progress.hpp"
#include "cli/provenance.hpp"
#include "cli/study_words.hpp"
#include "cli/suggested.hpp"
#include "cli/terminal.hpp"
#include "io/file.hpp"
#include "io/output.hpp"
#include "io/regressions.hpp"
#include "io/store.hpp"
#include "jobs/keys.hpp"
#include "jobs/study_folder.hpp"
#include "study/effects.hpp"
#include "study/experiment.hpp"
#include "study/mpi.hpp"
#include "study/store_queue.hpp"
#include "study/study_in.hpp"
#include "study/table.hpp"
#include "study/worker.hpp"

namespace phy::cli {
namespace {

namespace fs = std::filesystem;

constexpr int most_parts = 10000;

struct StudyArguments {
  std::string study, folder, shard, csv, key;
  std::vector<std::string> stores;
  std::string out;
  int slurm = 0;
  bool dry_run = false, reference = false, mpi = false, with_untrusted = false;
};

bool read_whole(std::string_view text, int& n) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), n);
  // "3x/10" is no number: from_chars alone would read 3 and drop the rest.
  return error == std::errc() && end == text.data() + text.size();
}

study::Shard parse_shard(const std::string& text) {
  study::Shard shard;
  const std::size_t slash = std::min(text.find('/'), text.size());
  const bool ok = text.empty() || (slash < text.size() && read_whole(text.substr(0, slash), shard.i) &&
                                   read_whole(text.substr(slash + 1), shard.n) && shard.i >= 1 &&
                                   shard.i <= shard.n && shard.n <= most_parts);
  if (!ok)
    throw InputError(Problem{"command line", "--shard", text,
                             fmt::format("i/n with 1 <= i <= n <= {}", most_parts),
                             "for example --shard 3/10"});
  return shard;
}

/// Where a study, or a part of it, is kept.
struct Place {
  std::string folder;
  study::Shard shard;
};

struct StudyRun {
  study::WorkReport report;
  std::size_t n_new = 0, n_guest = 0;
};

StudyRun run_plan(const study::Plan& plan, study::Store& store, const Session& session,
                  const study::Ranks* ranks) {
  ProgressLine line;
  study::Hooks hooks;
  hooks.stop = stop_on_interrupt();
  hooks.on_progress = [&](const study::Progress& p) {
    line.show([&](double seconds) { return jobs::progress_text(p, seconds); });
  };
  hooks.on_result = [&](std::size_t, const TestResult& r) {
    if (!has_answer(r.outcome.status)) line.note(r.name + ": " + r.outcome.reason);
  };
  const study::MachineOptions machine = machine_of(session);
  study::StoreQueue queue(plan, store, hooks,
                          // The time left depends on all threads that take tests from this store, those of
                          // other ranks too.
                          ranks != nullptr ? ranks->sum(machine.threads) : machine.threads);
  const study::WorkReport report = ranks != nullptr ? study::work_as_host(*ranks, queue, plan, machine)
                                                    : study::work_at(queue, plan, machine);
  line.finish();
  return {report, queue.progress().n_new, queue.progress().n_guest};
}

std::ptrdiff_t n_finished(const study::StudyRows& rows) {
  return std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row.has_value(); });
}

/// The tables of a whole store, written before they are printed: the output may be closed or full.
void report_tables(const study::Plan& plan, const study::StudyRows& rows, const std::string& folder,
                   int width) {
  jobs::write_tables(plan, rows, folder);
  print_out("{}", study::effects_text(plan, rows, width));
  print_out("\ntables in {}: results.csv, responses.csv, effects.csv\n", folder);
  // A study without a parameter has nothing to draw over.
  if (!plan.study.vary.empty()) write_report(folder);
}

int finish_study(const study::Plan& plan, const study::Store& store, const Place& place, const StudyRun& run,
                 const Session& session) {
  const auto& [folder, shard] = place;
  const auto rows = study::rows_of(plan, store);
  // A part has a share of the points, and curves of some points would look like those of all.
  if (shard.n == 1 && n_finished(rows) > 0) report_tables(plan, rows, folder, session.terminal_width);
  const std::size_t n_bad = print_failures(plan, rows, session.terminal_width),
                    n_left = n_unfinished(plan, rows);
  const study::WorkReport& report = run.report;
  const std::string lanes = lanes_text(report.lanes);
  print_wrapped(session.terminal_width, 2,
                "\n{} run in {:.1f} s ({:.1f} per minute), {:.1f} s CPU, idle tail {:.1f} %{}{}\n", run.n_new,
                report.wall_seconds, 60.0 * static_cast<double>(run.n_new) / report.wall_seconds,
                report.cpu_seconds, 100.0 * report.idle, lanes.empty() ? "" : ", ", lanes);
  if (run.n_guest > 0) print_out("{} of them on other ranks\n", run.n_guest);
  // One hash of all results: two machines that print the same have the same results.
  print_out("{} finished with hash {}\n", n_finished(rows), study::hash_of(rows));
  if (n_left > 0) print_out("{} specimens are left: phyllite study resume {}\n", n_left, shell_word(folder));
  if (shard.n > 1) print_out("when all parts are done: phyllite study merge {}\n", shell_word(folder));
  return n_bad + n_left > 0 ? 1 : 0;
}

/// All but rank 0: work for rank 0's store, write and print nothing.
int run_as_guest(const study::Plan& plan, const study::Ranks& ranks, const study::MachineOptions& machine) {
  // A collective call: without the guests rank 0 would wait for ever.
  ranks.sum(machine.threads);
  study::work_as_guest(ranks, plan, machine, *stop_on_interrupt());
  return 0;
}

int run_study(const study::Study& study, const jobs::StudyFiles& files, const StudyArguments& args,
              const std::string& folder, const Session& session) {
  const study::Shard shard = parse_shard(args.shard);
  // A dry run writes nothing and may look at a folder that others write to.
  if (!args.dry_run) jobs::check_study_outputs(files, folder, shard);
  jobs::refuse_other_study(study, folder);
  // Whole runs after parts: what parts have done already would be run again.
  if (shard.n == 1) jobs::refuse_unmerged(folder);
  std::optional<study::Ranks> ranks;
  if (args.mpi) ranks.emplace();
  const study::Plan plan = study::make_plan(study, shard);
  // Ranks may sit on machines with different copies of the study; test numbers would mean different tests.
  if (ranks) ranks->check_same(plan);
  if (ranks && ranks->rank() > 0) return args.dry_run ? 0 : run_as_guest(plan, *ranks, machine_of(session));
  const std::string file = jobs::store_file(folder, shard);
  if (args.dry_run) {
    study::StudyRows rows(plan.tests.size());
    // What an earlier run finished shortens the forecast.
    if (fs::exists(file)) rows = study::rows_of(plan, study::Store(file, study::Sharing::reading));
    print_plan(plan, rows, session);
    return 0;
  }
  stop_on_interrupt();
  const auto store = jobs::begin_study(files, folder, shard);
  print_plan(plan, study::rows_of(plan, *store), session);
  flush_out();
  const StudyRun run = run_plan(plan, *store, session, ranks ? &*ranks : nullptr);
  return finish_study(plan, *store, {folder, shard}, run, session);
}

/// The whole store of a study that has run.
study::Store store_in(const std::string& folder) {
  const std::string file = jobs::store_file(folder, {});
  if (!fs::exists(file))
    throw IoError(fmt::format("{}: has no store yet; phyllite study {} {}", file,
                              jobs::shards_in(folder).empty() ? "resume" : "merge", shell_word(folder)));
  return study::Store(file, study::Sharing::reading);
}

int status_of(const StudyArguments& args, const Session& session) {
  const study::Plan plan = study::make_plan(jobs::study_in(args.folder));
  const study::Store store = store_in(args.folder);
  const auto rows = study::rows_of(plan, store);
  print_plan(plan, rows, session);
  const std::size_t n_left = n_unfinished(plan, rows),
                    n_bad = print_failures(plan, rows, session.terminal_width);
  print_out("status    {} of {} finished, {} in flight, {} without an answer; hash {}\n", n_finished(rows),
            plan.tests.size(), store.n_claimed(), n_bad, study::hash_of(rows));
  return n_left + n_bad > 0 ? 1 : 0;
}

int export_study(const StudyArguments& args) {
  const study::Plan plan = study::make_plan(jobs::study_in(args.folder));
  if (!args.csv.empty()) io::check_outputs({args.csv}, "csv");
  const std::string text = study::study_csv(plan, study::rows_of(plan, store_in(args.folder)));
  if (args.csv.empty())
    write_out(text);
  else
    io::write_output(args.csv, text);
  return 0;
}

int effects_of_study(const StudyArguments& args, const Session& session) {
  const std::string folder = args.out.empty() ? args.folder : args.out;
  jobs::check_effects(folder);
  const study::Plan plan = study::make_plan(jobs::study_in(args.folder));
  study::StudyRows rows = study::rows_of(plan, store_in(args.folder));
  tell_versions(rows, session.terminal_width);
  // A copy in memory: the store keeps each test's own verdict.
  if (args.with_untrusted) rows = study::with_untrusted(std::move(rows));
  if (n_finished(rows) == 0)
    throw InputError(Problem{args.folder, "", "", "a study of which something is finished",
                             "`phyllite study resume " + shell_word(args.folder) + "`"});
  jobs::write_effects(plan, rows, folder);
  print_out("{}", study::effects_text(plan, rows, session.terminal_width));
  return 0;
}

int merge_stores(const StudyArguments& args, const Session& session) {
  std::vector<std::string> stores = args.stores;
  if (!fs::is_directory(args.folder))
    throw IoError(args.folder + ": is no folder; name the --out of `phyllite study`");
  if (stores.empty()) stores = jobs::shards_in(args.folder);
  // The first of two different rows stays: the order must not depend on the file system.
  std::sort(stores.begin(), stores.end());
  if (stores.empty())
    throw IoError(args.folder + ": holds no shard-*.sqlite; name the stores behind the folder");
  jobs::check_tables(args.folder, "");
  for (const std::string& name : stores)  // before the store is made
    if (!fs::exists(name)) throw IoError(name + ": cannot be read: no such file; check the name");
  study::Store store(jobs::store_file(args.folder, {}));
  std::size_t n_different = 0;
  for (const std::string& name : stores) {
    const study::MergeReport report = store.merge(name);
    print_out("{}: {} added, {} known\n", name, report.n_added, report.n_known);
    for (const std::string& key : report.different)
      print_out("  {} differs from the row that is there, which stays\n", key);
    // Equal keys with unequal results mean two versions or machines that do not agree: the user must know.
    n_different += report.different.size();
  }
  study::StudyRows rows = store.rows(store.keys());
  // Shards may be collected in a folder without the study, only to be joined.
  if (fs::exists(fs::path(args.folder) / "study.toml")) {
    const study::Plan plan = study::make_plan(jobs::study_in(args.folder));
    rows = study::rows_of(plan, store);
    report_tables(plan, rows, args.folder, session.terminal_width);
    if (const std::size_t n_left = n_unfinished(plan, rows); n_left > 0)
      print_out("{} specimens are left: run their parts, or phyllite study resume {}\n", n_left,
                shell_word(args.folder));
  }
  print_out("{} finished with hash {}\n", n_finished(rows), study::hash_of(rows));
  return n_different > 0 ? 1 : 0;
}

/// sbatch splits its #SBATCH lines at blanks: the name of the job is that of a folder.
std::string slurm_script(const StudyArguments& args, const std::string& folder, int threads) {
  for (const std::string& name : {args.study, folder})
    if (!is_plain(name))
      throw InputError(Problem{"command line", "--slurm", name, "names in UTF-8 without control characters",
                               "rename the file or choose another --out"});
  return fmt::format(
      "#!/bin/sh\n"
      "# Job array for Slurm: sbatch this file; when all parts are done: phyllite study merge {1}\n"
      "# A part that was cancelled or has run out of time goes on where it was when it is submitted again.\n"
      "#SBATCH --job-name={3}\n#SBATCH --array=1-{2}\n#SBATCH --ntasks=1\n#SBATCH --cpus-per-task={4}\n"
      "#SBATCH --time=02:00:00\n"
      "exec phyllite --threads \"$SLURM_CPUS_PER_TASK\" study {0} --out {1} "
      "--shard \"$SLURM_ARRAY_TASK_ID/{2}\"\n",
      sh_word(args.study), sh_word(folder), args.slurm, io::folder_name(fs::path(args.study).stem().string()),
      threads > 0 ? threads : 4);
}

/// Files of a study whose keys can be explained.
std::vector<const io::Schema*> files_of_keys() { return {&study::study_schema(), &io::regression_schema()}; }

int study_verb(const StudyArguments& args, const Session& session) {
  if (args.reference || !args.key.empty()) {
    const std::vector<const io::Schema*> files = files_of_keys();
    if (!args.key.empty()) return write_out(jobs::explain(files, args.key)), 0;
    for (const io::Schema* file : files) write_out("\n" + jobs::reference_markdown(*file));
    return 0;
  }
  if (args.study.empty())
    throw InputError(
        Problem{"command line", "STUDY", "", "a study file", "phyllite study --help shows all verbs"});
  const study::Study study = study::read_study(args.study);
  const std::string folder =
      args.out.empty() ? (fs::path("results") / fs::path(args.study).stem()).string() : args.out;
  if (args.slurm > 0) {
    print_out("{}", slurm_script(args, folder, session.threads));
    return 0;
  }
  return run_study(study, study::study_files(study), args, folder, session);
}

}  // namespace

/// Words and options in front of a verb that the verb has no use for.
void refuse_unused(const CLI::App& study, const CLI::App& verb) {
  const std::string name = "phyllite study " + verb.get_name();
  std::vector<Problem> problems;
  for (const CLI::Option* option : study.get_options()) {
    // A resumed study may be split and spread as a new one; nothing else of it can change.
    const bool used =
        verb.get_name() == "resume" &&
        (option->check_name("--shard") || option->check_name("--mpi") || option->check_name("--dry-run"));
    if (option->count() == 0 || used) continue;
    const std::string value = fmt::format("{}", fmt::join(option->results(), " "));
    if (option->get_positional())
      problems.push_back({"command line", "", value, "one folder after " + name, "run it per folder"});
    else
      problems.push_back({"command line", option->get_name(), value, "an option of " + name,
                          fmt::format("see `{} --help`", name)});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

void add_study_options(CLI::App& study, StudyArguments& args) {
  study.add_option("study", args.study, "study file (TOML)")->type_name("FILE");
  study.add_option("--out", args.out, "folder for the store and the table; default results/NAME")
      ->type_name("FOLDER");
  CLI::Option* shard =
      study.add_option("--shard", args.shard, "run part i of n only, i/n, into a store of its own");
  CLI::Option* mpi = study.add_flag("--mpi", args.mpi, "work on all ranks of mpirun; rank 0 keeps the store");
  CLI::Option* dry_run = study.add_flag("--dry-run", args.dry_run,
                                        "print the number of runs and the expected time, run nothing");
  study.add_option("--slurm", args.slurm, "print a job script that runs the study in N parts")
      ->check(CLI::Range(1, most_parts))
      ->excludes(shard)
      ->excludes(mpi)
      ->excludes(dry_run);
  study.add_option("--explain", args.key, "meaning, range and default of a key of a study file")
      ->type_name("KEY")
      ->check(suggested([] { return keys_of(files_of_keys()); }));
  study.add_flag("--reference", args.reference, "print all keys of a study file");
}

void add_study_command(CLI::App& app, Session& session) {
  auto args = std::make_shared<StudyArguments>();
  CLI::App* study = app.add_subcommand("study", "run many specimens: parameters, packings, angles");
  add_study_options(*study, *args);
  // `phyllite study FILE` runs without a verb, so none is required.
  study->require_subcommand(0, 1);
  const auto verb = [&](const char* name, const char* meaning) {
    CLI::App* sub = study->add_subcommand(name, meaning);
    sub->add_option("folder", args->folder, "folder of the study (its --out)")
        ->required()
        ->type_name("FOLDER");
    return sub;
  };
  CLI::App* status = verb("status", "finished, failed and remaining tests");
  CLI::App* resume = verb("resume", "run what is left");
  CLI::App* csv = verb("export", "the table of all specimens as CSV");
  csv->add_option("--csv", args->csv, "file to write; default: standard output")->type_name("FILE");
  CLI::App* effects = verb("effects", "curves, regressions and sensitivity indices of finished tests");
  effects->add_option("--out", args->out, "folder for responses.csv and effects.csv; default: the study's")
      ->type_name("FOLDER");
  effects->add_flag("--with-untrusted", args->with_untrusted,
                    "count tests that have a strength but are not to be trusted (docs/reliability.md)");
  CLI::App* merge = verb("merge", "join the stores of shards");
  merge->add_option("stores", args->stores, "stores to join; default: all shard-*.sqlite of the folder")
      ->type_name("FILE");
  study->callback([=, &session] {
    for (const CLI::App* chosen : study->get_subcommands()) refuse_unused(*study, *chosen);
    session.exit_code = *status    ? status_of(*args, session)
                        : *resume  ? run_study(jobs::study_in(args->folder), {}, *args, args->folder, session)
                        : *csv     ? export_study(*args)
                        : *effects ? effects_of_study(*args, session)
                        : *merge   ? merge_stores(*args, session)
                                   : study_verb(*args, session);
  });
}

}  // namespace phy::cli
