// What closed forms say of a table before any model of discs: Eq. 1 through E(theta) (theory/eq1_fit.hpp), a
// plane of weakness through UCS(theta) (theory/jaeger_fit.hpp), and how anisotropic the rock is.
#pragma once
#include <vector>

#include "records/evidence.hpp"
#include "records/finding.hpp"

namespace phy::survey {

/// E, K_n delta, K_s delta with standard errors, R2 and the course of E by them (shoulder or incremental), or
/// why Eq. 1 has none; nothing with E at fewer than three angles. As the table reads, whichever E it is.
std::vector<Finding> eq1_through_moduli(const Evidence& evidence);

/// Cohesion and friction of the plane, where it is weakest, shoulders, R2 and root mean square miss, or why
/// there is none; nothing with UCS at fewer than four angles.
std::vector<Finding> plane_through_strengths(const Evidence& evidence);

/// Largest over least value of E and of each strength, where they were tested at several angles.
std::vector<Finding> anisotropy(const Evidence& evidence);

/// All that there are of the three; none of a rock without bedding.
std::vector<Finding> closed_forms(const Evidence& evidence);

}  // namespace phy::survey
