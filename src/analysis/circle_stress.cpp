#include "analysis/circle_stress.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace phy::analysis {
namespace {

/// Share of the straight line from a to b inside the circle about the origin.
double share_inside(Vec2 a, Vec2 b, double radius) {
  const Vec2 l = b - a;
  const double A = dot(l, l), B = dot(a, l), C = dot(a, a) - radius * radius;
  const double root = B * B - A * C;
  // The line passes beside the circle, or touches it.
  if (!(root > 0.0)) return 0.0;
  const double from = std::max(0.0, (-B - std::sqrt(root)) / A),
               to = std::min(1.0, (-B + std::sqrt(root)) / A);
  return std::max(0.0, to - from);
}

}  // namespace

PlaneStress stress_in_circle(const Packing& packing, const Snapshot& snapshot, Vec2 centre, double radius) {
  PlaneStress sum;
  for (const ContactState& c : snapshot.contacts) {
    const auto place = [&](std::uint32_t i) {
      return Vec2{packing.discs[i].x + snapshot.grains[i].ux, packing.discs[i].y + snapshot.grains[i].uy};
    };
    const Vec2 a = place(c.a), b = place(c.b), l = b - a;
    // Love-Weber over part of a body: a contact counts with the part of its branch that lies inside.
    const double share = share_inside(a - centre, b - centre, radius);
    const Vec2 F = c.F_n * c.normal + c.F_s * Vec2{-c.normal.y, c.normal.x};
    sum.xx += share * F.x * l.x;
    sum.yy += share * F.y * l.y;
    // Couples make the sum unsymmetric; the mean of both is the stress.
    sum.xy += share * 0.5 * (F.x * l.y + F.y * l.x);
  }
  const double area = std::numbers::pi * radius * radius;
  return {sum.xx / area, sum.yy / area, sum.xy / area};
}

}  // namespace phy::analysis
