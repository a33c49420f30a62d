// Elastic moduli and Poisson's ratio of a compression test, along the line of loading.
//
// The modulus depends on where on the curve it is read: cracks close, then open. So every definition carries
// its range.
//   tangent   slope of the straight line fitted to stress over strain in a range of stress, usual: 40-60 %
//             of ucs
//   secant    stress / strain at one level, usual: 50 % of ucs; counts from the history's zero of strain
//   nu        -slope of lateral over axial strain in the same range
// The fit is plain least squares of stress on strain: the strains are far less noisy than the platen forces.
// Read as plane stress these are E and nu of the rock; a plane-strain reading needs E (1 - nu'^2), nu' = nu /
// (1 + nu). Source of tangent and secant at 50 %: Bieniawski & Bernede 1979, ISRM suggested methods for the
// uniaxial compressive strength and deformability of rock (IJRMMS 16:135-140).
#pragma once
#include <string>
#include <vector>

#include "analysis/branch.hpp"

namespace phy::analysis {

/// Modulus as the slope in a range of stress [Pa]. NaN with a note: fewer than 3 rows in the range, strain at
/// rest. With a note beside the value: no peak (fractions of the largest stress), range not covered, points
/// off the line.
Number tangent_modulus(const LoadingBranch& branch, StressRange range, StrainFrom from, std::string name);

/// Modulus as stress / strain at a fraction (0 to 1) of the largest stress, interpolated between rows [Pa].
Number secant_modulus(const LoadingBranch& branch, double fraction, StrainFrom from, std::string name);

/// Poisson's ratio: lateral strain of the gauge over the axial strain named. Notes as for tangent_modulus.
Number poisson_ratio(const LoadingBranch& branch, StressRange range, StrainFrom from, std::string name);

/// Whether the range that E_tangent and nu are read in is one of an elastic body, all [1]:
///   area_change       shortening of the area over axial strain, 1 - nu: below 0 the specimen grows as it is
///                     pressed, which no elastic body does
///   nu_spread         half the difference of nu between the halves of the range
///   cracks_in_window  cracks of the range over those up to the strength; fewer than three are chance and
///                     count as none
/// Where the range has too few rows they are not known.
std::vector<Number> window_checks(const LoadingBranch& branch, const std::vector<CrackEvent>& cracks,
                                  StressRange range);

}  // namespace phy::analysis
