#include "genesis/cut.hpp"

#include <algorithm>

#include "base/check.hpp"
#include "genesis/packing.hpp"
#include "records/test_description.hpp"

namespace phy::genesis {

Packing cut_disc(const Packing& packing, double diameter) {
  PHY_CHECK(diameter > 0.0 && diameter <= std::min(packing.width, packing.height),
            "a disc within the packing");
  const Vec2 centre{0.5 * packing.width, 0.5 * packing.height};
  Packing disc = packing;
  std::erase_if(disc.discs, [&](const Disc& d) { return norm(Vec2{d.x, d.y} - centre) > 0.5 * diameter; });
  double r_max = 0.0;
  for (const Disc& d : disc.discs) r_max = std::max(r_max, d.r);
  disc.width = disc.height = diameter + 2.0 * r_max;
  for (Disc& d : disc.discs) {
    d.x += 0.5 * disc.width - centre.x;
    d.y += 0.5 * disc.height - centre.y;
  }
  disc.hash = packing_hash(disc.discs);
  return disc;
}

std::shared_ptr<const Packing> shaped(std::shared_ptr<const Packing> packing, const Recipe& recipe) {
  const auto diameter = recipe.test.kind->disc_diameter;
  return diameter == nullptr ? packing
                             : std::make_shared<const Packing>(cut_disc(*packing, diameter(recipe)));
}

}  // namespace phy::genesis
