#include "verification/contact_witness.hpp"

#include <optional>
#include <variant>

#include "theory/contact_path.hpp"
#include "theory/flat_path.hpp"

namespace phy::verification {
namespace {

using Exact = std::variant<theory::ExactLinear, theory::ExactBond, theory::ExactJoint, theory::ExactFlat>;

/// The closed form of a law, and the seconds that one step takes (dashpots).
std::optional<Exact> exact_form(std::string_view law, std::span<const double> v, double& dt) {
  if (law == "linear") {
    theory::ExactLinear e;
    e.slider = {v[0], v[1], v[2]};
    return e;
  }
  if (law == "dashpot") {
    theory::ExactLinear e;
    const int mode = static_cast<int>(v[6]);
    e.slider = {v[0], v[1], v[2]};
    e.c_n = v[3], e.c_s = v[4];
    // PFC's dp_mode.
    e.no_tension = mode == 1 || mode == 3;
    e.cut_while_slipping = mode == 2 || mode == 3;
    dt = 1.0 / v[5];
    return e;
  }
  if (law == "parallel_bond") return theory::ExactBond{{v[0], v[1], v[2], v[3], v[4], v[5], v[6], {}}};
  if (law == "smooth_joint") {
    theory::ExactJoint e;
    // A smooth joint carries no couple: no bending stiffness, no arm.
    e.cement = {v[0], v[1], 0.0, 0.0, v[3], v[4], v[6], {}};
    e.slider = {v[0], v[1], v[2], v[5]};
    return e;
  }
  if (law == "flat_joint")
    return theory::ExactFlat({v[0], v[1], v[2], v[3], v[4], v[5], v[6], static_cast<int>(v[7]), v[8]});
  return std::nullopt;
}

}  // namespace

std::vector<ContactForces> witness(std::string_view law, std::span<const double> parameters,
                                   std::span<const ContactPoint> corners, int steps) {
  double dt = 0.0;
  std::optional<Exact> at_corner = exact_form(law, parameters, dt);
  if (!at_corner) return {};
  std::vector<ContactForces> forces(1);
  ContactPoint from;
  for (const ContactPoint& corner : corners) {
    // Each step in one piece from the corner: errors of steps cannot add up.
    Exact now = *at_corner;
    for (int i = 1; i <= steps; ++i) {
      now = *at_corner;
      std::visit(
          [&](auto& e) {
            e.leg((static_cast<double>(i) / steps) * (corner - from), i * dt);
            forces.push_back(e.forces());
          },
          now);
    }
    at_corner = now;
    from = corner;
  }
  return forces;
}

}  // namespace phy::verification
