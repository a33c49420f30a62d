// Closed forms beside the contact bench: the law's name and parameters as the list has them, the answer from
// theory/contact_path.
#pragma once
#include <span>
#include <string_view>
#include <vector>

#include "records/contact_path.hpp"

namespace phy::verification {

/// Forces that the closed form gives at every row of `drive(contact, corners, steps)`, each solved in one
/// piece from the last corner. `parameters` in the order of the law's schema; empty when no closed form is
/// known.
std::vector<ContactForces> witness(std::string_view law, std::span<const double> parameters,
                                   std::span<const ContactPoint> corners, int steps);

}  // namespace phy::verification
