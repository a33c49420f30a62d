// Twenty recipes in place of one: what a calibration knows of a rock and what it leaves open, in a form that
// any test can be run on.
//
// A recipe of the ensemble is one joint draw: moduli from the Gaussian posterior of the elastic stage (in the
// logarithms of the parameters, within their boxes), strengths from the draws of the strength stage, and a
// packing that neither the fit nor the verification has seen. The spread of the draws therefore holds the
// scatter of the laboratory, what the surrogate does not know of the model, what one property of the table
// misses (the discrepancy of strength_posterior.hpp), what the table leaves open, and the scatter of
// specimens. Moduli and strengths are drawn apart from each other, as they are fitted one after the other.
// Not in it: what the model gets wrong. Of strengths that the table has, discrepancy.hpp tells it after the
// draws are run; of a test that the table does not hold, no table of another test can.
//
// Of twenty draws and one more from the same distribution every order is as likely as any other: the
// twenty-first lies between the smallest and the largest of the twenty with a probability of 19/21 = 90.5 %.
#pragma once
#include <cstdint>
#include <vector>

#include "calibrate/ensemble.hpp"
#include "calibrate/parameters.hpp"

namespace phy::calibrate {

constexpr std::size_t ensemble_size = 20;

/// Draws from a normal distribution inside a box. `covariance`: row by row, positive definite; of anything
/// else there are no draws. A draw that would not come to lie in the box is put on its edge.
std::vector<Point> gaussian_draws(const Point& mean, const std::vector<double>& covariance,
                                  const std::vector<LogBox>& boxes, std::size_t n, std::uint32_t seed);

/// `n` of the draws of a chain, evenly from the first to the last.
std::vector<Point> evenly_taken(const std::vector<Point>& draws, std::size_t n);

/// `moduli` and `strengths`: ensemble_size recipes with the draws of a stage; empty: those of the estimate,
/// which also gives everything else. Packings from `first_seed` on.
std::vector<Recipe> posterior_ensemble(const Recipe& estimate, const std::vector<Recipe>& moduli,
                                       const std::vector<Recipe>& strengths, std::int64_t first_seed);

}  // namespace phy::calibrate
