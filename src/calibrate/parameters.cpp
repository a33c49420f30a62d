#include "calibrate/parameters.hpp"

namespace phy::calibrate {

Recipe with_moduli(Recipe recipe, const Recipe& moduli) {
  for (const Parameter* p : elastic_parameters(recipe)) p->set(recipe, p->get(moduli));
  return recipe;
}

}  // namespace phy::calibrate
