// Where a specimen fails: how much of it along the bedding, and in which direction its cracks line up.
//
// The direction is that in which most pairs of cracks lie in one line: the method by which planes are found
// in clouds of acoustic events (Fehler, House & Kaieda 1987, with three events in space; in a plane two
// suffice). Of every direction, pairs within one grain diameter d of each other across it are counted, and
// pairs within 3 d. Cracks without a line have a third of the latter among the former. So parallel planes
// count together, and neither the shape of the specimen nor that of the cloud is asked for.
#pragma once
#include <span>
#include <vector>

#include "base/nan.hpp"
#include "records/result.hpp"

namespace phy::analysis {

/// NaN where the cracks do not line up.
struct FailurePlane {
  double angle = nan;   ///< [deg] from +x, anticlockwise like the bedding, -90 < angle <= 90
  double error = nan;   ///< [deg] standard error, from cracks left out by tenths (jackknife)
  double excess = nan;  ///< pairs in one line over as many as spread evenly: 1 no line, 3 all on lines
};
/// `grain`: mean grain diameter [m].
FailurePlane failure_plane(std::span<const CrackEvent> cracks, double grain);

/// bedding_share failure_angle failure_angle_error failure_excess: of the whole test.
std::vector<Number> failure_numbers(std::span<const CrackEvent> cracks, double grain, bool has_planes);

/// Mean and scatter of directions [deg], which are the same half a turn on by doubled angles
/// (Mardia & Jupp 2000).
struct MeanDirection {
  double angle = nan;  ///< -90 < angle <= 90
  double sd = nan;     ///< of deviations from it; from two directions on
};
MeanDirection mean_direction(std::span<const double> angles);

}  // namespace phy::analysis
