// The folder of a run: what may stand in it before, and its page.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "records/result.hpp"
#include "study/experiment.hpp"

namespace phy::jobs {

/// Results of another recipe that already lie in a folder, each with the keys that differ: nothing may be put
/// beside them. What cannot be read is passed over.
std::vector<std::pair<std::string, std::vector<study::RecipeDifference>>> results_of_others(
    const std::string& folder, const Recipe& recipe);

/// A problem for all of them that differ alike. `path`: file of the recipe.
std::vector<Problem> problems_of_others(const std::string& folder, const Recipe& recipe,
                                        const std::string& path, const std::string& remedy);

/// Problems with a run and its folder before it begins; `replace`: results of another recipe will be removed.
/// Throws IoError where something else stands in the place of a result.
std::vector<Problem> run_folder_problems(const std::string& folder, const Recipe& recipe,
                                         const std::string& path, bool replace);

bool holds_results(const std::string& folder);

/// report.html in a folder.
std::string page_of(const std::string& folder);

/// Whose page a folder has: of a run, a study or a calibration.
enum class PageOf { run, study, calibration };

/// A folder has one page: the problem with one that has that of something else.
std::optional<Problem> problem_of_page(const std::string& folder, PageOf own);

/// One page for the whole folder, with results that stand there from before; tests that were interrupted now
/// are reported as missing.
void write_run_report(const std::string& folder, const std::vector<TestResult>& results);

/// Makes a folder for results; where nothing comes into it, it goes again.
struct ResultFolder {
  explicit ResultFolder(const std::string& folder);
  ResultFolder(const ResultFolder&) = delete;
  ResultFolder& operator=(const ResultFolder&) = delete;
  ~ResultFolder();
  std::filesystem::path path;
  bool is_new;
};

}  // namespace phy::jobs
