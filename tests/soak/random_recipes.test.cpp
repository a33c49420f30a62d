// A thousand recipes at random: each ends in a result or an outcome that is told, in files that can be read.
// PHY_RANDOM_RECIPES: how many; PHY_RANDOM_FIRST: number of the first; PHY_RANDOM_LOG: a file for a line
// each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <regex>

#include "../program.hpp"
#include "base/parallel.hpp"
#include "io/load.hpp"
#include "io/toml_in.hpp"
#include "random_recipe.hpp"
#include "setting.hpp"

namespace phy {
namespace {

namespace fs = std::filesystem;

class RandomRecipes : public ProgramTest {
 protected:
  std::mutex mutex_;
  std::map<std::string, int> counts_;

  /// What a recipe came to, in words; a failure of the test where it is not one of those that are allowed.
  std::string outcome_of(std::uint32_t number) {
    std::optional<Recipe> recipe = RandomRecipe(number).draw();
    if (!recipe) return "not drawn";
    const std::string place = at("r" + std::to_string(number)), file = place + ".toml", log = place + ".log";
    std::ofstream(file) << io::write_recipe(*recipe);
    const std::string line = "ulimit -t 120; " PHY_PROGRAM " --threads 1 run " + file + " --no-cache --out " +
                             place + " > " + log + " 2>&1";
    const int status = std::system(line.c_str());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    const std::string what = judge(code, place, read(log), *recipe);
    const std::string title = std::string(recipe->test.kind->name) + ", " + model_of(*recipe);
    const std::lock_guard lock(mutex_);
    ++counts_[title], ++counts_[what];
    if (what.starts_with("FAILED")) {
      ADD_FAILURE() << "recipe " << number << ": " << what << "\n" << read(log) << "\n" << read(file);
    }
    if (const std::string all = text_setting("PHY_RANDOM_LOG"); !all.empty())
      std::ofstream(all, std::ios::app) << number << ": " << title << ": " << what << "\n";
    for (const std::string& done : {place, file, log}) fs::remove_all(done);
    return what;
  }
  static std::string model_of(const Recipe& r) {
    if (r.matrix.model == MatrixModel::flat_joint) return "flat joints";
    return uneven_stiffness(r.matrix, r.bedding) ? "uneven bonds" : "bonds";
  }

  std::string judge(int code, const std::string& place, const std::string& log, const Recipe& recipe) {
    if (code == 2)
      return fs::exists(place) ? "FAILED: refused, and a folder is left" : "refused: " + reason(log);
    if (code > 1) return "FAILED: exit code " + std::to_string(code);
    try {
      const RunRecord run = io::read_run(place);
      if (!run.missing.empty()) return "FAILED: " + run.missing.front().name + run.missing.front().reason;
      if (run.tests.size() != specimen_names(recipe).size()) return "FAILED: specimens are missing";
      if (const std::string file = file_with_nan(place); !file.empty()) return "FAILED: no number in " + file;
      bool strong = true;
      for (const SpecimenRecord& t : run.tests) strong = strong && has_strength(t.result.outcome.status);
      if (strong != (code == 0)) return "FAILED: exit code " + std::to_string(code);
      return to_string(run.tests.front().result.outcome.status);
    } catch (const std::exception& e) {
      return std::string("FAILED: ") + e.what();
    }
  }
  /// What was expected, without the numbers, to count refusals that are alike.
  static std::string reason(const std::string& log) {
    const std::size_t at = log.find("expected ");
    return std::regex_replace(log.substr(at == log.npos ? 0 : at, 60), std::regex("[0-9.e+-]+|\n"), "#");
  }
  static std::string file_with_nan(const std::string& place) {
    for (const auto& entry : fs::recursive_directory_iterator(place)) {
      const std::string kind = entry.path().extension().string();
      const bool text = kind == ".csv" || kind == ".json" || kind == ".toml";
      if (text && has_no_number(read(entry.path()))) return entry.path().string();
    }
    return "";
  }
  /// "nan" or "inf" as a word.
  static bool has_no_number(const std::string& text) {
    const auto is_letter = [&](std::size_t i) {
      return i < text.size() && std::isalnum(static_cast<unsigned char>(text[i])) != 0;
    };
    for (const char* word : {"nan", "inf", "NaN", "Inf"})
      for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1))
        if (!is_letter(at + 3) && (at == 0 || !is_letter(at - 1))) return true;
    return false;
  }
};

TEST_F(RandomRecipes, EndInAResultOrAnOutcome) {
  const auto n = static_cast<std::size_t>(setting("PHY_RANDOM_RECIPES", 1000));
  const auto first = static_cast<std::uint32_t>(setting("PHY_RANDOM_FIRST", 1));
  for_all(n, 2, [&] { return [&](std::size_t i) { outcome_of(first + static_cast<std::uint32_t>(i)); }; });
  for (const auto& [what, count] : counts_) std::printf("%5d %s\n", count, what.c_str());
}

}  // namespace
}  // namespace phy
