// A bonded assembly seen as a network of springs between rigid bodies: what the stiffness matrix is made of.
//
// Every contact between bodies a and b resists three relative movements at the contact point,
//
//   d        = (u_b - u_a) - (w_a arm_a + w_b arm_b) tangent(branch)
//   closure  = -n.d,   slide = t.d,   rotation = w_b - w_a
//   F_n = k_n closure,   F_s = -k_s slide,   M = -k_m rotation      (laws/law.hpp, also for couplings)
//   force on b = F_n n + F_s t
//
// with the arms R + gap/2 of the present geometry, so that a rigid rotation of the pair moves nothing. n and
// the stiffnesses are those that the contact models state (contact/model.hpp), in two parts: what holds in
// any case, and what only pushes. Which of the unilateral parts act is decided by the caller (uniaxial.hpp);
// `active` says so per link. Overlaps of the packing count as stress-free: a unilateral part acts as soon as
// its grains approach. For a packing with a locked-in stress this is the limit of axial stresses well above
// it.
//
// Platens are bodies like grains, placed after them, with all movements prescribed.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.hpp"
#include "contact/model.hpp"
#include "records/specimen.hpp"

namespace phy::statics {

/// Springs between two bodies.
struct Link {
  std::uint32_t a = 0, b = 0;
  Vec2 branch;         ///< unit vector a -> b
  Vec2 n;              ///< normal of the springs, from a to b
  double arm_a = 0.0;  ///< [m]
  double arm_b = 0.0;  ///< [m]
  Vec2 shift;          ///< periodic cells: the image of b in contact lies at x_b + shift [m]
  contact::ElasticPart k{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  bool unilateral = false;  ///< has a part that only pushes; false: whatever it has also pulls
};

struct Network {
  std::vector<Vec2> x;  ///< centres: grains first, then platens [m]
  std::size_t n_grains = 0;
  double length = 1.0;      ///< a typical arm [m]: compares rotations with displacements
  std::vector<Link> links;  ///< the contacts in their order, then those of platens
  std::size_t n_contacts = 0;
  contact::Models models;
};

enum class Platens { frictionless, glued };

/// The contacts of a specimen, in their order. With a period > 0 along x or y a contact joins a to the
/// nearest image of b. `models`: others than those of the specimen's matrix.
Network make_network(const Specimen& specimen, Vec2 period = {});
Network make_network(const Specimen& specimen, Vec2 period, const contact::Models& models);

/// Adds the bottom and the top platen (bodies n_grains and n_grains + 1) and their links to the grains that
/// touch the lines y = 0 and y = height. Glued: sliding is resisted too and nothing comes off.
void add_platens(Network& network, const Specimen& specimen, Platens platens);

/// Stiffness of a link. `active`: its unilateral part acts.
laws::Tangent<double> stiffness(const Link& link, bool active);

/// Derivative of all links' stiffnesses with respect to a parameter of the matrix, or of bedding set `set`;
/// the specimen is the one that the network was made of.
std::vector<laws::Tangent<double>> stiffness_rates(const Network& network, const Specimen& specimen,
                                                   const std::vector<char>& active,
                                                   const contact::ElasticParameter& parameter,
                                                   std::uint8_t set);

/// Movement of body i: u[3 i] = u_x, u[3 i + 1] = u_y [m], u[3 i + 2] = rotation [rad].
using Movements = std::vector<double>;

/// Uniform displacement gradient du_i/dx_j, added between periodic images.
struct Gradient {
  double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;
  Vec2 operator()(Vec2 p) const { return {xx * p.x + xy * p.y, yx * p.x + yy * p.y}; }
};

/// The three rows of a link over (u_a, w_a, u_b, w_b): closure, slide, rotation.
using LinkRows = std::array<std::array<double, 6>, 3>;
LinkRows rows(const Link& link);

/// Closure, slide and rotation of a link [m, m, rad].
std::array<double, 3> strains(const Link& link, std::span<const double> u, const Gradient& gradient = {});

/// What a stiffness answers closure, slide and rotation with: F_n, -F_s, -M [N/m, N/m, N].
std::array<double, 3> resistance(const laws::Tangent<double>& k, const std::array<double, 3>& strains);

/// Forces F_n, F_s, M of a link (signs: laws/law.hpp) [N/m, N/m, N].
std::array<double, 3> forces(const laws::Tangent<double>& k, const std::array<double, 3>& strains);

/// Stiffness of all links.
std::vector<laws::Tangent<double>> stiffnesses(const Network& network, const std::vector<char>& active);

}  // namespace phy::statics
