// Which cracks form together: clusters in time and space (Hazzard & Young 2000).
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy::events {

/// Two cracks no farther apart than this belong to one event.
struct Window {
  double reach = 0.0;     ///< [m]
  double duration = 0.0;  ///< [s]
};
/// The mean grain diameter, and the time that a shear wave takes over it. Its speed is sqrt(G / density) with
/// G = E / 2.5, E the modulus of the contacts: known before the test, and nearer than the time is resolved.
Window window_of(const Specimen& specimen);

/// Clusters of cracks that hang together, numbers of cracks in each; both ascend.
std::vector<std::vector<std::size_t>> clusters(std::span<const CrackEvent> cracks, const Window& window);

}  // namespace phy::events
