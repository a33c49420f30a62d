// THE list of parameters that a calibration moves, with the box of values it admits.
//
// Elastic: E_c (E_b follows), ks_over_kn (of contacts and bonds alike), k_n, k_s of the joints. Strength:
// sigma_c and five ratios, because UCS grows in proportion to all strengths together and the ratios alone
// give the shape of UCS(theta): tau_c/sigma_c, mu, C/tau_c, sigma_n/C, mu of the joints. Standard deviations
// of the bond strengths keep their share of the mean.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "records/recipe.hpp"

namespace phy {

struct Parameter {
  std::string key;     ///< "matrix.E_c", or a ratio "tau_c/sigma_c"
  std::string symbol;  ///< "E_c"
  std::string unit;    ///< SI
  bool joint = false;  ///< needs bedding
  /// Admissible values: absolute for pure numbers; of quantities, multiples of their scale (E of the rock,
  /// E/spacing, largest UCS).
  double low = 0.0, high = 0.0;
  double usual = 0.0;  ///< where the data do not speak, in the same measure
  std::function<double(const Recipe&)> get;
  std::function<void(Recipe&, double)> set;
};

/// E_c, ks_over_kn, k_n, k_s, in this order.
const std::vector<Parameter>& elastic_parameters();
/// sigma_c, tau_c/sigma_c, mu, C/tau_c, sigma_n/C, mu_sj, in this order. `set` of a ratio leaves its
/// denominator alone and moves what is measured against its numerator: set them in the order of the list.
const std::vector<Parameter>& strength_parameters();

}  // namespace phy
