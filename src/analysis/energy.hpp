// Where the platens' work went, and whether the test can be believed: energy balance, inertia, both platens
// alike.
#pragma once
#include <vector>

#include "analysis/branch.hpp"

namespace phy::analysis {

/// What a stress wave runs through. With density or length 0 the number of its transits is not known.
struct WavePath {
  double density = 0.0;         ///< [kg/m^3]
  double length = 0.0;          ///< between the bodies [m]
  double modulus_factor = 1.0;  ///< modulus of the rock over stress / strain of this test, of an elastic body
};

/// Work and each term of the balance [J per m thickness]: energy_boundary_work, energy_kinetic, ... in the
/// last row, and the same with _at_peak. NaN with a note when the history holds no energies (laboratory,
/// other programs).
std::vector<Number> energy_budget(const LoadingBranch& branch, const History& history);

/// Checks, all [1]:
///   energy_error         largest |work not accounted for| of any row / largest boundary work of the test
///   energy_error_of_row  largest |energy_error| of any row, each over the work up to its own row (large
///                        where the work has hardly begun)
///   kinetic_ratio        largest kinetic / stored energy from 20 % of ucs to the peak; quasi-static: well
///                        below 1e-2
///   platen_difference    largest |top - bottom platen stress| / ucs before the peak; and _95: not exceeded
///                        by 95 % of rows
///   peak_confirmed       fall of stress behind the peak / 20 %, or strain behind it / 50 %, the larger
///   rows_to_peak         rows of the history up to the peak
///   wave_transits        how often a wave crosses the specimen while the stress rises to its peak
std::vector<Number> run_checks(const LoadingBranch& branch, const History& history, const WavePath& path);

}  // namespace phy::analysis
