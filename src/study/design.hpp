// What a study varies, and the points that it visits.
//
//   one_at_a_time     every parameter through its levels, the others at their base
//   full_factorial    every combination of levels
//   list              the rows of a CSV table
//   latin_hypercube   `samples` points, every parameter once in each of `samples` equal slices
//                     (McKay, Beckman & Conover 1979, Technometrics 21:239-245)
//   sobol             the first `samples` points of Sobol's sequence without its origin (Boost, direction
//                     numbers of Joe & Kuo 2008): fills the space evenly, can be prolonged
//   morris            `samples` random walks through a grid of four levels, one parameter a step: elementary
//                     effects for screening (Morris 1991, Technometrics 33:161-174)
//   saltelli          `samples` (k + 2) points for Sobol's variance indices of k parameters (Saltelli et al.
//                     2010, Computer Physics Communications 181:259-270)
//
// Every point is run on every packing seed and every bond seed: replicates, over which means and intervals
// are taken. All random choices depend on `seed` alone.
#pragma once
#include <string>
#include <vector>

#include "records/recipe.hpp"
#include "records/recipe_schema.hpp"
#include "records/variation.hpp"

namespace phy::study {

/// How a specimen is answered: by its test in time, or by the direct elastic solution (study/direct.hpp).
enum class Solver { dynamic, direct };
const char* to_string(Solver solver);
enum class Design { one_at_a_time, full_factorial, list, latin_hypercube, sobol, morris, saltelli };
constexpr int n_designs = 7;
/// Of morris: p levels and a step of p / 2 of them, so that each is reached equally often; in parts of the
/// range the step is p / (2 (p - 1)).
constexpr int morris_levels = 4, morris_jump = morris_levels / 2;
constexpr double morris_step = static_cast<double>(morris_jump) / (morris_levels - 1);
const char* to_string(Design design);

/// A key of the recipe; of the bedding either one set or all sets alike.
struct RecipeKey {
  const Field* field = nullptr;
  int set = -1;  ///< bedding set, -1: all

  std::string path() const;                      ///< "bedding.k_n", "bedding[1].k_n"
  std::string unit() const;                      ///< of the values: "Pa/m", "1"
  double get(const Recipe& recipe) const;        ///< of all sets: the first
  void put(Recipe& recipe, double value) const;  ///< choices and booleans by their place in the list
  std::string print(double value) const;         ///< as in a file, without quotes: "3360 GPa/m", "zone"
};

/// One varied parameter: a list of levels, or a range.
struct Factor {
  RecipeKey key;
  std::vector<double> levels;  ///< in the order given; empty: the range counts
  double from = 0.0, to = 0.0;
  bool logarithmic = false;

  /// The value at u in [0, 1]: along the range, or the level in whose equal share u falls. Whole-numbered
  /// keys are rounded.
  double at(double u) const;
};

/// A key of [test] with a value for each specimen of a point: those of test.angles, then the intact one.
struct ByAngle {
  RecipeKey key;
  std::vector<double> values;
};

struct Study {
  std::string name;
  Recipe base;
  Solver solver = Solver::dynamic;
  Design design = Design::one_at_a_time;
  std::vector<Factor> vary;
  std::vector<ByAngle> by_angle;
  std::vector<std::vector<double>> rows;  ///< of the list design
  std::int64_t samples = 64;
  std::int64_t seed = 1;
  std::vector<std::int64_t> packings;    ///< packing seeds; at least one
  std::vector<std::int64_t> bond_seeds;  ///< at least one
  std::vector<Regression> regressions;   ///< of others, to be held against its own
};

/// One setting of all varied parameters, in the order of Study::vary.
struct Point {
  std::vector<double> values;
  int moved = -1;  ///< one_at_a_time: the parameter off its base, -1 at the base; morris: moved by this step
};

std::vector<Point> points_of(const Study& study);

/// The first n points of Sobol's sequence in [0, 1)^dimensions without its origin.
std::vector<std::vector<double>> sobol_sequence(std::size_t dimensions, std::size_t n);

/// Packings times bond seeds.
inline std::size_t n_replicates(const Study& study) {
  return study.packings.size() * study.bond_seeds.size();
}

/// The base recipe at a point, on one packing and bond seed.
Recipe recipe_at(const Study& study, const Point& point, std::int64_t packing, std::int64_t bond_seed);

/// The specimens of a recipe of the study (single_recipes), each with its values of Study::by_angle.
std::vector<Recipe> specimens_of(const Study& study, const Recipe& recipe);

/// "bedding.k_n = 840 GPa/m, bedding.mu = 0.4"; empty if nothing varies.
std::string describe(const Study& study, const Point& point);

}  // namespace phy::study
