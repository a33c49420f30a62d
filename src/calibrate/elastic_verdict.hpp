// What is said of an elastic fit: which cells it misses, why, and which parameters ran into their box.
#pragma once
#include <string>
#include <vector>

#include "calibrate/elastic_fit.hpp"

namespace phy::calibrate {

struct ElasticVerdict {
  std::vector<std::string> findings;  ///< limits that the fit ran into; empty: within tolerance
  bool out_of_reach = false;
};
ElasticVerdict judge_elastic(const ElasticFit& fit, const Evidence& evidence, bool softened = false);

}  // namespace phy::calibrate
