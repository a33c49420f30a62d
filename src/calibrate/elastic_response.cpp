#include "calibrate/elastic_response.hpp"

#include <algorithm>

#include "base/stats.hpp"
#include "genesis/specimen.hpp"

namespace phy::calibrate {

void take_packing(Recipe& recipe, std::int64_t seed) {
  recipe.packing.seed = seed;
  const auto drawn = [](const BeddingRecipe& b) { return b.is_drawn(); };
  // Only then: another seed of the strengths would change specimens that need none, and all that is stored of
  // them.
  if (std::any_of(recipe.bedding.begin(), recipe.bedding.end(), drawn)) recipe.matrix.bond_seed = seed;
}

Recipe single_at(const Recipe& recipe, double theta, std::int64_t seed) {
  Recipe one = recipe;
  take_packing(one, seed);
  one.test.angles.clear();
  one.test.intact = false;
  // A specimen of the simulator stands as it is: the list of angles is gone, and its layers are turned here.
  if (layered(one)) genesis::turn_layers(one.matrix, one.bedding, theta);
  return one;
}

double reading_of(const ElasticResult& solution, Property property) {
  return property == Property::E ? solution.E_gauge : solution.nu_gauge;
}

Solutions solve_angles(const Recipe& recipe, const std::vector<Target>& moduli,
                       const std::vector<std::int64_t>& seeds, Statics what, Simulator& simulator) {
  Solutions at;
  for (const Target& t : moduli) at[t.theta];
  std::vector<Recipe> recipes;  // packing by packing: what a factorisation needs to know of one is made once
  for (const std::int64_t seed : seeds)
    for (const auto& [theta, none] : at) recipes.push_back(single_at(recipe, theta, seed));
  std::vector<ElasticResult> results = simulator.elastic(recipes, what);
  auto next = results.begin();
  for (std::size_t p = 0; p < seeds.size(); ++p)
    for (auto& [theta, solutions] : at) solutions.push_back(std::move(*next++));
  return at;
}

std::vector<Comparison> over_packings(const Solutions& solutions, const std::vector<Target>& moduli) {
  std::vector<Comparison> rows;
  for (const Target& t : moduli) {
    std::vector<double> values;
    for (const ElasticResult& r : solutions.at(t.theta)) values.push_back(reading_of(r, t.property));
    const Summary s = summarise(values);
    Comparison c;
    c.target = t, c.mean = s.mean, c.sd = s.sd, c.n_packings = static_cast<int>(values.size());
    rows.push_back(c);
  }
  return rows;
}

std::vector<Comparison> elastic_response(const Recipe& recipe, const std::vector<Target>& moduli,
                                         const std::vector<std::int64_t>& seeds, Simulator& simulator) {
  return over_packings(solve_angles(recipe, moduli, seeds, Statics::one_sided, simulator), moduli);
}

}  // namespace phy::calibrate
