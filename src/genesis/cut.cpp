#include "genesis/cut.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/check.hpp"
#include "base/clusters.hpp"
#include "base/exact_math.hpp"
#include "base/units.hpp"
#include "genesis/packing.hpp"

namespace phy::genesis {
namespace {

double largest_radius(const Packing& packing) {
  double r_max = 0.0;
  for (const Disc& d : packing.discs) r_max = std::max(r_max, d.r);
  return r_max;
}

/// Of a saw cut: so wide that no grain reaches across, nor any bond over a gap.
double clear_width(double asked, double r_max, double bond_gap) {
  return std::max({asked, (2.0 + touch_tolerance) * r_max, 2.0 * r_max + bond_gap});
}

Vec2 middle_of(const Packing& packing) { return {0.5 * packing.width, 0.5 * packing.height}; }

/// What was cut, moved within its box.
void move_by(Packing& cut, Vec2 shift) {
  for (Disc& d : cut.discs) d.x += shift.x, d.y += shift.y;
  cut.hash = packing_hash(cut.discs);
}

}  // namespace

Packing cut_disc(const Packing& packing, double diameter) {
  PHY_CHECK(diameter > 0.0 && diameter <= std::min(packing.width, packing.height),
            "a disc within the packing");
  const Vec2 centre = middle_of(packing);
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
  const double width = clear_width(cut.notch_width, r_max, bond_gap);
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
  const Vec2 centre = middle_of(packing);
  Packing rest = packing;
  std::erase_if(rest.discs, [&](const Disc& d) { return norm(Vec2{d.x, d.y} - centre) < 0.5 * diameter; });
  rest.hash = packing_hash(rest.discs);
  return rest;
}

Packing cut_flaw(const Packing& packing, const SpecimenSize& flaw, double bond_gap) {
  PHY_CHECK(flaw.flaw_length > 0.0, "a flaw has a length");
  const SinCos a = sin_cos_degrees(flaw.flaw_angle);
  const Vec2 axis{a.cos, a.sin}, centre = middle_of(packing);
  const double width = clear_width(flaw.flaw_width, largest_radius(packing), bond_gap);
  Packing rest = packing;
  std::erase_if(rest.discs, [&](const Disc& d) {
    const Vec2 x = Vec2{d.x, d.y} - centre;
    return std::fabs(dot(axis, x)) + d.r < 0.5 * flaw.flaw_length && std::fabs(cross(axis, x)) < 0.5 * width;
  });
  rest.hash = packing_hash(rest.discs);
  return rest;
}

std::string opening_name(const Recipe& recipe) {
  const SpecimenSize& s = recipe.specimen;
  if (!s.pierced()) return {};
  std::string name = "hole " + print_number(s.hole_diameter);
  // More grains are sawn out where bonds may span gaps.
  for (const double v : {s.flaw_length, s.flaw_angle, s.flaw_width, recipe.matrix.bond_gap})
    name += " " + print_number(v);
  return name;
}

void check_in_one_piece(const Specimen& specimen, const Recipe& recipe) {
  if (!recipe.specimen.pierced()) return;
  const std::size_t n = specimen.packing->discs.size();
  Clusters clusters(n);
  for (const Contact& c : specimen.contacts) clusters.join(c.a, c.b);
  std::vector<std::size_t> size(n + 1, 0);
  for (std::uint32_t g = 0; g < n; ++g) ++size[clusters.find(g)];
  const std::size_t largest = *std::max_element(size.begin(), size.end());
  if (10 * largest >= 9 * n && n > 0) return;
  const bool hole = recipe.specimen.hole_diameter > 0.0;
  const std::string key = hole ? "hole_diameter" : "flaw_length";
  throw InputError(Problem{
      "", "specimen." + key,
      print_quantity(hole ? recipe.specimen.hole_diameter : recipe.specimen.flaw_length, Dimension::length),
      "rock in one piece around it",
      fmt::format("of {} discs left the largest piece has {}: make it smaller", n, largest)});
}

std::shared_ptr<const Packing> shaped(std::shared_ptr<const Packing> packing, const Recipe& recipe) {
  const SpecimenSize& size = recipe.specimen;
  const SpecimenCut cut = recipe.test.kind->cut != nullptr ? recipe.test.kind->cut(recipe) : SpecimenCut{};
  const double hole = std::max(cut.hole, size.hole_diameter);
  if (cut.diameter == 0.0 && hole == 0.0 && size.flaw_length == 0.0) return packing;
  Packing shape = cut.diameter == 0.0 ? *packing
                  : cut.half          ? cut_half_disc(*packing, cut, recipe.matrix.bond_gap)
                                      : cut_disc(*packing, cut.diameter);
  if (hole > 0.0) shape = cut_hole(shape, hole);
  if (size.flaw_length > 0.0) shape = cut_flaw(shape, size, recipe.matrix.bond_gap);
  return std::make_shared<const Packing>(std::move(shape));
}

}  // namespace phy::genesis
