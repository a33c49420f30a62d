// What closed forms say of a table before any model of discs: Eq. 1 through E(theta) (theory/eq1_fit.hpp), a
// plane of weakness through UCS(theta) (theory/jaeger_fit.hpp), and how anisotropic the rock is.
#pragma once
#include <string>
#include <vector>

#include "calibrate/evidence.hpp"

namespace phy::calibrate {

/// E, K_n delta, K_s delta with standard errors, R2 and type of the course (shoulder or incremental), or why
/// Eq. 1 has none; empty with E at fewer than three angles. As the table reads, whichever E it is.
std::string eq1_line(const Evidence& evidence);

/// Cohesion and friction of the plane, where it is weakest, shoulders, R2 and root mean square error, or why
/// there is none; empty with UCS at fewer than four angles.
std::string jaeger_line(const Evidence& evidence);

/// Largest over least value of E and of each strength, where they were tested at several angles.
std::string anisotropy_line(const Evidence& evidence);

/// Those of the three that there are; none of a rock without bedding.
std::vector<std::string> closed_forms(const Evidence& evidence);

}  // namespace phy::calibrate
