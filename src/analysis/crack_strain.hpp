// Crack initiation as a laboratory reads it, from gauges: the method of crack volumetric strain of Martin &
// Chandler 1994 (IJRMMS 31:643-659), as reported by Nicksiar & Martin 2012 (RMRE 45:607-617).
//
// The crack volumetric strain is what the elastic rock leaves of the volumetric strain,
//
//   eps_crack = eps_a + 2 eps_l - (1 - 2 nu)/E sigma
//
// eps_a, eps_l strains of the gauge, E and nu their slopes between 10 and 25 % of the strength: lower down
// stress waves have not evened out, higher up cracks may have begun. It is level until cracks open, and falls
// from then on. The initiation is the last row before the peak that still lies on the level: the higher of
// the mean between 10 and 25 % and the largest value less its noise. A row lies on the level if it is no
// further below than the larger of 3 standard errors of a single value predicted from the rows between 10 and
// 25 % (their noise, and that of E and nu, which grows with the distance), and 0.5 % of strength / E, which
// gauges resolve. Range, number of standard errors and resolution are choices of this program.
#pragma once
#include "analysis/branch.hpp"

namespace phy::analysis {

/// sigma_ci_strain [Pa]. NaN with a note: no peak, too few rows in the range, no fall before the peak. What
/// begins below 25 % of the strength bends the lines of E and nu, and is read too high.
Number crack_initiation_by_strain(const LoadingBranch& branch);

}  // namespace phy::analysis
