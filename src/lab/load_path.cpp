#include "lab/load_path.hpp"

#include <fmt/format.h>

#include "base/check.hpp"
#include "base/clusters.hpp"
#include "lab/tests.hpp"

namespace phy::lab {
namespace {

/// What the body reaches joins the cluster of `hub`. Returns how many grains it reaches.
std::size_t reach(const engine::BoundaryBody& body, const Packing& packing, std::uint32_t hub,
                  Clusters& clusters) {
  std::size_t n = 0;
  for (const engine::Touch& t : body.touches)
    // As near as a grain that it will touch soon: the platens have not closed yet.
    if (t.gap < packing.discs[t.grain].r) clusters.join(t.grain, hub), ++n;
  for (const engine::Grip& g : body.grips) clusters.join(g.grain, hub), ++n;
  return n;
}

}  // namespace

void check_load_path(const Specimen& specimen, const Recipe& recipe) {
  const Packing& packing = *specimen.packing;
  // Before minutes of computing: a specimen without a load path only shows as one that never peaks.
  const engine::Boundary boundary = boundary_of(packing, recipe).boundary;
  const auto n = static_cast<std::uint32_t>(packing.discs.size()), lo = n, hi = n + 1;
  Clusters clusters(n + 2);  // the grains and the two bodies
  for (const Contact& c : specimen.contacts) clusters.join(c.a, c.b);
  std::string lost;
  bool no_reach = false;
  for (const auto& [number, hub] : {std::pair(boundary.axial.lo, lo), std::pair(boundary.axial.hi, hi)}) {
    const engine::BoundaryBody& body = boundary.bodies[static_cast<std::size_t>(number)];
    if (reach(body, packing, hub, clusters) == 0)
      no_reach = true, lost = "the " + body.name + " reaches no disc";
  }
  if (clusters.find(lo) == clusters.find(hi)) return;
  if (lost.empty())
    lost = fmt::format("{} discs have {} contact(s), and none of their chains leads across", n,
                       specimen.contacts.size());
  if (const HoldKey& hold = room_of(recipe).hold; no_reach && hold.value != nullptr)
    throw InputError(Problem{"", hold.key, fmt::format("{:g} mm", 1e3 * (recipe.test.*hold.value)),
                             hold.expected, lost + ": " + hold.remedy});
  const PackingRecipe& p = recipe.packing;
  const bool imported = !p.file.empty(), counted = p.n_grains > 0;
  throw InputError(
      Problem{"",
              imported  ? "packing.file"
              : counted ? "packing.n_grains"
                        : "packing.porosity",
              imported  ? p.file
              : counted ? std::to_string(p.n_grains)
                        : fmt::format("{:g}", p.porosity),
              fmt::format("discs that touch, in chains from the {} to the {}",
                          boundary.bodies[static_cast<std::size_t>(boundary.axial.lo)].name,
                          boundary.bodies[static_cast<std::size_t>(boundary.axial.hi)].name),
              lost + (imported  ? ": move them closer, or raise matrix.bond_gap, which bonds small gaps"
                      : counted ? ": raise it, or raise matrix.bond_gap"
                                : ": lower it, or raise matrix.bond_gap")});
}

}  // namespace phy::lab
