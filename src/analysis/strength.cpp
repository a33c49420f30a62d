#include "analysis/strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/nan.hpp"

namespace phy::analysis {
namespace {

/// Puts the stress at the count-th crack into n.
void place(const LoadingBranch& branch, std::vector<double>& strains, std::size_t count, double pre_strain,
           Number& n) {
  if (strains.size() < count) {
    n.note = strains.empty() ? "no crack before the peak"
                             : fmt::format("only {} of {} cracks before the peak", strains.size(), count);
    return;
  }
  const auto nth = strains.begin() + static_cast<std::ptrdiff_t>(count - 1);
  std::nth_element(strains.begin(), nth, strains.end());
  const double first_row = branch.rows.front().axial_strain;
  const double hidden = std::min(std::max(first_row, pre_strain), branch.strain);
  n.value = stress_at(branch, std::max(*nth, hidden));
  if (*nth > hidden) return;
  n.note = fmt::format(
      "below {:.4g} MPa: the crack came {}", n.value * 1e-6,
      pre_strain > 0.0 ? "by the end of the affine pre-strain" : "before the first row of the history");
}

}  // namespace

std::vector<Number> strength(const LoadingBranch& branch) {
  const std::string note = branch_note(branch);
  return {{branch.strength, branch.peaked ? branch.largest : nan, "Pa",
           fmt::format("largest {} of the test (mean of both {}s over the initial width)", branch.stress,
                       branch.body),
           note},
          {"peak_strain", branch.peaked ? branch.strain : nan, "1",
           fmt::format("axial strain of the {}s at the largest {}", branch.body, branch.stress), note}};
}

std::vector<Number> crack_initiation(const LoadingBranch& branch, const std::vector<CrackEvent>& cracks,
                                     double pre_strain) {
  const std::string stress = branch.stress;
  Number ci{"sigma_ci", nan, "Pa",
            stress + " when the number of cracks reaches max(3, 1 % of the cracks at the peak)",
            branch_note(branch)};
  Number first{"sigma_first_crack", nan, "Pa", stress + " at the first crack", ""};
  if (branch.empty()) {
    first.note = branch_note(branch);
    return {ci, first};
  }
  std::vector<double> strains;
  for (const CrackEvent& c : cracks)
    if (c.strain <= branch.strain) strains.push_back(c.strain);
  place(branch, strains, 1, pre_strain, first);
  if (branch.peaked)
    place(branch, strains, std::max<std::size_t>(3, (strains.size() + 99) / 100), pre_strain, ci);
  return {ci, first};
}

Number crack_damage(const LoadingBranch& branch) {
  Number n{"sigma_cd", nan, "Pa",
           std::string(branch.stress) +
               " where the volumetric strain (axial + lateral, gauge) is largest, before the peak",
           branch_note(branch)};
  const HistoryRow *first = nullptr, *best = nullptr, *last = nullptr;
  double largest = -std::numeric_limits<double>::infinity();
  for (const HistoryRow& r : branch.rows) {
    const double volume = r.axial_strain_gauge + r.lateral_strain_gauge;
    if (!std::isfinite(volume) || !std::isfinite(r.axial_stress)) continue;
    if (first == nullptr) first = &r;
    if (volume > largest) largest = volume, best = &r;
    last = &r;
  }
  if (branch.empty()) return n;
  if (best == nullptr)
    n.note = joined(n.note, "the history has no gauge strains");
  else if (best == last)
    n.note = joined(n.note, "the volumetric strain does not turn before the largest stress");
  else if (best == first || !(largest > 0.0))
    n.note = joined(n.note, "the specimen dilates from the first row on");
  else
    n.value = best->axial_stress;
  return n;
}

}  // namespace phy::analysis
