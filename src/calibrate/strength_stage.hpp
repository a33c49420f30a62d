// The strength stage: sigma_c, tau_c/sigma_c, mu, C/tau_c, sigma_n/C, mu of the joints against the strengths
// of the table.
//
// A strength is proportional to all micro-strengths together (moduli, geometry and friction kept):
// log(UCS/sigma_c) is a function of five ratios alone, one function per angle. A surrogate per test and angle
// (surrogate.hpp) learns it from runs of the press; sigma_c costs no run. What is wanted is the posterior
//
//   log p = -1/2 sum_i [ (log lab_i - log sigma_c - f_i(z))^2 / v_i + log v_i ],
//   v_i = se_i^2 + var f_i(z) + d^2
//
// uniform over the box of parameters.hpp: laboratory scatter and ignorance of the surrogate count alike, and
// a ratio that the data do not determine keeps the width of its box. d is what the best known rock misses
// beyond both: zero where the table can be met; where it cannot, the posterior would otherwise flee to the
// rocks of which least is known. Draws from it (ensemble.hpp) are also the next points to run, from the first
// batch on, when only experience with other rocks speaks (experience.hpp): wide while little is known, close
// to the answer in the end - a trust region that nobody has to size. Points are chosen far apart among the
// draws, dealt out over twelve packings, all angles of a point on one packing: what packings have in common
// with each other is what the surrogate learns.
//
// The first batches run on coarse grains, the same specimen magnified, at a fifteenth of the cost; the
// surrogate knows that they answer a little differently. The estimate is the draw whose predictions are
// nearest to the mean of all draws and to the table: a point in the middle of what fits, never an average of
// points that does not fit itself.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "calibrate/simulator.hpp"
#include "records/calibration.hpp"

namespace phy {

/// Fewest points of the search; each costs one test per strength of the table, of which the budget counts
/// those of UCS: tests in tension end at a fraction of the strain.
constexpr std::int64_t least_points = 8;
constexpr int verification_packings = 5;

struct StrengthFit {
  Recipe recipe;                              ///< with the estimated strengths and the settings of the tests
  std::vector<ParameterEstimate> parameters;  ///< the ratios, then the strengths that they stand for
  std::vector<Comparison> fitted;             ///< what the surrogate predicts at the estimate
  std::vector<Comparison> left_out;           ///< each target predicted without it; empty below four targets
  std::int64_t n_tests = 0, n_coarse = 0, n_tension = 0;
  bool interrupted = false;
  bool short_search = false;          ///< the budget did not allow all points
  std::vector<std::string> findings;  ///< what speaks against the fit
  std::vector<std::string> notes;
};

/// True for the strengths that this program can test.
bool can_test(Property property);

/// `recipe`: from the elastic stage. `max_tests`: budget of this stage, tests of UCS. Seeds: packings, of
/// which the points of the search take turns.
StrengthFit fit_strength(const Rock& rock, const Recipe& recipe, const std::vector<Target>& all,
                         const std::vector<std::int64_t>& seeds, std::int64_t max_tests, Simulator& simulator,
                         const std::function<void(const std::string&)>& say);

/// Mean strengths of a recipe at the targets over packings, by the tests themselves.
std::vector<Comparison> strength_response(const Recipe& recipe, const std::vector<Target>& targets,
                                          const std::vector<std::int64_t>& seeds, Simulator& simulator);

/// Settings of the tests of a rock: single precision, no snapshots, and a platen speed at which a
/// wave crosses the specimen a hundred times until the earliest peak. `targets`: their UCS over the modulus
/// of the recipe (direct solution on the packing `seed`) is the strain of the peak.
Recipe test_settings(Recipe recipe, const std::vector<Target>& all, std::int64_t seed, Simulator& simulator);

}  // namespace phy
