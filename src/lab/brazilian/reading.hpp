// Brazilian test: indirect tensile strength, and whether it is one.
//
//   bts              largest tension at the centre that elasticity gives for the platen force,
//                    2P/(pi D t) times Hondros' factor of the arc (docs/theory/brazilian.md)
//   first_crack_y    place of the first crack along the loading diameter, from the centre, over D; +-0.5: rim
//   first_crack_x    the same across it
//   central_cracks   share of the cracks up to the peak that lie in the central third both ways
// The formula holds if the disc splits from its centre. A first crack outside the central third says so in
// the note of bts: the platens broke the rim, the value is then no tensile strength. Source of the test: ISRM
// suggested methods (1978), IJRMMS 15:99-103.
#pragma once
#include <vector>

#include "analysis/branch.hpp"

namespace phy::lab {

constexpr double central_third = 1.0 / 6.0;  ///< of the diameter, to either side of the centre

/// Approach of the jaws over the diameter, in units of tension at the centre over E: 5.5 for arcs of 10
/// degrees on an elastic disc (1 - nu + ln(1 + 4/sin^2 5 deg), Wang et al. 2004, IJRMMS 41:245-253, nu =
/// 0.25), less for wider ones.
constexpr double disc_approach = 5.0;

/// Tension at the centre under arcs of half-angle `alpha` [deg] over that under point loads [-]:
/// (sin 2a - a)/sin a, 1 for a = 0.
double brazilian_arc_factor(double alpha);

/// first_crack_y, first_crack_x, central_cracks [1] of a disc with its centre at (width, height) / 2; NaN
/// with a note without cracks before the peak. `cracks` ordered in time.
std::vector<Number> place_of_splitting(const History& history, const analysis::LoadingBranch& branch,
                                       const std::vector<CrackEvent>& cracks, double diameter);

/// All numbers of a disc of that diameter [m] and density [kg/m^3].
std::vector<Number> disc_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                 double diameter, double density);

}  // namespace phy::lab
