// Rattlers: discs with fewer than three contacts carry no load, so the bonded rock would have holes there.
//
// Potyondy & Cundall 2004 (Int. J. Rock Mech. Min. Sci. 41:1329-1364) let them grow among fixed neighbours
// until they touch. Here each rattler grows in small steps, sliding down the overlaps after each, until three
// neighbours press it about as hard as contacts are pressed elsewhere. One that meets no three neighbours
// below `growth_limit` times its radius stays as it was and is counted as left.
#pragma once
#include <vector>

#include "genesis/settle.hpp"

namespace phy::genesis {

/// A rattler grows to at most this multiple of its radius (Potyondy & Cundall's initial multiplier, 1.3):
/// beyond it the disc would leave the range of radii by more than the range is wide.
constexpr double growth_limit = 1.3;

/// Discs with fewer than three contacts, walls counted, ascending.
std::vector<std::uint32_t> find_rattlers(const SettleBox& box, const std::vector<Disc>& discs);

/// Grows each rattler among its fixed neighbours until at least three overlap it by `overlap` [m] on average.
/// Returns how many grew; the assembly is to be settled again afterwards.
long grow_rattlers(const SettleBox& box, std::vector<Disc>& discs, double overlap);

}  // namespace phy::genesis
