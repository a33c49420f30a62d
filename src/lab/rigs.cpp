#include "lab/rigs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/brazilian.hpp"
#include "base/exact_math.hpp"
#include "base/units.hpp"
#include "engine/stable_step.hpp"
#include "genesis/cut.hpp"
#include "records/result.hpp"

namespace phy {

std::string rig_name(const Recipe& recipe) {
  const TestRecipe& t = recipe.test;
  switch (t.kind) {
    case TestKind::uniaxial: return to_string(t.kind);
    case TestKind::direct_tension: return std::string(to_string(t.kind)) + print_number(t.grip_thickness);
    case TestKind::brazilian:
      return std::string(to_string(t.kind)) + print_number(disc_diameter(recipe)) + " " +
             print_number(t.loading_angle);
    case TestKind::biaxial:
      if (t.confining_stress == 0.0) return "unconfined biaxial";
      return t.confinement == Confinement::walls ? "walls" : "jacket";
    case TestKind::direct_shear: return std::string(to_string(t.kind)) + print_number(t.shear_gap);
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

std::int64_t first_grain(const Packing& packing, Vec2 from, Vec2 direction) {
  std::int64_t first = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < packing.discs.size(); ++i) {
    const Disc& d = packing.discs[i];
    const Vec2 c = Vec2{d.x, d.y} - from;
    const double across = cross(direction, c);
    if (std::fabs(across) >= d.r) continue;
    const double distance = dot(direction, c) - std::sqrt(d.r * d.r - across * across);
    if (distance < nearest) nearest = distance, first = static_cast<std::int64_t>(i);
  }
  return first;
}

namespace {

constexpr double ray_spacing = 0.25;  // of the smallest radius: no grain of the surface is missed

double smallest_radius(const Packing& packing) {
  double r = packing.discs.front().r;
  for (const Disc& d : packing.discs) r = std::min(r, d.r);
  return r;
}

double modulus(const MatrixRecipe& m) { return m.E_c + m.radius_multiplier * m.E_b; }

/// A jaw on the arc of the rim around `up` = (0, +-1).
Tool jaw(const Packing& packing, std::string name, double diameter, double angle, double up) {
  Tool tool{std::move(name), {}, {}, true};
  const Vec2 centre{0.5 * packing.width, 0.5 * packing.height};
  const double arc = angle / 180.0 * pi * 0.5 * diameter;
  const int n = static_cast<int>(std::ceil(arc / (ray_spacing * smallest_radius(packing))));
  std::vector<char> held(packing.discs.size(), 0);
  for (int k = 0; k <= n; ++k) {
    const SinCos sc = sin_cos_degrees(angle * (static_cast<double>(k) / n - 0.5));
    const Vec2 out{sc.sin, up * sc.cos};
    const std::int64_t g = first_grain(packing, centre + diameter * out, -1.0 * out);
    if (g >= 0) held[static_cast<std::size_t>(g)] = 1;
  }
  for (std::uint32_t g = 0; g < held.size(); ++g) {
    if (held[g] == 0) continue;
    const Vec2 inwards = centre - Vec2{packing.discs[g].x, packing.discs[g].y};
    tool.touches.push_back({g, (1.0 / norm(inwards)) * inwards, 0.0});
  }
  return tool;
}

}  // namespace

Rig jaws(const Packing& packing, double diameter, double angle) {
  Rig rig;
  if (angle > 0.0) {
    rig.tools = {jaw(packing, "bottom jaw", diameter, angle, -1.0),
                 jaw(packing, "top jaw", diameter, angle, 1.0)};
  } else {
    double low = packing.height, high = 0.0;
    for (const Disc& d : packing.discs) low = std::min(low, d.y - d.r), high = std::max(high, d.y + d.r);
    rig.tools = {flat_wall(packing, "bottom platen", {0.0, low}, {0.0, 1.0}, true),
                 flat_wall(packing, "top platen", {0.0, high}, {0.0, -1.0}, true)};
  }
  rig.axial = {0, 1, {0.0, 1.0}, diameter, 0.5 * pi * diameter / brazilian_arc_factor(0.5 * angle)};
  return rig;
}

Rig confined_platens(const Packing& packing, const TestRecipe& test) {
  Rig rig = platens(packing);
  if (test.confining_stress == 0.0) return rig;
  if (test.confinement == Confinement::walls) {
    rig.tools.push_back(flat_wall(packing, "left wall", {0.0, 0.0}, {1.0, 0.0}, false));
    rig.tools.push_back(flat_wall(packing, "right wall", {packing.width, 0.0}, {-1.0, 0.0}, false));
    rig.lateral = {2, 3, {1.0, 0.0}, packing.width, packing.height};
    return rig;
  }
  rig.jacket = true;
  return rig;
}

Rig shear_boxes(const Packing& packing, double gap) {
  Rig rig;
  rig.tools = {{"lower box", {}, {}, false}, {"upper box", {}, {}, false}};
  const double middle = 0.5 * packing.height;
  for (std::uint32_t i = 0; i < packing.discs.size(); ++i) {
    const double y = packing.discs[i].y - middle;
    if (y < -0.5 * gap) rig.tools[0].grips.push_back({i, true, true, true});
    if (y >= 0.5 * gap) rig.tools[1].grips.push_back({i, true, true, true});
  }
  rig.axial = {1, 0, {1.0, 0.0}, 1.0, packing.width};
  rig.lateral = {0, 1, {0.0, 1.0}, 1.0, packing.width};
  return rig;
}

Rig rig_of(const Packing& packing, const Recipe& recipe) {
  const TestRecipe& t = recipe.test;
  switch (t.kind) {
    case TestKind::uniaxial: return platens(packing);
    case TestKind::direct_tension: return grips(packing, grip_thickness(recipe, packing));
    case TestKind::brazilian: return jaws(packing, disc_diameter(recipe), t.loading_angle);
    case TestKind::biaxial: return confined_platens(packing, t);
    case TestKind::direct_shear: return shear_boxes(packing, t.shear_gap);
  }
  return {};
}

double wave_stiffness(const MatrixRecipe& matrix, double area, double time) {
  return std::sqrt(modulus(matrix) * matrix.density) * area / time;
}

double block_stiffness(const Specimen& specimen, double area, double length, double time) {
  return 2.0 * modulus(specimen.matrix) * area / length + wave_stiffness(specimen.matrix, area, time);
}

double plane_stiffness(const Specimen& specimen, double gap) {
  const std::vector<Disc>& discs = specimen.packing->discs;
  const double middle = 0.5 * specimen.packing->height;
  double across = 0.0, sound = 0.0, radius = 0.0;  // sound: as if no joint were there
  for (Contact c : specimen.contacts) {
    if ((discs[c.a].y < middle) == (discs[c.b].y < middle)) continue;
    across += initial_stiffness(contact::standard_models(), specimen, c).k.k_n;
    if (c.kind == ContactKind::joint) c.kind = ContactKind::bonded;
    sound += initial_stiffness(contact::standard_models(), specimen, c).k.k_n;
  }
  for (const Disc& d : discs) radius += d.r / static_cast<double>(discs.size());
  return across / (1.0 + gap / (2.0 * radius) * (across / sound));
}

}  // namespace phy
