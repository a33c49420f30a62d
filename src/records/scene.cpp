#include "records/scene.hpp"

#include <map>
#include <utility>

namespace phy {

Scene scene_of(const Packing& packing, const TestResult& result) {
  Scene scene{packing.width, packing.height, packing.discs, result.frames, {}, {}};
  using Pair = std::pair<std::uint32_t, std::uint32_t>;
  std::map<Pair, std::size_t> place;
  // Lists of neighbours name a contact either way round; a link is one through the whole test.
  const auto key = [](const ContactState& c) { return c.a < c.b ? Pair{c.a, c.b} : Pair{c.b, c.a}; };
  // The first kind counts: a bond that breaks later is a touching contact, and would lose its colour at the
  // start.
  std::map<Pair, ContactKind> kinds;
  for (const Snapshot& shot : result.snapshots)
    for (const ContactState& c : shot.contacts) kinds.emplace(key(c), c.kind);
  for (const auto& [pair, kind] : kinds) {
    place[pair] = scene.links.size();
    scene.links.push_back({pair.first, pair.second, kind});
  }
  for (const Snapshot& shot : result.snapshots) {
    // A contact that a state lacks has no force there.
    ForceField field{shot.step, shot.axial_strain, shot.axial_stress,
                     std::vector<float>(scene.links.size(), 0.0F)};
    for (const ContactState& c : shot.contacts) field.F_n[place[key(c)]] = static_cast<float>(c.F_n);
    scene.forces.push_back(std::move(field));
  }
  return scene;
}

}  // namespace phy
