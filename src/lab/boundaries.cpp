#include "lab/boundaries.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/units.hpp"

namespace phy::lab {

namespace {

constexpr double loaded = 1e-4;  // strain from which the energy balance means something
constexpr double press_first_wave = 2e-4;

}  // namespace

void set_axial(TestBoundary& boundary, int lo, int hi, Vec2 direction, LoadScale scale) {
  boundary.boundary.axial = {lo, hi, direction, loaded * scale.length};
  boundary.axial = scale;
}

engine::BoundaryBody flat_wall(const Packing& packing, std::string name, Vec2 point, Vec2 normal,
                               bool rough) {
  engine::BoundaryBody wall;
  wall.name = std::move(name);
  wall.rough = rough;
  for (std::uint32_t i = 0; i < packing.discs.size(); ++i) {
    const Disc& d = packing.discs[i];
    // Every grain, not only those at the wall: fragments may fly to it later.
    wall.touches.push_back({i, normal, dot(normal, {d.x, d.y}) - dot(normal, point) - d.r});
  }
  return wall;
}

std::int64_t first_grain(const Packing& packing, Vec2 from, Vec2 direction) {
  std::int64_t first = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < packing.discs.size(); ++i) {
    const Disc& d = packing.discs[i];
    const Vec2 c = Vec2{d.x, d.y} - from;
    const double across = cross(direction, c);
    // The ray passes beside the disc.
    if (std::fabs(across) >= d.r) continue;
    const double distance = dot(direction, c) - std::sqrt(d.r * d.r - across * across);
    if (distance >= 0.0 && distance < nearest) nearest = distance, first = static_cast<std::int64_t>(i);
  }
  return first;
}

double ray_spacing(const Packing& packing) {
  double r = packing.discs.front().r;
  for (const Disc& d : packing.discs) r = std::min(r, d.r);
  // So close that no grain hides between two rays.
  return 0.25 * r;
}

TestBoundary platens(const Packing& packing) {
  TestBoundary press;
  press.boundary.bodies = {flat_wall(packing, "bottom platen", {0.0, 0.0}, {0.0, 1.0}, true),
                           flat_wall(packing, "top platen", {0.0, packing.height}, {0.0, -1.0}, true)};
  set_axial(press, 0, 1, {0.0, 1.0}, {packing.height, packing.width});
  // Before the first wave has gone through, what falls is no failure.
  press.first_wave = press_first_wave;
  return press;
}

const HistoryColumns& platen_stress_columns() {
  static const HistoryColumns columns = {
      {"axial_stress", "Pa", "mean platen force / initial width", &HistoryRow::axial_stress},
      {"stress_top", "Pa", "top platen force / initial width", &HistoryRow::stress_top},
      {"stress_bottom", "Pa", "bottom platen force / initial width", &HistoryRow::stress_bottom}};
  return columns;
}

std::string speed_text(const TestRecipe& test) {
  const std::string slow = print_quantity(test.platen_speed, Dimension::speed) + " each";
  if (test.approach_strain == 0.0) return slow;
  return fmt::format("{} up to a strain of {:g}, then at {}",
                     print_quantity(test.approach_speed, Dimension::speed), test.approach_strain, slow);
}

std::string platens_text(const TestRecipe& test) {
  return fmt::format("Two rigid platens (friction {:g}) closed at {}", test.platen_friction,
                     speed_text(test));
}

double wave_stiffness(const MatrixRecipe& matrix, double area, double time) {
  // A plane wave carries sqrt(E rho) v: force per displacement in a given time.
  return std::sqrt(matrix.modulus() * matrix.density) * area / time;
}

}  // namespace phy::lab
