#include "study/design.hpp"

#include <algorithm>
#include <boost/random/sobol.hpp>
#include <cmath>
#include <numeric>

#include "base/check.hpp"
#include "base/rng.hpp"
#include "study/experiment.hpp"

namespace phy::study {
namespace {

/// Random numbers of a study: a dimension and a running number.
double draw(const Study& study, std::size_t dimension, std::size_t i) {
  return uniform(static_cast<std::uint32_t>(study.seed), Stream::design,
                 static_cast<std::uint32_t>(dimension), static_cast<std::uint32_t>(i));
}

/// 0 ... n - 1 in random order (Fisher and Yates).
std::vector<std::size_t> shuffled(const Study& study, std::size_t dimension, std::size_t n) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = n; i > 1; --i)
    // Counts down, so that every draw picks among the positions that are not yet settled.
    std::swap(order[i - 1],
              order[static_cast<std::size_t>(draw(study, dimension, i) * static_cast<double>(i))]);
  return order;
}

Point from_unit(const Study& study, const std::vector<double>& u) {
  Point p;
  for (std::size_t k = 0; k < study.vary.size(); ++k) p.values.push_back(study.vary[k].at(u[k]));
  return p;
}

std::vector<Point> one_at_a_time(const Study& study) {
  Point base;
  for (const Factor& f : study.vary) base.values.push_back(f.key.get(study.base));
  std::vector<Point> points = {base};
  for (std::size_t k = 0; k < study.vary.size(); ++k)
    for (const double level : study.vary[k].levels) {
      // The base is the first point already, and serves all parameters.
      if (level == base.values[k]) continue;
      points.push_back(base);
      points.back().values[k] = level;
      points.back().moved = static_cast<int>(k);
    }
  return points;
}

std::vector<Point> full_factorial(const Study& study) {
  std::vector<Point> points(1);
  // The product of levels, one factor at a time; the last factor runs fastest.
  for (const Factor& f : study.vary) {
    std::vector<Point> longer;
    for (const Point& p : points)
      for (const double level : f.levels) {
        longer.push_back(p);
        longer.back().values.push_back(level);
      }
    points = std::move(longer);
  }
  return points;
}

std::vector<Point> latin_hypercube(const Study& study) {
  const auto n = static_cast<std::size_t>(study.samples);
  std::vector<std::vector<double>> u(n, std::vector<double>(study.vary.size()));
  for (std::size_t k = 0; k < study.vary.size(); ++k) {
    // Two dimensions of random numbers per factor: the order of slices, and the place within a slice.
    const std::vector<std::size_t> slice = shuffled(study, 2 * k, n);
    for (std::size_t i = 0; i < n; ++i)
      u[i][k] = (static_cast<double>(slice[i]) + draw(study, 2 * k + 1, i)) / static_cast<double>(n);
  }
  std::vector<Point> points;
  for (const auto& x : u) points.push_back(from_unit(study, x));
  return points;
}

std::vector<Point> sobol(const Study& study) {
  std::vector<Point> points;
  for (const auto& u : sobol_sequence(study.vary.size(), static_cast<std::size_t>(study.samples)))
    points.push_back(from_unit(study, u));
  return points;
}

/// Blocks of k + 2 points: A, then A with one coordinate of B each, then B.
std::vector<Point> saltelli(const Study& study) {
  const std::size_t k = study.vary.size();
  std::vector<Point> points;
  // One sequence of 2k dimensions: A and B come from different coordinates, so they are independent.
  for (const auto& u : sobol_sequence(2 * k, static_cast<std::size_t>(study.samples))) {
    const std::vector<double> a(u.begin(), u.begin() + static_cast<std::ptrdiff_t>(k)),
        b(u.begin() + static_cast<std::ptrdiff_t>(k), u.end());
    points.push_back(from_unit(study, a));
    for (std::size_t i = 0; i < k; ++i) {
      std::vector<double> mixed = a;
      mixed[i] = b[i];
      points.push_back(from_unit(study, mixed));
    }
    points.push_back(from_unit(study, b));
  }
  return points;
}

Point on_grid(const Study& study, const std::vector<int>& levels) {
  // The lowest level is 0, the highest 1.
  std::vector<double> u;
  for (const int level : levels) u.push_back(static_cast<double>(level) / (morris_levels - 1));
  return from_unit(study, u);
}

std::vector<Point> morris(const Study& study) {
  const std::size_t k = study.vary.size();
  std::vector<Point> points;
  for (std::size_t walk = 0; walk < static_cast<std::size_t>(study.samples); ++walk) {
    std::vector<int> levels(k);  // whole numbers: the same level is the same value to the last bit
    for (std::size_t i = 0; i < k; ++i)
      levels[i] = static_cast<int>(draw(study, 2 * i, walk) * morris_levels);
    points.push_back(on_grid(study, levels));
    // A shuffle of its own for every walk: draw() has no index left for the walk.
    Study turn = study;
    turn.seed = study.seed + static_cast<std::int64_t>(walk);
    for (const std::size_t i : shuffled(turn, 2 * k + 1, k)) {
      // Half the grid up or down, whichever stays inside.
      levels[i] += levels[i] < morris_jump ? morris_jump : -morris_jump;
      points.push_back(on_grid(study, levels));
      points.back().moved = static_cast<int>(i);
    }
  }
  return points;
}

}  // namespace

std::vector<std::vector<double>> sobol_sequence(std::size_t dimensions, std::size_t n) {
  boost::random::sobol engine(dimensions);
  // Boost begins behind the origin and returns whole numbers up to `range`, included; + 1 keeps u below 1.
  const auto range = static_cast<double>(boost::random::sobol::max());
  std::vector<std::vector<double>> u(n, std::vector<double>(dimensions));
  for (auto& x : u)
    for (double& v : x) v = static_cast<double>(engine()) / (range + 1.0);
  return u;
}

const char* to_string(Solver solver) { return solver == Solver::direct ? "direct" : "dynamic"; }

const char* to_string(Design design) {
  static constexpr const char* names[n_designs] = {
      "one_at_a_time", "full_factorial", "list", "latin_hypercube", "sobol", "morris", "saltelli"};
  return names[static_cast<int>(design)];
}

std::string RecipeKey::path() const {
  return set < 0 ? field->path() : "bedding[" + std::to_string(set) + "]." + field->key;
}

std::string RecipeKey::unit() const { return inner_unit(field->dimension); }

double RecipeKey::get(const Recipe& recipe) const {
  return field->get(recipe, static_cast<std::size_t>(std::max(set, 0)));
}

void RecipeKey::put(Recipe& recipe, double value) const {
  // A key of one set, or of a table that exists once; else all bedding sets alike.
  if (field->table != "bedding" || set >= 0)
    return field->set(recipe, static_cast<std::size_t>(std::max(set, 0)), value);
  for (std::size_t i = 0; i < recipe.bedding.size(); ++i) field->set(recipe, i, value);
}

std::string RecipeKey::print(double value) const {
  // The printers of the recipe take a recipe: a scratch one with a single bedding set.
  Recipe r;
  r.bedding.resize(1);
  field->set(r, 0, value);
  std::string text = print_field(*field, r, 0);
  text.erase(std::remove(text.begin(), text.end(), '"'), text.end());
  return text;
}

double Factor::at(double u) const {
  if (!levels.empty()) {
    // Equal shares of [0, 1] for the levels; u = 1 belongs to the last.
    const auto i = static_cast<std::size_t>(u * static_cast<double>(levels.size()));
    return levels[std::min(i, levels.size() - 1)];
  }
  // On a logarithmic scale equal steps of u are equal factors.
  const double value = logarithmic ? from * std::pow(to / from, u) : from + u * (to - from);
  return key.field->kind == FieldKind::integer ? std::round(value) : value;
}

std::vector<Point> points_of(const Study& study) {
  if (study.vary.empty()) return {Point{}};
  switch (study.design) {
    case Design::one_at_a_time: return one_at_a_time(study);
    case Design::full_factorial: return full_factorial(study);
    case Design::latin_hypercube: return latin_hypercube(study);
    case Design::sobol: return sobol(study);
    case Design::morris: return morris(study);
    case Design::saltelli: return saltelli(study);
    case Design::list: break;
  }
  // A list has no base that its points are off.
  std::vector<Point> points;
  for (const auto& row : study.rows) points.push_back({row, -1});
  return points;
}

Recipe recipe_at(const Study& study, const Point& point, std::int64_t packing, std::int64_t bond_seed) {
  Recipe r = study.base;
  r.packing.seed = packing;
  r.matrix.bond_seed = bond_seed;
  for (std::size_t k = 0; k < study.vary.size(); ++k) study.vary[k].key.put(r, point.values[k]);
  return r;
}

std::vector<Recipe> specimens_of(const Study& study, const Recipe& recipe) {
  std::vector<Recipe> singles = single_recipes(recipe);
  for (const ByAngle& entry : study.by_angle) {
    PHY_CHECK(entry.values.size() == singles.size(), "a value for each specimen");
    for (std::size_t i = 0; i < singles.size(); ++i) entry.key.put(singles[i], entry.values[i]);
  }
  return singles;
}

std::string describe(const Study& study, const Point& point) {
  std::string text;
  for (std::size_t k = 0; k < study.vary.size(); ++k)
    text += (text.empty() ? "" : ", ") + study.vary[k].key.path() + " = " +
            study.vary[k].key.print(point.values[k]);
  return text;
}

}  // namespace phy::study
