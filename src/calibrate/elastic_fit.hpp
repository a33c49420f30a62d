// The elastic stage: E_c, ks_over_kn, k_n, k_s against all E(theta) and nu(theta) at once.
//
// Nonlinear least squares (elastic_problem.hpp; Levenberg-Marquardt, Eigen's port of MINPACK) need a handful
// of evaluations. All joints are in place and the answer is averaged over packings: no macro-micro line is
// assumed, E(90) of a jointed specimen may lie below the intact E. Search on one packing from the least
// squares of Eq. 1, then on all. Where joints are soft, packings differ most: as many are taken as bring the
// standard error of the mean over them below 1 % of E, up to all that there are.
//
// E and nu of a table may belong to no layered elastic body, or to one that joints in an isotropic matrix are
// not: then no parameters have both (elastic_limits.hpp says which). If E misses the table by more than 3 %,
// and by more than the laboratory's scatter explains, while nu is in the fit, the stage is repeated with the
// largest weight of nu that E cannot tell from the least: moduli matter most to an engineer, and the verdict
// tells by how much nu gave way.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "calibrate/parameters.hpp"
#include "calibrate/simulator.hpp"
#include "records/evidence.hpp"

namespace phy::calibrate {

struct ElasticFit {
  Recipe recipe;                        ///< the rock's model with the fitted parameters
  std::vector<Estimate> parameters;     ///< elastic_parameters(), those that the rock has
  std::vector<Comparison> comparisons;  ///< in the order of the targets
  std::vector<Recipe> draws;            ///< of the moduli, jointly (posterior_ensemble.hpp); empty without E
  bool nu_gave_way = false;
  double E_before = 0.0;  ///< where it did: largest relative error of E before
  std::vector<Finding> notes = {};
};

/// Against the moduli of the evidence. Without E the recipe stays as it is. `seeds`: packings; `spare`: more
/// of them, taken in turn where E differs much between packings.
ElasticFit fit_elastic(const Evidence& evidence, const std::vector<std::int64_t>& seeds,
                       const std::vector<std::int64_t>& spare, Simulator& simulator,
                       const std::function<void(const Finding&)>& begins);

}  // namespace phy::calibrate
