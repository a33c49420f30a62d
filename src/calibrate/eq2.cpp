#include "calibrate/eq2.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "base/stats.hpp"
#include "calibrate/elastic_response.hpp"
#include "theory/eq1_fit.hpp"

namespace phy::calibrate {
namespace {

constexpr std::array eq2_angles = {0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 90.0};
// The relation bends: three places show slope and curvature near the calibrated stiffness.
constexpr std::array joint_factors = {0.5, 2.0};  // on the stiffness of the joints, beside 1
constexpr std::array unsure = {0.7, 1.4};         // about what a spacing or a thickness is known to

struct Setting {
  std::string name;
  Recipe recipe;
};
std::vector<Setting> settings_of(const Recipe& recipe) {
  std::vector<Setting> all = {{"as calibrated", recipe}};
  const auto with = [&](std::string name, auto change) {
    all.push_back({std::move(name), recipe});
    change(all.back().recipe.bedding.front());
  };
  for (const double f : unsure)
    with(fmt::format("spacing x {:g}", f), [f](BeddingRecipe& b) { b.spacing *= f; });
  if (recipe.bedding.front().rule != BeddingRule::zone)
    with(fmt::format("rule zone, thickness {:g} mm", recipe.bedding.front().zone_thickness * 1e3),
         [](BeddingRecipe& b) { b.rule = BeddingRule::zone; });
  if (recipe.bedding.front().rule != BeddingRule::crossing)
    with("rule crossing", [](BeddingRecipe& b) { b.rule = BeddingRule::crossing; });
  if (recipe.bedding.front().rule == BeddingRule::zone)
    for (const double f : unsure)
      with(fmt::format("zone thickness x {:g}", f), [f](BeddingRecipe& b) { b.zone_thickness *= f; });
  std::erase_if(all, [](const Setting& s) {
    const BeddingRecipe& b = s.recipe.bedding.front();
    return b.rule == BeddingRule::zone && b.zone_thickness >= b.spacing;  // no planes any more
  });
  return all;
}

/// The joints of a setting: as they are, then k_n and k_s one after the other.
std::vector<Recipe> with_other_joints(const Recipe& recipe) {
  std::vector<Recipe> all = {recipe};
  for (double BeddingRecipe::*k : {&BeddingRecipe::k_n, &BeddingRecipe::k_s})
    for (const double f : joint_factors) all.push_back(recipe), all.back().bedding.front().*k *= f;
  return all;
}

/// Eq. 1 through the moduli of one recipe, in the order of angles and seeds.
theory::Eq1Fit eq1_of(std::span<const ElasticResult> results) {
  const std::size_t n_seeds = results.size() / eq2_angles.size();
  std::vector<theory::ModulusReading> readings;
  for (std::size_t a = 0; a < eq2_angles.size(); ++a) {
    double sum = 0.0;
    for (const ElasticResult& r : results.subspan(a * n_seeds, n_seeds)) sum += r.E_gauge;
    readings.push_back({eq2_angles[a], sum / static_cast<double>(n_seeds)});
  }
  theory::Eq1Options options;
  // As the paper has it: with E free, E and the compliances trade off, and the line would move with the
  // noise.
  options.reference = theory::Eq1Reference::measured_90;
  return theory::fit_eq1(readings, options);
}

/// `compliance`: of Eq. 1, that of the joints in question.
StiffnessRelation relation(const std::vector<Recipe>& recipes, const std::vector<theory::Eq1Fit>& fits,
                           double BeddingRecipe::*k, double theory::Eq1Fit::*compliance) {
  std::vector<double> micro, macro;
  for (std::size_t i = 0; i < recipes.size(); ++i) {
    const BeddingRecipe& joints = recipes[i].bedding.front();
    if (i > 0 && joints.*k == recipes.front().bedding.front().*k) continue;  // the other stiffness varies
    // A line through fewer places than three would hide that Eq. 1 failed at one.
    if (!fits[i].ok()) return {};
    micro.push_back(joints.*k), macro.push_back(1.0 / (fits[i].*compliance * joints.spacing));
  }
  return {macro.front() / micro.front(), fit_line(micro, macro)};
}

PlaneStiffness stiffness_of(const Setting& setting, const std::vector<std::int64_t>& seeds,
                            Simulator& simulator) {
  const std::vector<Recipe> recipes = with_other_joints(setting.recipe);
  // All in one call: packings are made once, and solutions share the threads.
  std::vector<Recipe> singles;
  for (const Recipe& r : recipes)
    for (const double theta : eq2_angles)
      for (const std::int64_t seed : seeds) singles.push_back(single_at(r, theta, seed));
  const std::vector<ElasticResult> results = simulator.elastic(singles, Statics::two_sided);
  std::vector<theory::Eq1Fit> fits;
  const std::size_t n = eq2_angles.size() * seeds.size();
  for (std::size_t i = 0; i < recipes.size(); ++i)
    fits.push_back(eq1_of(std::span(results).subspan(i * n, n)));
  return {setting.name, relation(recipes, fits, &BeddingRecipe::k_n, &theory::Eq1Fit::a),
          relation(recipes, fits, &BeddingRecipe::k_s, &theory::Eq1Fit::b)};
}

}  // namespace

bool has_eq2(const Recipe& r) {
  return r.bedding.size() == 1 && r.bedding.front().is_regular() && !r.bedding.front().is_drawn() &&
         r.bedding.front().layer_thickness == 0.0 && !r.matrix.directional();
}

std::vector<PlaneStiffness> eq2_band(const Recipe& recipe, const std::vector<std::int64_t>& seeds,
                                     Simulator& simulator) {
  std::vector<PlaneStiffness> band;
  for (const Setting& s : settings_of(recipe)) band.push_back(stiffness_of(s, seeds, simulator));
  return band;
}

}  // namespace phy::calibrate
