#include "jobs/calibration_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "base/check.hpp"
#include "base/hash.hpp"
#include "base/option.hpp"
#include "base/quote.hpp"
#include "base/version.hpp"
#include "calibrate/posterior_ensemble.hpp"
#include "io/file.hpp"
#include "io/load.hpp"
#include "io/output.hpp"
#include "io/store.hpp"
#include "io/toml_in.hpp"
#include "jobs/another_recipe.hpp"
#include "jobs/run_folder.hpp"
#include "jobs/study_folder.hpp"
#include "records/recipe_schema.hpp"
#include "records/specimen_record.hpp"
#include "report/calibration_files.hpp"
#include "report/calibration_tables.hpp"
#include "report/methods.hpp"
#include "report/pfc_commands.hpp"
#include "study/experiment.hpp"
#include "study/store.hpp"

namespace phy::jobs {

namespace fs = std::filesystem;

namespace {

calibrate::Effort effort_of(const CalibrationRequest& request) {
  const auto* const effort = std::find_if(calibrate::efforts.begin(), calibrate::efforts.end(),
                                          [&](const auto& e) { return e.name == request.effort; });
  PHY_CHECK(effort != calibrate::efforts.end(), "the list of options admits efforts alone");
  const std::string other = request.method == "sequence" ? option_set("method", "sequence")
                            : request.elastic            ? option_set("elastic")
                                                         : "";
  // Only an effort that was typed is refused; `auto` is what everybody has without asking.
  if (!other.empty() && effort->name != calibrate::auto_effort.name)
    throw InputError(option_problem("effort", request.effort, "none beside " + other,
                                    "an effort belongs to a search of strengths, which is not made there"));
  return *effort;
}

std::string hash_of_table(const Evidence& evidence) {
  Hash hash;
  for (const Target& t : evidence.targets) {
    hash.add(static_cast<int>(t.property)), hash.add(t.n), hash.add(t.sd_assumed);
    hash.add(t.theta), hash.add(t.mean), hash.add(t.sd), hash.add(t.diameter);
    // Only where confined: tables without this column keep their hash.
    if (t.confining > 0.0) hash.add(t.confining);
  }
  return hash.text();
}

/// Of the recipe, and of what the rock file says of table and model.
std::string hash_of_model(const Evidence& evidence) {
  const Rock& rock = evidence.rock;
  Hash hash;
  hash.add(rock.name);
  hash.add(keys_not_by_default(rock.model));
  hash.add(rock.bedded), hash.add(static_cast<int>(rock.E_is)), hash.add(static_cast<int>(rock.layers));
  // A matrix that is left open is another question than either of the two.
  hash.add(rock.matrix ? static_cast<int>(*rock.matrix) : -1);
  hash.add(evidence.compared.empty());
  return hash.text();
}

std::string path_of_request(const std::string& folder) { return (fs::path(folder) / request_file).string(); }

/// Throws InputError with the line where it is damaged.
std::optional<KeptRequest> kept_in(const std::string& folder) {
  const std::string file = path_of_request(folder);
  const auto text = io::read_if_file(file, largest_document);
  return text ? std::optional(read_kept(*text, file)) : std::nullopt;
}

/// Throws InputError where `wanted` would be written over another calibration.
void check_same(const KeptRequest& wanted) {
  const std::string& folder = wanted.request.out;
  const std::string afresh = "another " + option("out") + " begins afresh";
  const auto refuse = [&](const std::string& expected) {
    throw InputError(option_problem("out", folder, expected, afresh));
  };
  const auto begun = kept_in(folder);
  if (!begun) refuse(fmt::format("a folder that this version of phyllite began: it has no {}", request_file));
  // Options before table and model: they are the likelier slip, and each difference has a name.
  if (const auto problems = differences(wanted.request, begun->request); !problems.empty())
    throw InputError(problems);
  // Of table and model only hashes are kept, which cannot say what differs: name the rock at least.
  const std::string of = fmt::format("; it is of \"{}\" ({})", begun->name, begun->request.rock);
  if (wanted.table != begun->table) refuse("a folder begun with this table, read in the same way" + of);
  if (wanted.model != begun->model) refuse("a folder begun with this recipe and rock file" + of);
}

/// All that is written beside the store.
std::vector<std::string> files_in(const std::string& folder) {
  std::vector<std::string> files;
  for (const char* name : {request_file, "calibrated.toml", "calibrated.p2dat", "calibrated-yade.py",
                           "calibration.json", "tables.txt", "report.html"})
    files.push_back((fs::path(folder) / name).string());
  // All names of draws, though a calibration may leave fewer: how many is known only at its end.
  for (std::size_t k = 0; k < calibrate::ensemble_size; ++k) files.push_back(ensemble_file(folder, k));
  return files;
}

/// What a screen shows, with every detail.
std::string tables_of(const Calibration& c) {
  const std::string eq2 = report::eq2_table(c, 0);
  const std::string failure = report::failure_table(c, 0);
  // Width 0 breaks no line: the file is read in editors of any width.
  return fmt::format("{}\nDetails\n{}\n{}{}{}{}{}\nMethods\n{}\n\n{}", screen_of(c, 0),
                     report::macro_table(c, 0), failure, failure.empty() ? "" : "\n", eq2,
                     eq2.empty() ? "" : "\n", report::verdict_text(c, 0),
                     fmt::join(report::methods_text(c, phy::version), "\n"), report::sentence_text(c, 0));
}

}  // namespace

std::optional<CalibrationRequest> request_in(const std::string& folder) {
  try {
    auto kept = kept_in(folder);
    if (!kept) return {};
    kept->request.out = folder;
    return kept->request;
    // Asked by the page for every folder in sight; a damaged one must not hide the others.
  } catch (const InputError&) {
    return {};
  }
}

Rock with_matrix(Rock rock, const CalibrationRequest& request) {
  if (request.matrix.empty()) return rock;
  // The option goes before the rock file, even where it says `choose`.
  rock.matrix.reset();
  if (request.matrix != "choose")
    rock.matrix = request.matrix == "flat_joint" ? MatrixModel::flat_joint : MatrixModel::parallel_bond;
  // Both come from different places, so neither reader could see that they contradict.
  if (rock.matrix == MatrixModel::flat_joint && rock.bedded && of_parallel_bonds(rock.layers))
    throw InputError(
        option_problem("matrix", request.matrix, "parallel_bond or choose",
                       fmt::format("layers = \"{}\" (by the rock file or its recipe) are of parallel bonds",
                                   to_string(rock.layers))));
  return rock;
}

calibrate::CalibrationOptions options_of(const CalibrationRequest& request) {
  calibrate::CalibrationOptions options;
  options.effort = effort_of(request);
  if (request.method == "sequence") options.method = CalibrationMethod::sequence;
  options.elastic_only = request.elastic, options.max_tests = request.max_tests;
  return options;
}

std::string ensemble_file(const std::string& folder, std::size_t k) {
  // Two digits keep twenty draws in order in any list of files.
  return (fs::path(folder) / "ensemble" / fmt::format("{:02}.toml", k + 1)).string();
}

void check_calibration_outputs(const std::string& folder) {
  io::check_outputs(files_in(folder));
  io::check_writable(folder);
  // A killed run leaves half-written draws beside whole ones, under names of temporary files.
  io::remove_leftovers((fs::path(folder) / "ensemble").string());
}

BegunCalibration begin_calibration(const Evidence& evidence, const CalibrationRequest& request) {
  const KeptRequest kept{request, evidence.rock.name, hash_of_table(evidence), hash_of_model(evidence)};
  const fs::path folder(request.out);
  std::string store = (folder / "runs.sqlite").string();
  // A store without tests counts as none: a run stopped at once should not demand --resume.
  const bool begun =
      fs::exists(folder / "calibration.json") || (fs::exists(store) && study::Store(store).size() > 0);
  if (begun && request.resume) check_same(kept);  // what differs is named before a file that was changed
  check_calibration_outputs(request.out);
  if (begun && !request.resume)
    throw InputError(option_problem(
        "out", request.out, "a folder without an earlier calibration",
        fmt::format("{} goes on with it; another {} begins afresh", option_set("resume"), option("out"))));
  // Specimens without a calibration are somebody's runs: they would be shown as those of the calibrated rock.
  if (const std::string others = specimens_in(request.out); !begun && holds_results(others))
    throw InputError(
        option_problem("out", request.out, "a folder without " + others,
                       "results of before lie there: move them, or use another " + option("out")));
  if (std::optional<Problem> p = problem_of_page(request.out, PageOf::calibration); p && !begun)
    throw InputError(*std::move(p));
  // Before the first file is written: two processes would overwrite each other's request.
  FolderLock lock(request.out);
  // At the beginning, so that a calibration that is killed knows what it was asked for.
  io::write_output(path_of_request(request.out), kept_text(kept));
  return {std::move(store), begun, std::move(lock)};
}

std::string specimens_in(const std::string& folder) { return (fs::path(folder) / "specimens").string(); }

bool SpecimenFolder::holds(const Recipe& recipe) {
  const std::string place = (fs::path(folder_) / io::folder_name(specimen_names(recipe).front())).string();
  if (!fs::exists(place)) return false;
  try {
    // Read and thrown away: a damaged result shows here, and must not count as kept.
    io::read_result(place);
    if (const auto d = study::differences(io::read_result_recipe(place), recipe); !d.empty())
      throw InputError(
          problems_of(place, d, "as in the calibrated rock",
                      "a result of another recipe lies there: move it away, and " + option_set("resume")));
  } catch (const std::exception&) {
    // The first one alone: a full disk makes each later picture fail likewise.
    if (!problem_) problem_ = std::current_exception();
  }
  return true;
}

void SpecimenFolder::add(const Specimen& specimen, const Recipe& recipe, const TestResult& result) {
  try {
    io::write_result((fs::path(folder_) / io::folder_name(result.name)).string(), recipe, phy::version,
                     specimen, result);
  } catch (const std::exception&) {
    if (!problem_) problem_ = std::current_exception();
  }
}

std::string screen_of(const Calibration& c, int width) {
  return fmt::format("{}\n{}\n{}\n{}\n{}", report::sentence_text(c, width),
                     report::parameter_tables(c, width), report::angle_table(c, width),
                     report::error_table(c, width), report::budget_text(c, width));
}

void write_calibration(const std::string& folder, const Calibration& c) {
  const fs::path out(folder);
  io::write_output((out / "calibrated.toml").string(),
                   // As comments of TOML, so that the file stays a recipe for `phyllite run`.
                   report::recipe_comments(c) + io::write_recipe(c.recipe));
  for (std::size_t k = 0; k < c.ensemble.size(); ++k)
    io::write_output(ensemble_file(folder, k),
                     report::draw_comments(c, k + 1) + io::write_recipe(c.ensemble[k]));
  io::write_output((out / "calibrated.p2dat").string(), report::pfc_commands(c.recipe));
  io::write_output((out / "calibrated-yade.py").string(), report::yade_script(c.recipe));
  // Behind the recipe and the draws: whoever finds calibration.json may rely on them.
  io::write_output((out / "calibration.json").string(), report::calibration_json(c, phy::version));
  io::write_output((out / "tables.txt").string(), tables_of(c));
}

std::string progress_text(const calibrate::TestProgress& p, const TimeLeft& clock, double now) {
  return fmt::format("{}/{} tests, {}", p.n_done, p.n_total, clock.text(now));
}

}  // namespace phy::jobs
