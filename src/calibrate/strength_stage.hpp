// The strength stage: sigma_c, tau_c/sigma_c, mu, C/tau_c, sigma_n/C, mu of the joints against the strengths
// of the table.
//
// What fits is a posterior over the six (strength_posterior.hpp). Its draws are also the next points to run,
// from the first batch on, when only the regression over other rocks speaks (prior_regression.hpp): wide
// while little is known, close to the answer in the end - a trust region that nobody has to size. Points are
// chosen far apart among the draws, two to a packing, all angles of a point on one packing: what packings
// have in common with each other is what the surrogate learns.
//
// The first batches run on coarse grains, the same specimen magnified, at a fifteenth of the cost; the
// surrogate knows that they answer a little differently. The last rounds run at the estimate (nearest.hpp),
// every test of a round on another packing, and each moves it.
#pragma once
#include <functional>
#include <vector>

#include "calibrate/effort.hpp"
#include "calibrate/listener.hpp"
#include "calibrate/parameters.hpp"
#include "calibrate/softening.hpp"
#include "records/evidence.hpp"

namespace phy::calibrate {

/// What was found; of a search that was stopped, as far as it came.
struct StrengthFit {
  Recipe recipe;                     ///< with the estimated strengths and the settings of the tests
  std::vector<Estimate> parameters;  ///< what was sought, then the strengths that the ratios stand for
  std::vector<Comparison> fitted;  ///< what the surrogate predicts at the estimate; those without any answer
                                   ///< alone, where nothing could be fitted
  std::vector<Comparison> left_out;         ///< each target predicted without it; empty below four targets
  std::vector<AngleFactor> discrepancy;     ///< of the model at the estimate, at every fifth degree
  std::vector<StrengthResidual> residuals;  ///< of the targets, at the estimate and at `draws`
  std::vector<Recipe> draws;                ///< of the strengths, jointly (posterior_ensemble.hpp)
  std::int64_t n_without_peak = 0;
  Shortage shortage;              ///< of the search
  std::vector<Finding> findings;  ///< `search_unanswered`: then nothing was fitted
  std::vector<Finding> notes;
  Mixing mixing;          ///< of the draws behind parameters and intervals
  Softenings softenings;  ///< at the estimate; empty: the moduli were not asked for again
};

/// The moduli anew, for a table whose E the press has softened so far: a recipe with them, and what its
/// direct solution has for the moduli of the table.
struct RefittedModuli {
  Recipe recipe;
  std::vector<Comparison> solution;
};
using RefitModuli = std::function<RefittedModuli(const Softenings&)>;

/// What a search of strengths goes by: the strengths of the evidence.
struct SearchTask {
  const Evidence& evidence;
  Recipe recipe;                    ///< from the elastic stage
  std::vector<std::int64_t> seeds;  ///< packings, of which the points of the search take turns
  Budget budget;                    ///< of this stage
  Simulator& simulator;
  const Listener& listener;
  RefitModuli refit = {};  ///< called after every batch; empty: the moduli are those of small strain and stay
};

/// `fit`: a new one. Throws Stopped; the fit then holds what was known.
void fit_strength(const SearchTask& task, StrengthFit& fit);

}  // namespace phy::calibrate
