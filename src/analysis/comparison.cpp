#include "analysis/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/elastic.hpp"
#include "analysis/strength.hpp"
#include "base/nan.hpp"

namespace phy::analysis {
namespace {

constexpr StressRange tangent_range = {0.4, 0.6};
constexpr double secant_level = 0.5;

Number first_crack(const LoadingBranch& branch) {
  for (const HistoryRow& row : branch.rows)
    if (row.n_cracks > 0.0) return {"first crack", row.axial_stress, "Pa", "", ""};
  // A curve from elsewhere has strain and stress alone.
  const bool counted = !branch.rows.empty() && std::isfinite(branch.rows.front().n_cracks);
  return {"first crack", nan, "Pa", "",
          counted ? "no crack in the rows up to the strength" : "cracks were not counted"};
}

std::array<Number, 5> readings(const LoadingBranch& branch) {
  // Strains of the platens: a curve from elsewhere has no gauge in our sense.
  const std::vector<Number> top = strength(branch);
  return {tangent_modulus(branch, tangent_range, StrainFrom::platen, "E tangent"),
          secant_modulus(branch, secant_level, StrainFrom::platen, "E secant"), first_crack(branch), top[0],
          top[1]};
}

struct Shown {
  const char *name, *unit;
  double scale;
};
constexpr std::array<Shown, 5> shown = {{{"E tangent 40-60 %", "GPa", 1e-9},
                                         {"E secant 50 %", "GPa", 1e-9},
                                         {"first crack", "MPa", 1e-6},
                                         {"strength", "MPa", 1e-6},
                                         {"strain there", "%", 100.0}}};

}  // namespace

std::vector<ComparedNumber> compared_numbers(const History& ours, const History& theirs,
                                             const StopRule& stop) {
  const auto a = readings(loading_branch(ours, stop)), b = readings(loading_branch(theirs, stop));
  std::vector<ComparedNumber> numbers;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    // One sentence where both have the same reason.
    const std::string said = a[i].note == b[i].note ? a[i].note
                                                    : joined(a[i].note.empty() ? "" : "ours: " + a[i].note,
                                                             b[i].note.empty() ? "" : "theirs: " + b[i].note);
    numbers.push_back(
        {shown[i].name, shown[i].unit, a[i].value * shown[i].scale, b[i].value * shown[i].scale, said});
  }
  return numbers;
}

double distance_of_curves(const History& ours, const History& theirs, const StopRule& stop) {
  const LoadingBranch a = loading_branch(ours, stop), b = loading_branch(theirs, stop);
  if (a.empty() || b.empty()) return nan;
  double sum = 0.0;
  std::size_t n = 0;
  for (const HistoryRow& row : a.rows) {
    // Behind either peak the curves part by chance.
    if (!(row.axial_strain <= std::min(a.strain, b.strain))) continue;
    // At our strains: rows of the two lie elsewhere.
    const double difference = stress_at(b, row.axial_strain) - row.axial_stress;
    if (!std::isfinite(difference)) continue;
    sum += difference * difference, ++n;
  }
  return n == 0 ? nan : std::sqrt(sum / static_cast<double>(n)) / a.largest;
}

}  // namespace phy::analysis
