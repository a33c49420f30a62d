// Biaxial compression: peak strength under confinement. Numbers of the press, read on the deviatoric stress.
//
//   q_max               largest deviatoric stress sigma_1 - sigma_3; of a test that hardens that of the first
//                       peak or the knee (analysis/strength_rule.hpp)
//   sigma_1, sigma_3    axial and lateral stress at that moment
//   confinement_error   largest |lateral stress / target - 1| from the start of loading to the peak
// E, nu and the stresses of damage are those of the press with the deviatoric stress in the place of the
// axial stress: sigma_3 is constant, so slopes are the same, and levels are fractions of q_max.
#pragma once
#include <vector>

#include "analysis/branch.hpp"
#include "analysis/energy.hpp"

namespace phy::lab {

/// The history with the deviatoric stress in the place of the axial stress; both platens alike.
History deviatoric(History history);

/// sigma_1, sigma_3 [Pa] and confinement_error [1] of a history as recorded, whose deviatoric branch is
/// given.
std::vector<Number> confined_strength(const History& history, const analysis::LoadingBranch& branch,
                                      double confining_stress);

/// All numbers of a history as recorded. `path`: of a wave between the platens.
std::vector<Number> confined_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                     double confining_stress, const analysis::WavePath& path,
                                     const analysis::StopRule& stop = {});

}  // namespace phy::lab
