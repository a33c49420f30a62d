// Opening under stress: what is read from its history and from the rock around it.
//
//   collapse_stress     largest vertical stress that the opening bears (opening.hpp), and over
//                       test.vertical_stress collapse_factor
//   closure             when it stood: mean displacement of its wall inwards / radius
//   hoop_max, hoop_min  hoop stress when it stood, the largest and the smallest of 36 sectors; mean over the
//                       ring from one to five mean grain diameters behind the wall, whose middle is three
//   breakout_depth      when it stood: how deep rock without a bond to the rest reaches, over the radius
//   breakout_width      of the wall that it takes, mean of the two sides [deg]
//   ..._direction       from the horizontal, anticlockwise, 0 to 180 [deg]; as a caliper or borehole pictures
//                       show it; of a breakout only where it lies on an axis
//   ..._at_end          the same when the test ended
//   wall_to_edge        share of the wall whose loose rock then reaches the edge of the block
#pragma once
#include <array>
#include <optional>

#include "analysis/branch.hpp"
#include "analysis/energy.hpp"
#include "analysis/opening_stress.hpp"

namespace phy::lab {

constexpr double collapsed = 0.05;                       ///< closure over the radius that ends a test
constexpr std::array<double, 2> hoop_ring = {1.0, 5.0};  ///< mean grain diameters behind the wall
constexpr int n_wall_sectors = 36;

/// Where an opening is, and the moment from which its wall moves.
struct OpeningBegin {
  analysis::OpeningPlace place;
  Snapshot shot;
};

/// The rock around an opening at one moment.
struct OpeningState {
  double closure = 0.0;
  std::vector<WallPoint> points;  ///< one per sector
  analysis::Breakout breakout;
};

/// `row`: of the history now.
OpeningState opening_state(const Specimen& specimen, const OpeningBegin& begin, const Snapshot& now,
                           const HistoryRow& row, WallMoment moment);

struct OpeningReading {
  double vertical_stress = 0.0, radius = 0.0;  ///< [Pa], [m]
  bool raised = false;                         ///< it stood, and the stress was raised: it may have fallen
  std::optional<OpeningState> standing;        ///< none: it did not stand
  std::optional<OpeningState> at_end;          ///< none: the excavation did not begin
  analysis::WavePath path;                     ///< between bottom and top
};

/// All numbers above and those that every test has; `diameter`: of a mean grain [m].
std::vector<Number> opening_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                    const OpeningReading& read, double diameter);

}  // namespace phy::lab
