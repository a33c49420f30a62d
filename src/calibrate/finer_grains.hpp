// Would smaller grains meet a Poisson's ratio that the model misses? Few grains blur the layers, and packings
// of few differ. A direct solution takes about a second, so that it is tried, where nu is missed, on grains
// half as large.
#pragma once
#include <optional>

#include "calibrate/elastic_fit.hpp"

namespace phy::calibrate {

/// `grains_for_nu` of the values of nu in `missed`, where the moduli fitted anew on grains half as large have
/// all of them within the tolerance, and E as nearly as `fit` has it. `table`: at small strain, as `fit` took
/// it. Nothing otherwise, nor for specimens that would have more than 10,000 grains or lie in a file.
std::optional<Finding> grains_for_nu(const Evidence& table, const ElasticFit& fit,
                                     const std::vector<Cell>& missed, const std::vector<std::int64_t>& seeds,
                                     Simulator& simulator);

}  // namespace phy::calibrate
