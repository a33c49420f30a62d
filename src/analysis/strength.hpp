// Strength and the two stresses at which damage begins, of a compression test.
//   ucs        largest axial stress; no smoothing, no parabola through the neighbours: the definition of the
//              laboratory
//   sigma_ci   crack initiation: axial stress at crack number max(3, 1 % of the cracks at the peak). The 1 %
//              rule is that of Potyondy & Cundall 2004 (IJRMMS 41:1329-1364); at least three, because single
//              weak bonds break early
//   sigma_cd   crack damage: axial stress where the volumetric strain, axial + lateral, turns from shortening
//              to dilation. Source of the idea: Martin & Chandler 1994 (IJRMMS 31:643-659)
#pragma once
#include <vector>

#include "analysis/branch.hpp"

namespace phy::analysis {

/// ucs [Pa] and peak_strain [1] (platens). NaN with a note when the stress never falls again.
std::vector<Number> strength(const LoadingBranch& branch);

/// sigma_ci and sigma_first_crack [Pa]. A crack from before the first row, or from an affine pre-strain up to
/// the axial strain `pre_strain`, gives an upper bound: the note then begins with "below". Cracks may come
/// in any order.
std::vector<Number> crack_initiation(const LoadingBranch& branch, const std::vector<CrackEvent>& cracks,
                                     double pre_strain);

/// sigma_cd [Pa]. NaN with a note when the volumetric strain does not turn before the peak.
Number crack_damage(const LoadingBranch& branch);

}  // namespace phy::analysis
