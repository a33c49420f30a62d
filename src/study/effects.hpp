// What the parameters do: from the results of a study to curves, regressions and sensitivity indices.
//
// A response is one number of one specimen of the design ("ucs" at 30 degrees), or one that needs all angles
// of a point: the macro joint stiffnesses K_n and K_s by Eq. 1 (theory/eq1_fit.hpp). Every effect is computed
// on each replicate (packing and bond seed) by itself; then mean and 95 % interval over the replicates are
// taken. What a single packing shows is one draw from a distribution. Tests that did not peak are left out:
// what they carried most is no strength; and so are untrusted ones (records/quality.hpp), unless asked for;
// and specimens without a direct solution.
//
//   one_at_a_time      line over the points of one parameter: slope, intercept, R2, standard errors, and the
//                      change from the lowest to the highest level
//   sampled designs    one plane over all parameters: slopes, standard errors, R2
//   morris             mu (mean), mu* (mean of magnitudes; Campolongo et al. 2007, Environmental Modelling &
//                      Software 22:1509-1518) and sigma of the change of the response per full range of the
//                      parameter; a sigma near mu* indicates curvature or interaction
//   saltelli           share of the variance that a parameter explains alone (first order, Saltelli et al.
//                      2010) and with all its interactions (total, Jansen 1999, Computer Physics
//                      Communications 117:35-43)
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/stats.hpp"
#include "study/plan.hpp"
#include "study/store.hpp"
#include "theory/eq1_fit.hpp"

namespace phy::study {

using StudyRows = std::vector<std::optional<StoredResult>>;  ///< belonging to Plan::tests

/// Untrusted tests as if they had peaked and nothing more: for those who ask for means and fits with them.
StudyRows with_untrusted(StudyRows rows);

/// A response at every point on every replicate; NaN where there is none.
struct Response {
  std::string number;                       ///< "ucs", "K_n"
  std::string unit;                         ///< "Pa"
  std::string specimen;                     ///< "theta = 30 deg", "intact"; "all angles"
  std::vector<std::vector<double>> values;  ///< by replicate, then by point

  Summary at(std::size_t point) const;  ///< over the replicates
};

/// One number, for every specimen of the design.
std::vector<Response> responses(const Plan& plan, const StudyRows& rows, const std::string& number);

/// Eq. 1 on every replicate and point whose moduli are all there.
struct JointFits {
  std::vector<std::vector<std::optional<theory::Eq1Fit>>> fits;  ///< by replicate, then by point
  Response K_n, K_s;                                             ///< [Pa/m]
  Response R2;                                                   ///< of Eq. 1, in modulus
  std::vector<Response> E;                                       ///< E of Eq. 1, by angle [Pa]
};
/// How E(theta) is read and fitted.
struct MacroReading {
  const char* modulus;  ///< the number that is fitted
  theory::Eq1Reference reference =
      theory::Eq1Reference::given;  ///< `given`: that number of the intact specimen
};
JointFits fit_joints(const Plan& plan, const StudyRows& rows, const MacroReading& reading);

/// One effect of a parameter on a response, over the replicates.
struct Effect {
  std::string name;  ///< "slope", "R2", "mu_star", "S_total" ...
  std::string unit;
  Summary value;
};

/// All effects of parameter number `factor` that the design can determine.
std::vector<Effect> effects_of(const Plan& plan, const Response& response, std::size_t factor);

/// Slope and intercept beside those that others found for this response and parameter (Study::regressions),
/// where the unit is the same.
std::vector<Effect> beside_regressions(const Plan& plan, const Response& response, std::size_t factor,
                                       const std::vector<Effect>& effects);

/// Points of the curve over one parameter of a one_at_a_time study, in rising order, the base among them.
std::vector<std::size_t> curve_points(const Plan& plan, std::size_t factor);

/// y = intercept + sum slope_k x_k over all points with a response.
struct PlaneFit {
  std::size_t n = 0;
  double R2 = 0.0;
  std::vector<double> slope, se;  ///< NaN where the points do not determine them
};
PlaneFit fit_plane(const std::vector<Point>& points, const std::vector<double>& y);

/// Per full range of the parameter, in the unit of the response.
struct ElementaryEffect {
  double mu = 0.0, mu_star = 0.0, sigma = 0.0;
  std::size_t n = 0;
};
/// By parameter. `y` by point; steps from or to a NaN are left out.
std::vector<ElementaryEffect> elementary_effects(const std::vector<Point>& points,
                                                 const std::vector<double>& y);

struct VarianceIndex {
  double first = 0.0, total = 0.0;
  std::size_t n = 0;  ///< blocks
};
/// By parameter (k of them), of the design `saltelli`; blocks with a NaN are left out.
std::vector<VarianceIndex> variance_indices(std::size_t k, const std::vector<double>& y);

/// Tables for the terminal: macro joint stiffness where the design has the angles for it, and the main effect
/// of every parameter on ucs and E at every specimen. Nothing where there is no result.
std::string effects_text(const Plan& plan, const StudyRows& rows, int terminal_width = 0);
/// Every number of every specimen, then K_n, K_s, R2_eq1 and E_eq1 of Eq. 1 by every reading: what both CSV
/// files are about. Thousands of fits in a large study.
std::vector<Response> all_responses(const Plan& plan, const StudyRows& rows);
/// Tidy CSV, a row per response, parameter and effect.
std::string effects_csv(const Plan& plan, const std::vector<Response>& all);
/// Tidy CSV, a row per response and point: mean, standard deviation, 95 % interval over the replicates.
std::string responses_csv(const Plan& plan, const std::vector<Response>& all);

}  // namespace phy::study
