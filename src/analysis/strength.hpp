// Strength and the stresses at which damage begins, of a compression test.
//   ucs              Largest axial stress; no smoothing, no parabola through the neighbours: the definition
//                    of the laboratory. Of a test that hardens its first peak or knee (strength_rule.hpp).
//   sigma_ci         Crack initiation by count: axial stress at crack number max(3, 1 % of the cracks at the
//                    peak). The 1 % rule is that of Potyondy & Cundall 2004 (IJRMMS 41:1329-1364); at least
//                    three, because single weak bonds break early. No laboratory counts broken bonds.
//   sigma_ci_strain  Crack initiation as a laboratory reads it: crack_strain.hpp.
//   sigma_cd         Crack damage: axial stress where the volumetric strain of two dimensions (axial plus
//                    lateral) turns from shortening to dilation. Source of the idea: Martin & Chandler 1994
//                    (IJRMMS 31:643-659).
//   sigma_cd_volume  The same of axial + 2 lateral strain, as a laboratory computes it from two gauges. What
//                    is elastic shortens by 1 - 2 nu of the axial strain: near nu = 0.5 noise decides where
//                    that turns, so it is read for nu below 0.45 only.
#pragma once
#include <string>
#include <vector>

#include "analysis/branch.hpp"

namespace phy::analysis {

/// ucs [Pa] and peak_strain [1] (platens). NaN with a note when there is neither peak nor knee.
std::vector<Number> strength(const LoadingBranch& branch);

/// strength_rule [1] (1 peak, 2 knee, 3 largest) and largest_stress [Pa], of tests that may harden; else
/// none.
std::vector<Number> strength_rule(const LoadingBranch& branch);

/// What the strength has to say: that it is a knee or a first peak, and what the stress rises to later; that
/// there is none; nothing of a peak.
std::string strength_note(const LoadingBranch& branch);

/// sigma_ci and sigma_first_crack [Pa]. A crack from before the first row, or from an affine pre-strain up to
/// the axial strain `pre_strain`, gives an upper bound: the note then begins with "below". Cracks may come
/// in any order.
std::vector<Number> crack_initiation(const LoadingBranch& branch, const std::vector<CrackEvent>& cracks,
                                     double pre_strain);

/// sigma_cd [Pa]. NaN with a note when the volumetric strain does not turn before the peak.
Number crack_damage(const LoadingBranch& branch);

/// sigma_cd_volume [Pa]. NaN with a note as well where nu is 0.45 or more, or not known.
Number crack_damage_volume(const LoadingBranch& branch);

}  // namespace phy::analysis
