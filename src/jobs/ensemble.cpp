#include "jobs/ensemble.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/check.hpp"
#include "io/file.hpp"
#include "io/toml_in.hpp"
#include "jobs/calibration_folder.hpp"
#include "report/calibration_files.hpp"

namespace phy::jobs {

namespace fs = std::filesystem;

std::vector<Recipe> read_draws(const std::string& path, const Recipe& recipe, const std::string& asked) {
  const std::string folder = fs::path(path).parent_path().string();
  std::vector<Recipe> draws;
  // By number until one is missing, so that draw k is draw k of the discrepancy, too.
  for (std::string file; fs::exists(file = ensemble_file(folder, draws.size()));) {
    draws.push_back(io::read_recipe(file));
    // The draws differ in the rock alone: test and engine are those of the file that was named.
    draws.back().test = recipe.test, draws.back().engine = recipe.engine;
    draws.back().test.n_snapshots = draws.back().test.n_frames = 0;  // the store keeps no pictures
  }
  std::size_t n_files = 0;
  std::error_code none;
  // A gap in the numbers ends the loop above: files beyond it would be left out unseen.
  for (const auto& entry : fs::directory_iterator(fs::path(ensemble_file(folder, 0)).parent_path(), none))
    n_files += entry.path().extension() == ".toml" ? 1 : 0;
  if (n_files > draws.size())
    throw InputError(Problem{
        path, asked, fmt::format("{} files", n_files),
        "draws that are numbered without a gap, " + ensemble_file(folder, draws.size()) + " among them",
        "a band of some of the draws is another one: bring the file back"});
  if (draws.size() < fewest_draws)
    throw InputError(Problem{
        path, asked, "", "the draws of a calibration beside it, " + ensemble_file(folder, 0) + " and so on",
        "give calibrated.toml in the folder where `phyllite calibrate` has left it; one of before "
        "this version, "
        "or by --method sequence, has no draws"});
  return draws;
}

std::optional<calibrate::Discrepancy> read_discrepancy(const std::string& path, std::size_t n_draws) {
  // The residuals come from the calibration's own file: recomputing them would take all of its tests again.
  const std::string file = (fs::path(path).parent_path() / "calibration.json").string();
  const auto text = io::read_if_file(file, largest_document);
  if (!text) return {};
  calibrate::Discrepancy discrepancy(report::comparisons_of(*text, file).residuals);
  // A draw without its residuals could have no band of the rock, and a band of the others is another one.
  if (discrepancy.n_draws() < n_draws) return {};
  return discrepancy;
}

}  // namespace phy::jobs
