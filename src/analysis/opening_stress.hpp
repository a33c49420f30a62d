// The rock around a circular opening, from grains and contacts: stress behind its wall, motion of the wall,
// and breakout.
//
// Stress. The force that a radial cut carries per length is the hoop stress, exactly, in whatever way the
// contacts share it; but a short cut meets few contacts, and the next cut others. So all radial cuts of a
// sector are taken, and their mean: a contact counts with the angle that its branch spans. A mean over the
// area of the sector would scatter as little, but no cut would be in balance with it. With F the force of a
// contact on its second grain and l its branch, in a sector of the angle w between the radii r_1 and r_2,
//
//   sigma_ij = 1/(w (r_2 - r_1)) sum_c  integral over the branch inside of  F_i dl_j / r
//
// i and j in the polar axes of each place: the mean over angle and radius of forces across radial cuts (j the
// hoop) and across arcs (j the radius), per length. Shear is the mean of both. Couples of bonds do not enter.
// Compression is positive.
//
// Breakout. Rock that hangs on the rest by no unbroken bond has fallen. The depth in one direction is how
// much farther a ray from the middle goes until it meets a grain of the body, than it went at the start. So
// neither the roughness of the wall nor a hollow between two of its grains counts; a wall that moves inwards
// has a small negative depth. Grains are where they are now.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/nan.hpp"
#include "records/result.hpp"

namespace phy::analysis {

/// A circular opening at the start of a test [m].
struct OpeningPlace {
  Vec2 centre;
  double radius = 0.0;
};

/// Sectors are all alike; the first has its middle on +x.
struct SectorStress {
  double angle = 0.0;                            ///< of its middle, from +x, anticlockwise [deg]
  double radial = 0.0, hoop = 0.0, shear = 0.0;  ///< [Pa]
};

/// Between two radii [m], 0 < inner < outer.
struct Ring {
  Vec2 centre;
  double inner = 0.0, outer = 0.0;
};
std::vector<SectorStress> stress_around(const Packing& packing, const Snapshot& snapshot, const Ring& ring,
                                        int n_sectors);

/// The grains of the largest body that unbroken bonds and joints hold together, true per grain.
std::vector<bool> standing_body(const Specimen& specimen, const Snapshot& snapshot);

/// How the wall has moved: its grains are those through which the circle of the opening went at the start,
/// and which still belong to the body.
struct WallMotion {
  std::vector<double>
      inwards;           ///< mean displacement towards the centre per sector [m]; NaN: no grain is left
  double closure = nan;  ///< mean over the sectors that have grains, over the radius [-]
};
/// `since`: the moment from which displacements count; none: the start of the test.
WallMotion wall_motion(const Specimen& specimen, const Snapshot& snapshot, const OpeningPlace& opening,
                       int n_sectors, const Snapshot* since = nullptr);

/// Depth of breakout [m] along `n_rays` >= 1 rays, the first along +x. Infinite where a ray meets no grain of
/// the body any more, NaN where it met none at the start.
std::vector<double> breakout_depths(const Specimen& specimen, const Snapshot& snapshot, Vec2 centre,
                                    int n_rays);

/// A breakout as a caliper in a borehole shows it.
struct Breakout {
  double depth = 0.0;      ///< largest [m]; infinite: through to the outside
  double direction = nan;  ///< of the axis of both sides [deg], 0 <= direction < 180; NaN: no breakout
  double clarity = 0.0;    ///< of that direction: 1 all depth on one axis, 0 equally deep all round
  std::array<double, 2> width = {0.0, 0.0};  ///< [deg] of broken wall within 90 deg of it, and opposite
};
/// The direction is the mean of doubled angles, weighted by depth. `least` [m]: a wall less deep is whole; a
/// mean grain radius is more than any wall moves, and less than what a lost grain leaves.
Breakout breakout_of(std::span<const double> depths, double least);

}  // namespace phy::analysis
