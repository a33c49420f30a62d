// Where a table lies in the maps of what models reach, before anything runs.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "calibrate/evidence.hpp"
#include "calibrate/reach.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

/// The sensible point of a family that is nearest to a table by E and strengths, both scales (of moduli and
/// of strengths) free.
struct NearestPoint {
  const ModelFamily* family = nullptr;
  int n_points = 0;    ///< sensible ones that answer all of the table
  double error = 0.0;  ///< root mean square over all E and strengths, relative; NaN: too little to compare
};

/// One per family that may model the rock: isotropic ones without bedding, else the layered ones. Moduli by
/// E at small strain, or as tangents whichever part of the curve the table's E is of. Direct tension of
/// layered rock was not mapped and is left out.
std::vector<NearestPoint> nearest_points(const Evidence& evidence);

/// A calibrated model held against the maps by E, nu as a test reads it, and strengths, scales free on both
/// sides, in units of the tolerances (margin.hpp): whether one of the other models, or another search, may
/// come nearer. Specimens of the maps lie far apart: that none is nearer does not prove that
/// none can be (docs/calibration.md, "Verdict"). `tried`: the model, then others that a calibration was made
/// by. `found`: what the model answers. Nothing where there is too little to compare.
std::optional<Finding> against_maps(const Evidence& evidence, const std::vector<Recipe>& tried,
                                    const std::vector<Comparison>& found);

/// The nearest points in sentences, with UCS over tension of the table and of the maps where the table has
/// both.
std::vector<std::string> place_in_maps(const Evidence& evidence);

}  // namespace phy::calibrate
