#include "genesis/cut.hpp"

#include <algorithm>
#include <cmath>

#include "base/check.hpp"
#include "genesis/packing.hpp"

namespace phy::genesis {
namespace {

double largest_radius(const Packing& packing) {
  double r_max = 0.0;
  for (const Disc& d : packing.discs) r_max = std::max(r_max, d.r);
  return r_max;
}

/// What was cut, moved within its box.
void move_by(Packing& cut, Vec2 shift) {
  for (Disc& d : cut.discs) d.x += shift.x, d.y += shift.y;
  cut.hash = packing_hash(cut.discs);
}

}  // namespace

Packing cut_disc(const Packing& packing, double diameter) {
  PHY_CHECK(diameter > 0.0 && diameter <= std::min(packing.width, packing.height),
            "a disc within the packing");
  const Vec2 centre{0.5 * packing.width, 0.5 * packing.height};
  Packing disc = packing;
  // Whole grains, by their centres: the rim is as rough as the rock is coarse.
  std::erase_if(disc.discs, [&](const Disc& d) { return norm(Vec2{d.x, d.y} - centre) > 0.5 * diameter; });
  // Grains at the rim reach beyond it by a radius.
  disc.width = disc.height = diameter + 2.0 * largest_radius(disc);
  move_by(disc, Vec2{0.5 * disc.width, 0.5 * disc.height} - centre);
  return disc;
}

Packing cut_half_disc(const Packing& packing, const SpecimenCut& cut, double bond_gap) {
  const double radius = 0.5 * cut.diameter;
  PHY_CHECK(radius > 0.0 && cut.diameter <= packing.width && radius <= packing.height,
            "half a disc within the packing");
  const Vec2 middle{0.5 * packing.width, 0.5 * (packing.height - radius)};  // of the flat face
  Packing half = packing;
  std::erase_if(half.discs, [&](const Disc& d) {
    return d.y < middle.y || norm(Vec2{d.x, d.y} - middle) > radius;
  });
  const double r_max = largest_radius(half);
  // So wide that no grain reaches across, nor any bond over a gap.
  const double width = std::max({cut.notch_width, (2.0 + touch_tolerance) * r_max, 2.0 * r_max + bond_gap});
  std::erase_if(half.discs, [&](const Disc& d) {
    return d.y + d.r < middle.y + cut.notch_length && std::fabs(d.x - middle.x) < 0.5 * width;
  });
  half.width = cut.diameter + 2.0 * r_max;
  half.height = radius + 2.0 * r_max;
  move_by(half, Vec2{0.5 * half.width, r_max} - middle);
  return half;
}

Packing cut_hole(const Packing& packing, double diameter) {
  PHY_CHECK(diameter > 0.0, "a hole has a diameter");
  const Vec2 centre{0.5 * packing.width, 0.5 * packing.height};
  Packing rest = packing;
  std::erase_if(rest.discs, [&](const Disc& d) { return norm(Vec2{d.x, d.y} - centre) < 0.5 * diameter; });
  rest.hash = packing_hash(rest.discs);
  return rest;
}

std::shared_ptr<const Packing> shaped(std::shared_ptr<const Packing> packing, const Recipe& recipe) {
  if (recipe.test.kind->cut == nullptr) return packing;
  const SpecimenCut cut = recipe.test.kind->cut(recipe);
  if (cut.hole > 0.0) return std::make_shared<const Packing>(cut_hole(*packing, cut.hole));
  return std::make_shared<const Packing>(cut.half ? cut_half_disc(*packing, cut, recipe.matrix.bond_gap)
                                                  : cut_disc(*packing, cut.diameter));
}

}  // namespace phy::genesis
