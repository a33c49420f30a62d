#include "verdict/grain_size.hpp"

#include <algorithm>
#include <cmath>

#include "base/nan.hpp"
#include "records/recipe_schema.hpp"
#include "study/expected.hpp"

namespace phy::verdict {

double grain_size_to_meet(const std::vector<Comparison>& toughness, double grain_size) {
  double sum = 0.0;
  int n = 0;
  for (const Comparison& c : toughness)
    if (c.answered()) sum += std::log(c.target.mean / c.mean), ++n;
  return n > 0 ? grain_size * std::exp(2.0 * sum / n) : nan;
}

bool can_hold(const Recipe& model, double size) {
  constexpr double fewest_across = 10.0;
  const SpecimenSize& s = model.specimen;
  const double n = study::expected_grains(model) * std::pow(grain_size(model) / size, 2.0);
  return size * fewest_across <= std::min(s.width, s.height) && n <= static_cast<double>(max_recipe_grains);
}

}  // namespace phy::verdict
