// Which bodies can move without resistance? Asked before factoring, so that a singular matrix never comes up.
//
// Bodies are gathered into rigid clusters: at first one per body, then two clusters become one whenever the
// links between them leave no relative rigid motion (the 3 x 3 Gram matrix of their rows has full rank),
// until nothing changes. Prescribed movements are links to the ground. What does not end up in the cluster of
// the ground is *loose*: rattlers, grains that hang on one joint, parts without contact. (Three clusters
// hinged to a triangle are rigid although no pair is; they count as loose too. That is on the safe side:
// loose bodies get weak springs to the ground, 1e-9 of a contact, which a body held by real contacts does not
// feel.) In a periodic cell a part that is linked to its own image cannot turn.
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "statics/network.hpp"

namespace phy::statics {

/// A degree of freedom: component 0 = u_x, 1 = u_y, 2 = rotation.
struct Freedom {
  std::uint32_t body = 0;
  int component = 0;
};

/// Per body: 1 = loose.
std::vector<char> loose_bodies(const Network& network, const std::vector<laws::Tangent<double>>& k,
                               const std::vector<Freedom>& prescribed);

/// Number of the connected part that each body belongs to (the lowest body in it); links of zero stiffness do
/// not count.
std::vector<std::uint32_t> connected_parts(const Network& network,
                                           const std::vector<laws::Tangent<double>>& k);

}  // namespace phy::statics
