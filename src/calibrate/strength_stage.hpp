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
#include "calibrate/evidence.hpp"
#include "calibrate/listener.hpp"
#include "calibrate/parameters.hpp"
#include "calibrate/softening.hpp"
#include "calibrate/strength_tests.hpp"

namespace phy::calibrate {

/// Fewest points of the search; each costs one test per strength of the table, of which the budget counts
/// those in compression: tests in tension end at a fraction of the strain.
constexpr std::int64_t least_points = 8;
constexpr int verification_packings = 5;

struct StrengthFit {
  Recipe recipe;                     ///< with the estimated strengths and the settings of the tests
  std::vector<Estimate> parameters;  ///< what was sought, then the strengths that the ratios stand for
  std::vector<Comparison> fitted;  ///< what the surrogate predicts at the estimate; those without any answer
                                   ///< alone, where nothing could be fitted
  std::vector<Comparison> left_out;  ///< each target predicted without it; empty below four targets
  std::vector<Recipe> draws;         ///< of the strengths, jointly (posterior_ensemble.hpp)
  std::int64_t n_tests = 0, n_coarse = 0, n_tension = 0, n_without_peak = 0;
  std::int64_t n_solutions = 0;  ///< of the direct solution, for what softens
  bool interrupted = false;
  std::string longer_by;  ///< what would have allowed all points of a usual search; empty: it had them
  std::vector<std::string> findings;  ///< what speaks against the fit
  std::vector<std::string> notes;
  Mixing mixing;          ///< of the draws behind parameters and intervals
  Softenings softenings;  ///< at the estimate; empty: the moduli were not asked for again
};

/// The moduli anew, for a table whose E the press has softened so far: a recipe with them, and what its
/// direct solution has for the moduli of the table.
struct Remodelled {
  Recipe recipe;
  std::vector<Comparison> solution;
};
using Remodel = std::function<Remodelled(const Softenings&)>;

/// The settings of the tests stay, the elastic parameters are those of another recipe.
Recipe with_moduli(Recipe recipe, const Recipe& moduli);

/// Against the strengths of the evidence. `recipe`: from the elastic stage. `budget`: of this
/// stage. Seeds: packings, of which the points of the search take turns. `remodel`:
/// called after every batch; empty: the moduli are those of small strain and stay.
StrengthFit fit_strength(const Evidence& evidence, const Recipe& recipe,
                         const std::vector<std::int64_t>& seeds, const Budget& budget, Simulator& simulator,
                         const Listener& listener, const Remodel& remodel = {});

}  // namespace phy::calibrate
