// What is said of an elastic fit: which cells it misses, why, and which parameters ran into their box.
#pragma once
#include <string>
#include <vector>

#include "calibrate/elastic_fit.hpp"

namespace phy::calibrate {

/// Largest deviation of mean E from the laboratory that passes without a word.
constexpr double elastic_tolerance = 0.02;
constexpr double nu_tolerance = 0.03;
/// Standard errors that the largest of seven cells exceeds in 5 % of tables.
constexpr double z_seven = 2.69;

/// By how much E (relative) or nu may miss the table without a word: 2 % or 0.03, or what the scatter of the
/// laboratory explains. An assumed scatter explains nothing.
double modulus_limit(const Target& t);
bool misses(const Comparison& modulus);

struct ElasticVerdict {
  std::vector<std::string> findings;  ///< limits that the fit ran into; empty: within tolerance
  bool out_of_reach = false;
};
ElasticVerdict judge_elastic(const ElasticFit& fit, const Evidence& evidence, bool softened = false);

}  // namespace phy::calibrate
