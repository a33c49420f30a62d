// The point that is taken as the estimate: where what the surrogates say of a rock lies nearest to the table.
//
// Draws from the posterior rarely come near its middle where many ratios are sought: of ten, each half known,
// no draw has all right. So from those that fit best least squares go downhill:
//
//   minimise  sum_i [ rho((log lab_i - log model_i)/s_i) + var model_i/s_i^2 ] + w^2 sum_j ((x_j -
//   mean_j)/sd_j)^2
//
// s_i is half of what may be missed (margin.hpp); rho is a square that grows no faster than its root beyond
// (Charbonnier's), so that a value which cannot be met does not decide for the others. var model_i: what the
// surrogate does not know, so that of two places that fit alike the better known is taken. mean_j and sd_j of
// the draws: what the table leaves open stays in the middle of what it allows.
#pragma once
#include <vector>

#include "calibrate/strength_posterior.hpp"

namespace phy::calibrate {

/// Its square is that of x where x is small and a multiple of |x| where it is large: rho above.
double softened(double x);

/// `left_out`: a target that is not counted; the draws are of a posterior without it.
Point nearest_point(const StrengthPosterior& posterior, const std::vector<Point>& draws,
                    std::size_t left_out = StrengthPosterior::none);

}  // namespace phy::calibrate
