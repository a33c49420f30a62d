#include "gui/grab.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <vector>

#include "base/check.hpp"
#include "io/base64.hpp"
#include "io/toml_in.hpp"
#include "rock/file.hpp"
#include "statics/uniaxial.hpp"
#include "study/experiment.hpp"

namespace phy::gui {
namespace {

/// The recipe of one specimen.
Recipe turned(Recipe recipe, double theta) {
  recipe.test.angles = {theta}, recipe.test.intact = false;
  return study::single_recipes(recipe).front();
}

}  // namespace

Json discs_answer(const std::string& name, const std::string& toml, const std::optional<std::string>& table) {
  const Recipe recipe = rock::parse_rock(toml, name + ".toml", {table, {}}).model;
  const auto packing = study::packing_of(recipe);
  std::vector<float> numbers;
  for (const Disc& d : packing->discs)
    for (const double v : {d.x, d.y, d.r}) numbers.push_back(static_cast<float>(v));
  Json bedding = nullptr;
  if (!recipe.bedding.empty() && recipe.bedding.front().is_regular())
    bedding = {{"theta", recipe.bedding.front().theta},
               {"spacing", recipe.bedding.front().spacing},
               {"offset", recipe.bedding.front().offset}};
  return {
      {"width", packing->width},
      {"height", packing->height},
      {"discs", io::base64({reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(float)})},
      {"bedding", bedding}};
}

Json moduli_answer(const std::string& recipe, double theta) {
  if (!(theta >= 0.0 && theta <= 90.0))
    throw InputError(Problem{"", "theta", "", "an angle of 0 to 90 degrees", ""});
  const Recipe single = turned(io::read_recipe(recipe), theta);
  const auto specimen = study::specimen_of(study::packing_of(single), single);
  statics::UniaxialStatics statics;
  statics::ElasticOptions options;
  options.sensitivities = false;
  const ElasticResult r = statics.solve(*specimen, options);
  const auto known = [&](double value) { return r.outcome.ok() ? Json(value) : Json(nullptr); };
  return {{"theta", theta}, {"E", known(r.E_gauge)}, {"nu", known(r.nu_gauge)}};
}

}  // namespace phy::gui
