// Constants of a rock from those of the draws of its calibration (Rubin 1987, multiple imputation).
//
// Draws are sets of parameters that the laboratory's table allows, each on a packing of its own. Each gives
// constants x_k with the covariance U_k of their fit. Their mean is the estimate; its variance is
//   T = mean U + (1 + 1/m) B,   B: covariance of the x_k
// and the interval is Student's, with (m - 1) (1 + mean U/((1 + 1/m) B))^2 degrees of freedom. So it holds
// what the table leaves open, the scatter of packings, and what the law is wrong by; few draws make it wide.
#pragma once
#include "design/fit.hpp"

namespace phy::design {

struct ConstantEstimate {
  Key key;
  double value = nan, low = nan, high = nan;  ///< SI; 95 % interval
  double se = nan;                            ///< SI
  std::size_t n_draws = 0;                    ///< with this constant
};

/// Of all draws together.
struct Pooled {
  std::vector<ConstantEstimate> constants = {};
  Eigen::MatrixXd covariance = {};  ///< of the values [SI], in the same order
  double error = nan;               ///< of the fits, root mean square over the draws [-]
  double left_out = nan;            ///< left_out_error() of the means over the draws [-]
  std::size_t n_draws = 0, n_without = 0;
  Refusal refusal = Refusal::too_few;  ///< of most draws without constants, where no two draws have any

  bool ok() const { return refusal == Refusal::none; }
  /// nullptr: it has none.
  const ConstantEstimate* find(const Key& key) const;
  double value(const Key& key) const;
  /// The means as a fit, for what laws predict.
  Fit mean() const;
};

/// Needs two draws with a fit.
Pooled pool(const std::vector<Fit>& draws);

}  // namespace phy::design
