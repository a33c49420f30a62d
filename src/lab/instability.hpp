// Why a test has blown up, as far as its recipe and its last good state tell.
#pragma once
#include <string>

#include "engine/boundary.hpp"
#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy::lab {

/// What to change, the likeliest first. `last`: the last row that the watchdog has let pass; zeros if there
/// was none. A grain that `outran` its list of near pairs blames the interval at which that is made anew, and
/// the time step is blamed, only where nothing else is out of the ordinary.
std::string advice_on_instability(const Specimen& specimen, const Recipe& recipe,
                                  const engine::Boundary& boundary, const HistoryRow& last,
                                  bool outran = false);

}  // namespace phy::lab
