// The moduli of a table as theories of layered bodies take them.
#pragma once
#include <vector>

#include "records/evidence.hpp"
#include "theory/eq1_fit.hpp"
#include "theory/layered_fit.hpp"

namespace phy::maps {

/// Eq. 1 through E(theta) with everything free; it may refuse.
theory::Eq1Fit eq1_through(const Evidence& evidence);

/// E and nu under the least stress, with the errors that count.
std::vector<theory::LayeredReading> layered_readings(const std::vector<Target>& targets);

}  // namespace phy::maps
