// The point that is taken as the estimate: where what the surrogates say of a rock lies nearest to the table.
//
// Draws from the posterior rarely come near its middle where many ratios are sought: of ten, each half known,
// no draw has all right. So from those that fit best least squares go downhill (maps/nearest.hpp):
//
//   minimise  sum_i [ rho((log lab_i - log model_i)/s_i) + var model_i/s_i^2 ] + sum_j ((x_j -
//   mean_j)/sd_j)^2
//
// s_i is half of what may be missed (verdict/cells.hpp); rho is a square that grows no faster than its root
// beyond, so that a value which cannot be met does not decide for the others. var model_i: what the surrogate
// does not know, so that of two places that fit alike the better known is taken. mean_j is
// that of the draws, sd_j what was known of x_j before any data. Where the table determines x_j, the draws
// are close together and the sum decides nothing; what it leaves open stays in the middle of what table and
// prior allow, and leaves it for no part of a tolerance.
#pragma once
#include <vector>

#include "calibrate/strength_posterior.hpp"

namespace phy::calibrate {

/// `left_out`: a target that is not counted; the draws are of a posterior without it.
Point best_estimate(const StrengthPosterior& posterior, const std::vector<Point>& draws,
                    std::size_t left_out = StrengthPosterior::none);

}  // namespace phy::calibrate
