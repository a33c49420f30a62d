// A thousand recipes at random: each ends in a result or an outcome that is told, in files that can be read.
// And of a hundred that have a UCS or a direct tensile strength: one that is farther from its slow reference
// than docs/reliability.md says of a good test carries a mark. PHY_RANDOM_RECIPES, PHY_RANDOM_REFERENCES: how
// many; PHY_RANDOM_FIRST: number of the first; PHY_RANDOM_LOG: a file for a line each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <regex>

#include "../program.hpp"
#include "base/nan.hpp"
#include "base/parallel.hpp"
#include "io/load.hpp"
#include "io/toml_in.hpp"
#include "random_recipe.hpp"
#include "records/quality.hpp"
#include "setting.hpp"

namespace phy {
namespace {

namespace fs = std::filesystem;

class RandomRecipes : public ProgramTest {
 protected:
  std::mutex mutex_;
  std::map<std::string, int> counts_;

  /// Runs a recipe into PLACE, with PLACE.toml and PLACE.log beside. The exit code; 128 + signal.
  static int press(const Recipe& recipe, const std::string& place) {
    std::ofstream(place + ".toml") << io::write_recipe(recipe);
    const std::string line = "ulimit -t 120; " PHY_PROGRAM " --threads 1 run " + place +
                             ".toml --no-cache --out " + place + " > " + place + ".log 2>&1";
    const int status = std::system(line.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  static void discard(const std::string& place) {
    for (const char* end : {"", ".toml", ".log"}) fs::remove_all(place + end);
  }

  /// What a recipe came to, in words; a failure of the test where it is not one of those that are allowed.
  std::string outcome_of(std::uint32_t number) {
    std::optional<Recipe> recipe = RandomRecipe(number).draw();
    if (!recipe) return "not drawn";
    const std::string place = at("r" + std::to_string(number));
    const int code = press(*recipe, place);
    const std::string log = read(place + ".log"), what = judge(code, place, log, *recipe);
    const std::string title = std::string(recipe->test.kind->name) + ", " + model_of(*recipe);
    const std::lock_guard lock(mutex_);
    ++counts_[title], ++counts_[what];
    if (what.starts_with("FAILED")) {
      ADD_FAILURE() << "recipe " << number << ": " << what << "\n" << log << "\n" << read(place + ".toml");
    }
    if (const std::string all = text_setting("PHY_RANDOM_LOG"); !all.empty())
      std::ofstream(all, std::ios::app) << number << ": " << title << ": " << what << "\n";
    discard(place);
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

/// Largest error of a strength that docs/reliability.md has of a good test.
double published_error(const Recipe& recipe) {
  return recipe.test.kind->name == std::string("uniaxial") ? 0.11 : 0.04;
}

class References : public RandomRecipes {
 protected:
  struct Found {
    std::uint32_t number = 0;
    double error = nan;  ///< of the strength
    Grade grade = Grade::unknown;
    std::string what;  ///< in words
  };

  /// The first specimen with a strength, or that of a name.
  static std::optional<SpecimenRecord> first_strength(const Recipe& recipe, const std::string& place,
                                                      const std::string& name = "") {
    std::optional<SpecimenRecord> found;
    if (press(recipe, place) <= 1)
      for (SpecimenRecord& t : io::read_run(place).tests)
        if (!found && has_strength(t.result.outcome.status) && (name.empty() || t.result.name == name))
          found = std::move(t);
    discard(place);
    return found;
  }
  static double number_of(const SpecimenRecord& t, const std::string& name) {
    for (const Number& n : t.result.numbers)
      if (n.name == name) return n.value;
    return nan;
  }
  /// The same specimen pressed as slowly as 300 crossings of a wave take, at most thirty times as slowly, and
  /// seen to the end of its fall.
  static Recipe slow(Recipe r, const SpecimenRecord& fast) {
    r.test.platen_speed *= std::clamp(number_of(fast, "wave_transits") / 300.0, 1.0 / 30.0, 1.0);
    r.test.ramp_strain = std::min(r.test.ramp_strain, 2e-5), r.test.pre_strain = 0.0;
    r.test.stop_at = 0.6, r.test.post_peak = 1.0, r.test.max_strain = std::max(r.test.max_strain, 0.1);
    r.test.history_interval = 100, r.engine.damping = 0.7, r.engine.precision = Precision::double_precision;
    r.engine.step_safety = std::min(r.engine.step_safety, 0.92);
    return r;
  }
  /// The recipe of that number against its slow reference; nothing where it has no strength of these kinds.
  std::optional<Found> compared(std::uint32_t number) {
    std::optional<Recipe> recipe = RandomRecipe(number).draw();
    if (!recipe) return {};
    const std::string kind = recipe->test.kind->name, place = at("s" + std::to_string(number));
    if (kind != "uniaxial" && kind != "direct_tension") return {};
    const std::optional<SpecimenRecord> fast = first_strength(*recipe, place);
    if (!fast) return {};
    Found found{number, nan, grade_of(fast->result), kind};
    const std::optional<SpecimenRecord> well = first_strength(slow(*recipe, *fast), place, fast->result.name);
    if (!well) {
      found.what += ": the reference has no strength";
      return found;
    }
    found.error = fast->result.numbers.front().value / well->result.numbers.front().value - 1.0;
    if (well->result.outcome.status != fast->result.outcome.status) found.what += ", another outcome";
    if (std::fabs(found.error) > published_error(*recipe)) found.what += ", off";
    return found;
  }
};

TEST_F(References, WhatIsOffByMoreThanAGoodTestIsMarked) {
  const auto n = static_cast<std::size_t>(setting("PHY_RANDOM_REFERENCES", 100));
  const auto first = static_cast<std::uint32_t>(setting("PHY_RANDOM_FIRST", 1));
  std::vector<Found> all(n);
  for_all(n, 2, [&] {
    return [&](std::size_t i) {
      for (std::size_t k = i; all[i].number == 0; k += n)
        if (const std::optional<Found> found = compared(first + static_cast<std::uint32_t>(k)))
          all[i] = *found;
    };
  });
  std::map<std::string, int> counts;
  for (const Found& f : all) {
    ++counts[std::string(to_string(f.grade)) + ": " + f.what];
    std::printf("%6u %-10s %7.1f %%  %s\n", f.number, to_string(f.grade), 100.0 * f.error, f.what.c_str());
    EXPECT_FALSE(f.grade == Grade::good && f.what.ends_with(", off"))
        << "recipe " << f.number << ":\n"
        << io::write_recipe(*RandomRecipe(f.number).draw());
  }
  for (const auto& [what, count] : counts) std::printf("%5d %s\n", count, what.c_str());
}

}  // namespace
}  // namespace phy
