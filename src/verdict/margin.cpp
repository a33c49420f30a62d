#include "verdict/margin.hpp"

#include <algorithm>
#include <cmath>

#include "base/stats.hpp"

namespace phy::verdict {
namespace {

constexpr double many_degrees = 1e6;  // of freedom: normal

double unit_of(const Target& t) { return measured(t.property).absolute ? 1.0 : t.mean; }

}  // namespace

double miss_of(const Comparison& row) { return (row.mean - row.target.mean) / unit_of(row.target); }

double margin(const Comparison& row) {
  const Target& t = row.target;
  const double of_packings = std::isfinite(row.sd) ? row.sd * row.sd / row.n_packings : 0.0;
  const double of_table = t.standard_error() * t.standard_error(), sum = of_table + of_packings;
  double inverse = 0.0;  // of the degrees of freedom, times the square of the sum
  if (t.degrees > 0) inverse += of_table * of_table / t.degrees;
  if (row.n_packings > 1) inverse += of_packings * of_packings / (row.n_packings - 1);
  const bool known = !(inverse * many_degrees > sum * sum);
  const double quantile =
      known ? z_95 : student_t_95(static_cast<std::size_t>(std::max(1.0, sum * sum / inverse)));
  return std::max(tolerance(t.property), quantile * std::sqrt(sum) / unit_of(t));
}

bool misses(const Comparison& row) { return std::fabs(miss_of(row)) > margin(row); }

bool wants_packings(const std::vector<Comparison>& verification) {
  constexpr double enough = 0.25;
  double squares = 0.0;
  int n = 0;
  for (const Comparison& c : verification) {
    if (!is_strength(c.target.property) || !std::isfinite(c.sd)) continue;
    squares += std::pow(c.sd / c.mean / tolerance(c.target.property), 2.0) / c.n_packings, ++n;
  }
  return squares > n * enough * enough;
}

bool unresolved(const Comparison& row) { return margin(row) > coarsest(row.target.property); }

}  // namespace phy::verdict
