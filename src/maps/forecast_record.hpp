// How forecasts have done: of synthetic rock, whose end is known, and of the measured rocks that come with
// the program.
#pragma once
#include <string_view>

#include "maps/mapped_model.hpp"
#include "records/finding.hpp"

namespace phy::maps {

/// Of synthetic specimens by this model, by a table with columns "models", "wrong" and "of"
/// (data/rocks/synthetic_forecasts.csv).
Finding record_of(const MappedModel& model, std::string_view csv);

/// How often errors of measured rocks came out in the range that was expected of them, by a table with
/// columns "low", "high" and "reached" (data/rocks/forecasts.csv, which `make rocks` writes).
Finding record_on_rocks(std::string_view csv);

}  // namespace phy::maps
