// The elastic stage: E_c, ks_over_kn, k_n, k_s against all E(theta) and nu(theta) at once.
//
// The direct solution gives E, nu and their exact derivatives, so nonlinear least squares
// (Levenberg-Marquardt, Eigen's port of MINPACK) over the logarithms of the parameters needs a handful of
// evaluations. All joints are in place and the answer is averaged over packings: no macro-micro line is
// assumed, E(90) of a jointed specimen may lie below the intact E. Search on one packing from the least
// squares of Eq. 1, then on all.
//
//   minimise  sum ((log E_i - log E_lab,i)/s_i)^2 + sum ((nu_i - nu_lab,i)/s_i)^2
//             + sum ((x_j - x_usual,j)/s_j)^2
//
// s_i^2: squared standard errors of the laboratory's mean (at least 0.5 %; 0.005 for nu) and of the mean over
// packings. Where joints are soft, packings differ most: as many packings are taken as bring that error below
// 1 % of E, up to all that there are. The last sum is weak (half of the box of parameters.hpp is one standard
// deviation); it keeps what the data do not determine at usual values.
//
// Contacts pull as well as push in all of this (bilateral: one linear solution each). What one-sided contacts
// make of it is measured once, where the search ends, on the first five packings: a factor on E and an
// addition to nu for each angle. The factor (0.97-0.98) differs by 0.2-0.5 % between packings, while E itself
// differs by 3-20 %, so five packings give it to 0.2 %; and it hardly moves with the parameters. The
// verification solves the one-sided contacts themselves.
//
// E and nu of a table may belong to no layered elastic body, or to one that joints in an isotropic matrix are
// not: then no parameters have both (elastic_limits.hpp says which). If E misses the table by more than 2 %,
// and by more than the laboratory's scatter explains, while nu is in the fit, the stage is repeated with nu
// at a tenth of its weight: moduli matter most to an engineer, and the verdict tells by how much nu gave way.
#pragma once
#include <Eigen/Dense>
#include <functional>
#include <string>
#include <vector>

#include "calibrate/simulator.hpp"
#include "records/calibration.hpp"

namespace phy {

/// Largest deviation of mean E from the laboratory that passes without a word.
constexpr double elastic_tolerance = 0.02;
constexpr double nu_tolerance = 0.03;
/// Standard errors that the largest of seven cells exceeds in 5 % of tables.
constexpr double z_seven = 2.69;

/// By how much E (relative) or nu may miss the table without a word: 2 % or 0.03, or what the scatter of the
/// laboratory explains. An assumed scatter explains nothing.
double modulus_limit(const Target& t);
bool misses(const Comparison& modulus);

struct ElasticFit {
  Recipe recipe;                              ///< the rock's model with the fitted parameters
  std::vector<ParameterEstimate> parameters;  ///< elastic_parameters(), those that the rock has
  std::vector<Comparison> comparisons;        ///< in the order of the targets
  bool nu_gave_way = false;
  double E_before = 0.0;              ///< where it did: largest relative error of E before
  std::vector<std::string> findings;  ///< limits that the fit ran into; empty: within tolerance
  bool out_of_reach = false;
  std::int64_t n_solutions = 0;
};

/// `all`: E and nu count, others are passed over. Without E the recipe stays as it is. `seeds`: packings;
/// `spare`: more of them, taken in turn where E differs much between packings.
ElasticFit fit_elastic(const Rock& rock, const std::vector<Target>& all,
                       const std::vector<std::int64_t>& seeds, const std::vector<std::int64_t>& spare,
                       Simulator& simulator, const std::function<void(const std::string&)>& say);

/// Mean E and nu of a recipe at the angles of the targets over packings, one-sided contacts.
std::vector<Comparison> elastic_response(const Recipe& recipe, const std::vector<Target>& all,
                                         const std::vector<std::int64_t>& seeds, Simulator& simulator);

/// The recipe's one specimen at an angle of the table, on the packing of a seed.
Recipe single_at(const Recipe& recipe, double theta, std::int64_t seed);

}  // namespace phy
