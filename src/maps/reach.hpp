// What the maps say that a model can have of a table: the ground on which a verdict names a cause.
#pragma once
#include <vector>

#include "records/evidence.hpp"
#include "records/finding.hpp"

namespace phy::maps {

/// Of the model that the rock has, by a search that is quick or not: the forecast (`forecast_*`), with the
/// errors that are expected; `map_expected`, where the whole table is met as nearly as its quadratics
/// allow (forecast.hpp); `map_ratio`, UCS over tension of its plausible specimens at inclinations that were
/// mapped, for discs of so many grains, with the names of all models that reach the table's. Nothing of what
/// was not mapped.
std::vector<Finding> reach_of(const Evidence& evidence, bool quick);

}  // namespace phy::maps
