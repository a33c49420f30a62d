#include "analysis/strength_rule.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "base/nan.hpp"

namespace phy::analysis {
namespace {

using Values = std::span<const double>;

constexpr double real_fall = 0.1;                     // of a maximum
constexpr double calm = 0.2;                          // of the largest stress: below it waves are not even
constexpr double soft = 0.05;                         // tangent over modulus at the knee
constexpr double window_lo = 0.95, window_hi = 1.05;  // strains of the tangent, over that of the knee
constexpr double modulus_lo = 0.2, modulus_hi = 0.6;  // strains of the modulus before
constexpr std::size_t rows_aside = 2;                 // of the tangent, at least, before and behind
constexpr std::size_t modulus_rows = 3;               // at least
constexpr double beyond = 1.25, dip_rise = 1.05;      // exceeded so far within so much strain: a dip
constexpr std::size_t dip_rows = 5;                   // or within so many rows, where rows are far apart

/// Least-squares slopes over any rows, from sums up to each row.
class Slopes {
 public:
  Slopes(Values x, Values y) : sums_(x.size() + 1) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      const Sums& s = sums_[i];
      sums_[i + 1] = {s.x + x[i], s.y + y[i], s.xx + x[i] * x[i], s.xy + x[i] * y[i]};
    }
  }
  /// Of rows first ... last - 1; NaN where they do not tell one.
  double slope(std::size_t first, std::size_t last) const {
    const Sums &a = sums_[first], &b = sums_[last];
    const double n = static_cast<double>(last - first), x = b.x - a.x, y = b.y - a.y;
    // Differences of running sums: every window costs the same, however long.
    const double spread = n * (b.xx - a.xx) - x * x;
    return spread > 0.0 ? (n * (b.xy - a.xy) - x * y) / spread : nan;
  }

 private:
  struct Sums {
    double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  };
  std::vector<Sums> sums_;
};

std::size_t first_at(Values strain, double value) {
  return static_cast<std::size_t>(std::lower_bound(strain.begin(), strain.end(), value) - strain.begin());
}

/// Has the test gone on behind its largest stress, in row `top`, until it was over by that?
bool is_over(Values strain, Values stress, std::size_t top, const StopRule& stop) {
  const double far =
      stop.post_peak > 0.0 ? (1.0 + stop.post_peak) * strain[top] : std::numeric_limits<double>::infinity();
  for (std::size_t i = top + 1; i < strain.size(); ++i)
    // Whichever the recipe asks for: a fall, or strain without a new peak.
    if (stress[i] < stop.stop_at * stress[top] || strain[i] > far) return true;
  return false;
}

bool is_dip(Values strain, Values stress, std::size_t row) {
  for (std::size_t i = row + 1;
       i < strain.size() && (i <= row + dip_rows || strain[i] <= beyond * strain[row]); ++i)
    if (stress[i] > dip_rise * stress[row]) return true;
  return false;
}

std::optional<std::size_t> first_fall(Values strain, Values stress, double least) {
  std::size_t top = 0;
  for (std::size_t i = 1; i < stress.size(); ++i) {
    if (stress[i] > stress[top]) {
      top = i;
      continue;
    }
    if (stress[top] < least || stress[i] > (1.0 - real_fall) * stress[top]) continue;
    if (!is_dip(strain, stress, top)) return top;
  }
  return std::nullopt;
}

/// Row of the largest stress up to the knee.
std::optional<std::size_t> first_knee(Values strain, Values stress, double least) {
  if (!std::is_sorted(strain.begin(), strain.end())) return std::nullopt;
  const Slopes slopes(strain, stress);
  std::size_t top = 0;
  for (std::size_t i = 0; i < strain.size() && strain.back() >= beyond * strain[i]; ++i) {
    if (stress[i] > stress[top]) top = i;
    if (stress[i] < least || i < rows_aside) continue;
    const std::size_t first = std::min(first_at(strain, window_lo * strain[i]), i - rows_aside);
    const std::size_t last = std::max(first_at(strain, window_hi * strain[i]), i + rows_aside + 1);
    const std::size_t from = first_at(strain, modulus_lo * strain[i]);
    const std::size_t to = first_at(strain, modulus_hi * strain[i]);
    if (last > strain.size() || to < from + modulus_rows) continue;
    const double modulus = slopes.slope(from, to);
    if (modulus > 0.0 && slopes.slope(first, last) < soft * modulus && !is_dip(strain, stress, top))
      return top;
  }
  return std::nullopt;
}

}  // namespace

const char* to_string(StrengthRule rule) {
  switch (rule) {
    case StrengthRule::peak: return "peak";
    case StrengthRule::knee: return "knee";
    case StrengthRule::largest: return "largest";
  }
  return "unknown";
}

StrengthPoint strength_point(Values strain, Values stress, const StopRule& stop) {
  const auto top = static_cast<std::size_t>(std::max_element(stress.begin(), stress.end()) - stress.begin());
  if (is_over(strain, stress, top, stop)) return {StrengthRule::peak, top};
  const double least = calm * stress[top];
  if (const auto peak = first_fall(strain, stress, least)) return {StrengthRule::peak, *peak};
  if (const auto knee = first_knee(strain, stress, least)) return {StrengthRule::knee, *knee};
  return {StrengthRule::largest, top};
}

}  // namespace phy::analysis
