// Where a table lies in the maps of what models reach, before anything runs.
#pragma once
#include <optional>
#include <vector>

#include "maps/response_map.hpp"
#include "records/calibration.hpp"
#include "records/finding.hpp"

namespace phy::maps {

/// The plausible point of a mapped model that is nearest to a table by E and strengths, both scales (of
/// moduli and of strengths) free.
struct ClosestMapped {
  const MappedModel* model = nullptr;
  int n_points = 0;    ///< plausible ones that answer all of the table
  double error = 0.0;  ///< root mean square over all E and strengths, relative; NaN: too little to compare
};

/// One per model that may stand for the rock: isotropic ones without bedding, else the layered ones. Moduli
/// by E at small strain, or as tangents whichever part of the curve the table's E is of. Direct tension of
/// layered rock was not mapped and is left out.
std::vector<ClosestMapped> closest_mapped(const Evidence& evidence);

/// `map_ratio` of each tension beside UCS at an inclination that was mapped: what these models reach.
std::vector<Finding> ratios_in_maps(const Evidence& evidence, const std::vector<const MappedModel*>& models);

/// `nearest_in_maps`: a calibrated model held against the maps by E, nu as a test reads it, and strengths,
/// scales free on both sides, in units of the tolerances, and whether one of the other models, or another
/// search, may come nearer. Specimens of the maps lie far apart: that none is nearer does not prove that none
/// can be (docs/calibration.md, "Verdict"). `tried`: the model, then others that a calibration was made by.
/// `found`: what the model answers. Nothing where there is too little to compare.
std::optional<Finding> against_maps(const Evidence& evidence, const std::vector<Recipe>& tried,
                                    const std::vector<Comparison>& found);

/// The closest points, and UCS over tension of the table and of the maps where the table has both.
std::vector<Finding> place_in_maps(const Evidence& evidence);

}  // namespace phy::maps
