#include "events/forces.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"

namespace phy::events {
namespace {

auto pair_of(const ContactForce& c) { return std::pair(c.a, c.b); }
bool earlier(const ContactForce& p, const ContactForce& q) { return pair_of(p) < pair_of(q); }

}  // namespace

Forces forces_of(const Packing& packing, const Snapshot& shot) {
  PHY_CHECK(shot.grains.size() == packing.discs.size(), "a snapshot holds every grain of its packing");
  const auto place = [&](std::uint32_t i) {
    return Vec2{packing.discs[i].x + shot.grains[i].ux, packing.discs[i].y + shot.grains[i].uy};
  };
  Forces forces;
  forces.reserve(shot.contacts.size());
  for (const ContactState& c : shot.contacts) {
    const Vec2 a = place(c.a), branch = place(c.b) - a;
    // The normal of an interface is that of its plane: the point lies on the branch all the same.
    const Vec2 at = a + (packing.discs[c.a].r / norm(branch)) * branch;
    forces.push_back({c.a, c.b, at, c.F_n * c.normal + c.F_s * tangent(c.normal)});
  }
  std::sort(forces.begin(), forces.end(), earlier);
  return forces;
}

MomentTensor moment_tensor(std::span<const std::uint32_t> grains, Vec2 centre, const Forces& before,
                           const Forces& after) {
  const auto inside = [&](std::uint32_t g) { return std::binary_search(grains.begin(), grains.end(), g); };
  MomentTensor m;
  const auto add = [&](const ContactForce& c, double sign) {
    const bool a = inside(c.a), b = inside(c.b);
    if (a == b) return;  // within the source, or far from it
    const Vec2 push = (a ? sign : -sign) * c.force, arm = c.at - centre;
    m.xx += push.x * arm.x;
    m.yy += push.y * arm.y;
    m.xy += 0.5 * (push.x * arm.y + push.y * arm.x);
  };
  for (const ContactForce& c : after) add(c, 1.0);
  for (const ContactForce& c : before) {
    // Both forces about one point: a contact that rolls on changes no moment by that.
    const auto same = std::lower_bound(after.begin(), after.end(), c, earlier);
    const bool lasts = same != after.end() && pair_of(*same) == pair_of(c);
    add({c.a, c.b, lasts ? same->at : c.at, c.force}, -1.0);
  }
  return m;
}

}  // namespace phy::events
