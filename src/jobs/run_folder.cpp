#include "jobs/run_folder.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "base/option.hpp"
#include "base/units.hpp"
#include "io/load.hpp"
#include "io/output.hpp"
#include "io/store.hpp"
#include "jobs/another_recipe.hpp"
#include "jobs/calibration_options.hpp"
#include "records/test_description.hpp"
#include "report/page.hpp"

namespace phy::jobs {
namespace {

/// Stresses that another kind of test keeps. A recipe that was stored, or whose kind a study varies, may hold
/// them; of one that is run they are a mistake.
std::vector<Problem> idle_stresses(const Recipe& recipe, const std::string& path) {
  std::vector<Problem> problems;
  const TestKind& kind = recipe.test.kind;
  for (const TestDescription* other : laboratory_tests())
    if (const KeptStress& stress = other->kept_stress;
        // The default is 0, so that a positive value was typed, for a test that is not run.
        stress.value != nullptr && other != &*kind && recipe.test.*stress.value > 0.0)
      problems.push_back(
          {path, std::string("test.") + stress.key,
           print_quantity(recipe.test.*stress.value, Dimension::pressure),
           fmt::format("0 with kind = \"{}\"", kind->name),
           fmt::format("leave it out with what belongs to it, or set kind = \"{}\"", other->name)});
  return problems;
}

}  // namespace

std::vector<std::pair<std::string, std::vector<study::RecipeDifference>>> results_of_others(
    const std::string& folder, const Recipe& recipe) {
  std::vector<std::pair<std::string, std::vector<study::RecipeDifference>>> others;
  std::error_code none;
  // A folder that is still to be made holds nothing.
  if (!std::filesystem::is_directory(folder, none)) return others;
  for (const std::string& result : io::result_folders(folder)) {
    try {
      if (auto d = study::differences(io::read_result_recipe(result), recipe); !d.empty())
        others.emplace_back(result, std::move(d));
    } catch (const InputError&) {  // unreadable: `show` and `report` say so, and a run mends it
    } catch (const IoError&) {
    }
  }
  return others;
}

std::vector<Problem> problems_of_others(const std::string& folder, const Recipe& recipe,
                                        const std::string& path, const std::string& remedy) {
  std::vector<Problem> problems;
  const auto alike = [](const std::vector<study::RecipeDifference>& differences) {
    std::string text;
    for (const study::RecipeDifference& d : differences) text += d.key + " " + d.one + "\n";
    return text;
  };
  // Those that differ alike are reported together, of several recipes a key each.
  std::map<std::string, int> n_alike;
  const auto others = results_of_others(folder, recipe);
  for (const auto& [result, differences] : others) ++n_alike[alike(differences)];
  const bool of_one_recipe = n_alike.size() == 1;
  for (const auto& [result, differences] : others) {
    // The first of a group reports for all; the zero left behind silences the others.
    const int n = std::exchange(n_alike[alike(differences)], 0);
    if (n == 0) continue;
    const std::string where = n == 1 ? result : folder + " (" + std::to_string(n) + " results)";
    const std::vector<study::RecipeDifference> first = {differences.front()};
    for (Problem& p : problems_of(where, of_one_recipe ? differences : first, "as in " + path,
                                  "the folder holds results of another recipe: " + remedy))
      problems.push_back(std::move(p));
  }
  return problems;
}

std::vector<Problem> run_folder_problems(const std::string& folder, const Recipe& recipe,
                                         const std::string& path, bool replace) {
  std::vector<Problem> problems = idle_stresses(recipe, path);
  if (std::optional<Problem> p = problem_of_page(folder, PageOf::run)) problems.push_back(*std::move(p));
  // A folder of something else is not searched further: each result in it would be another problem.
  if (!problems.empty()) return problems;
  for (const std::string& name : specimen_names(recipe))
    io::check_result_place((std::filesystem::path(folder) / io::folder_name(name)).string());
  if (!replace)
    return problems_of_others(folder, recipe, path,
                              fmt::format("use another {}, or {} to remove them when the run begins",
                                          option("out"), option_set("replace")));
  // --replace removes these: what cannot be removed must show before hours of tests.
  for (const auto& [other, differences] : results_of_others(folder, recipe)) io::check_result_place(other);
  return {};
}

bool holds_results(const std::string& folder) {
  std::error_code none;
  return std::filesystem::is_directory(folder, none) && !io::result_folders(folder).empty();
}

std::optional<Problem> problem_of_page(const std::string& folder, PageOf own) {
  const auto has = [&](const char* file) {
    return std::filesystem::exists(std::filesystem::path(folder) / file);
  };
  const auto problem = [&](const char* what) {
    const char* own_name = own == PageOf::run ? "a run" : own == PageOf::study ? "a study" : "a calibration";
    return option_problem(
        "out", folder, "",
        fmt::format("it holds {}, and {} would overwrite its report.html. Choose another {}", what, own_name,
                    option("out")));
  };
  // request.toml too: a calibration that has just begun has no result yet.
  if (own != PageOf::calibration && (has("calibration.json") || has(request_file)))
    return problem("a calibration");
  if (own != PageOf::study && has("study.toml")) return problem("a study");
  if (own != PageOf::run && holds_results(folder)) return problem("the results of a run");
  return {};
}

std::string page_of(const std::string& folder) {
  return (std::filesystem::path(folder) / "report.html").string();
}

void write_run_report(const std::string& folder, const std::vector<TestResult>& results) {
  // Read from disk again, so that the page has the tests of earlier runs in this folder, too.
  RunRecord run = holds_results(folder) ? io::read_run(folder) : RunRecord();
  for (const TestResult& r : results) {
    if (r.outcome.status != Status::interrupted) continue;
    const std::string name = io::folder_name(r.name);
    // An older, unreadable folder of this name is reported once, by the newer reason.
    std::erase_if(run.missing,
                  [&](const MissingTest& m) { return std::filesystem::path(m.name).filename() == name; });
    run.missing.push_back({r.name, r.outcome.reason + "; " + r.outcome.advice});
  }
  io::write_output(page_of(folder), report::report_page(run));
}

ResultFolder::ResultFolder(const std::string& folder)
    : path(folder), is_new(!std::filesystem::exists(folder)) {
  io::check_writable(folder);
}

ResultFolder::~ResultFolder() {
  // remove() takes empty folders alone: its failure is the wanted outcome.
  std::error_code not_empty;
  if (is_new) std::filesystem::remove(path, not_empty);
}

}  // namespace phy::jobs
