// Contact forces of a specimen at one moment, and the moment tensor of a source from their change.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "records/acoustic_event.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy::events {

struct ContactForce {
  std::uint32_t a = 0, b = 0;  ///< grains, a < b
  Vec2 at;                     ///< contact point [m]
  Vec2 force;                  ///< on grain b [N/m]
};
/// Sorted by grains.
using Forces = std::vector<ContactForce>;

Forces forces_of(const Packing& packing, const Snapshot& shot);

/// Sum over the contacts between `grains` (sorted) and all others: change of the force that the grains put on
/// the others, times the way from `centre` to the contact (Hazzard & Young 2002). A contact that is in one of
/// both moments only has no force in the other. Couples of contacts are left out: they would make the tensor
/// unsymmetric, and it is their symmetric part that is returned.
MomentTensor moment_tensor(std::span<const std::uint32_t> grains, Vec2 centre, const Forces& before,
                           const Forces& after);

}  // namespace phy::events
