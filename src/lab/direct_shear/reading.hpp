// Direct shear: peak and residual strength of a plane, its stiffness and dilation.
//
//   tau_peak, u_peak   largest shear stress and the shear displacement there
//   tau_residual       mean shear stress over the last quarter of the shear displacement
//   sigma_n            mean normal stress up to the peak
//   sigma_n_error      its largest relative deviation from the normal load asked for, from the start to the
//                      peak
//   sigma_n_error_rms  root mean square of that deviation; and _residual: over the last quarter
//   box_lifted         share of the rows that tau_residual or dilation is read from in which the boxes hardly
//                      touch: a normal stress below 5 % of the load asked for
//   K_s                slope of shear stress over shear displacement between 40 and 60 % of tau_peak
//   mu_residual        tau_residual over the mean normal stress there
//   dilation           angle of dilation: slope of opening over shear displacement in the second half of the
//                      sliding after the peak (at the peak itself the stored slip is let go at once)
#pragma once
#include <vector>

#include "analysis/branch.hpp"

namespace phy::lab {

/// Normal load that the box was to keep: stress + stiffness * dilation [Pa, Pa/m].
struct NormalLoad {
  double stress = 0.0;
  double stiffness = 0.0;
};

/// The numbers above.
std::vector<Number> plane_numbers(const History& history, const analysis::LoadingBranch& branch,
                                  const NormalLoad& load);

/// All numbers of a shear test.
std::vector<Number> shear_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                  const NormalLoad& load);

}  // namespace phy::lab
