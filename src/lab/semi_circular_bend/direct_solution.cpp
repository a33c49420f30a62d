#include "lab/semi_circular_bend/direct_solution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/check.hpp"
#include "base/nan.hpp"
#include "statics/crack_tip.hpp"

namespace phy::lab {
namespace {

// In radii. The ring leaves out the grains next to the end of the notch; with a/R near 0.6 it comes near the
// loading roller (verified up to 0.58, docs/theory/semi-circular-bend.md). The windows lie on both sides of
// the notch, inside the arc.
constexpr double ring_from = 0.1, ring_to = 0.4;
constexpr double window_near = 0.12, window_far = 0.7, window_low = 0.1, window_high = 0.6;
constexpr double grains_off = 4.0;  // largest radii that the ring is off the end of the notch at least
constexpr double widest = 0.5;      // inner over outer radius of a ring in which there are grains enough

/// A vertical force on the line x of a roller, shared by its grains on either side. Grains that hardly hang
/// on the others carry none.
std::vector<statics::Given> pressed(const Packing& packing, const engine::BoundaryBody& roller,
                                    const std::vector<int>& n_contacts, double x, double force) {
  const engine::Touch *left = nullptr, *right = nullptr;
  const auto at = [&](const engine::Touch* t) { return packing.discs[t->grain].x; };
  for (const int least : {3, 0}) {
    for (const engine::Touch& t : roller.touches) {
      if (n_contacts[t.grain] < least) continue;
      if (at(&t) <= x && (left == nullptr || at(&t) > at(left))) left = &t;
      if (at(&t) > x && (right == nullptr || at(&t) < at(right))) right = &t;
    }
    if (left != nullptr || right != nullptr) break;
  }
  PHY_CHECK(left != nullptr || right != nullptr, "a roller meets grains");
  if (left == nullptr) left = right;
  if (right == nullptr) right = left;
  const double share = left == right ? 1.0 : (at(right) - x) / (at(right) - at(left));
  if (left == right) return {{{left->grain, 1}, force}};
  return {{{left->grain, 1}, share * force}, {{right->grain, 1}, (1.0 - share) * force}};
}

/// Keeps the body from moving away: a grain with as many contacts as any.
void hold(statics::Boundary& boundary, const std::vector<int>& n_contacts) {
  const auto most =
      static_cast<std::uint32_t>(std::max_element(n_contacts.begin(), n_contacts.end()) - n_contacts.begin());
  for (int component = 0; component < 3; ++component) boundary.movements.push_back({{most, component}, 0.0});
}

statics::Boundary loads(const Specimen& specimen, const BendSpecimen& bend, const engine::Boundary& rollers) {
  std::vector<int> n_contacts(specimen.packing->discs.size(), 0);
  for (const Contact& c : specimen.contacts) ++n_contacts[c.a], ++n_contacts[c.b];
  const double cx = bend.flat_face(specimen.packing->width).x, P = 2.0 * bend.radius;  // nominal stress 1
  statics::Boundary boundary;
  const auto add = [&](const auto& forces) {
    boundary.loads.insert(boundary.loads.end(), forces.begin(), forces.end());
  };
  for (const double side : {-0.5, 0.5})
    add(pressed(*specimen.packing, rollers.bodies[0], n_contacts, cx + side * bend.span, 0.5 * P));
  add(pressed(*specimen.packing, rollers.bodies[1], n_contacts, cx, -P));
  hold(boundary, n_contacts);
  return boundary;
}

}  // namespace

DirectIntensity direct_intensity(const Specimen& specimen, const BendSpecimen& bend,
                                 const engine::Boundary& rollers) {
  const double R = bend.radius;
  const auto [cx, flat] = bend.flat_face(specimen.packing->width);  // flat: the largest radius, too
  const Vec2 up{0.0, 1.0};
  const statics::CrackTip tip{
      {cx, flat + bend.notch}, up, std::max(ring_from * R, grains_off * flat), ring_to * R};
  if (tip.nearest > widest * tip.farthest) return {"too few grains around the end of the notch"};
  for (const BeddingRecipe& set : specimen.bedding)
    if (const double planes = (tip.farthest - tip.nearest) / set.spacing;
        set.has_planes() && planes < least_planes)
      return {
          fmt::format("too few planes around the notch to take the rock for homogeneous: {:.1f} within the "
                      "ring that is read, at least {:g} are needed",
                      planes, least_planes)};
  const statics::Network network = statics::make_network(specimen);
  const statics::LoadCase solved = statics::solve_once(network, loads(specimen, bend, rollers));
  if (!solved.outcome.ok()) return {"no direct elastic solution: " + solved.outcome.reason};
  const std::array<statics::Window, 2> windows = {
      {{{cx - window_far * R, flat + window_low * R}, {cx - window_near * R, flat + window_high * R}},
       {{cx + window_near * R, flat + window_low * R}, {cx + window_far * R, flat + window_high * R}}}};
  const statics::EffectiveCompliance rock = statics::effective_compliance(network, windows, 2.0 * flat, up);
  if (!rock.outcome.ok()) return {"no effective compliance: " + rock.outcome.reason};
  const statics::StressIntensity K = statics::stress_intensity(network, solved.u, tip, rock.S);
  return {"", K.K_I, K.K_II};
}

std::vector<Number> direct_numbers(const DirectIntensity& direct, double peak) {
  const bool known = direct.missing.empty();
  const std::string& note = direct.missing;
  const auto scaled = [&](double K) { return known ? K * peak : nan; };
  return {{"K_I", scaled(direct.K_I), "Pa sqrt(m)",
           "stress intensity in mode I at P_max, direct elastic solution of the grains, effective "
           "anisotropic body",
           note},
          {"K_II", scaled(direct.K_II), "Pa sqrt(m)",
           "the same in mode II; positive: the left flank slides towards the end of the notch", note}};
}

}  // namespace phy::lab
