#include "lab/rigs.hpp"

#include <algorithm>
#include <utility>

#include "base/units.hpp"
#include "records/result.hpp"

namespace phy {

std::string rig_name(const Recipe& recipe) {
  const TestRecipe& t = recipe.test;
  switch (t.kind) {
    case TestKind::uniaxial: return to_string(t.kind);
    case TestKind::direct_tension: return std::string(to_string(t.kind)) + print_number(t.grip_thickness);
  }
  return "";
}

Tool flat_wall(const Packing& packing, std::string name, Vec2 point, Vec2 normal, bool rough) {
  Tool wall;
  wall.name = std::move(name);
  wall.rough = rough;
  for (std::uint32_t i = 0; i < packing.discs.size(); ++i) {
    const Disc& d = packing.discs[i];
    wall.touches.push_back({i, normal, dot(normal, {d.x, d.y}) - dot(normal, point) - d.r});
  }
  return wall;
}

Rig platens(const Packing& packing) {
  Rig rig;
  rig.tools = {flat_wall(packing, "bottom platen", {0.0, 0.0}, {0.0, 1.0}, true),
               flat_wall(packing, "top platen", {0.0, packing.height}, {0.0, -1.0}, true)};
  rig.axial = {0, 1, {0.0, 1.0}, packing.height, packing.width};
  return rig;
}

double grip_thickness(const Recipe& recipe, const Packing& packing) {
  if (recipe.test.grip_thickness > 0.0) return recipe.test.grip_thickness;
  double largest = 0.0;
  for (const Disc& d : packing.discs) largest = std::max(largest, d.r);
  return 4.0 * largest;
}

Rig grips(const Packing& packing, double thickness) {
  Rig rig;
  rig.tools = {{"bottom grip", {}, {}, false}, {"top grip", {}, {}, false}};
  for (std::uint32_t i = 0; i < packing.discs.size(); ++i) {
    const double y = packing.discs[i].y;
    if (y < thickness) rig.tools[0].grips.push_back({i, false, true, false});
    if (y > packing.height - thickness) rig.tools[1].grips.push_back({i, false, true, false});
  }
  rig.axial = {0, 1, {0.0, 1.0}, packing.height - 2.0 * thickness, packing.width};
  return rig;
}

}  // namespace phy
