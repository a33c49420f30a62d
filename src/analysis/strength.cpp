#include "analysis/strength.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analysis/elastic.hpp"
#include "base/nan.hpp"

namespace phy::analysis {
namespace {

constexpr double largest_nu = 0.45;  // of a volume that shortens under load: by 1 - 2 nu of the axial strain

/// Puts the stress at the count-th crack into n.
void place(const LoadingBranch& branch, std::vector<double>& strains, std::size_t count, double pre_strain,
           Number& n) {
  if (strains.size() < count) {
    n.note = strains.empty()
                 ? fmt::format("no crack before the {}", branch.turn())
                 : fmt::format("only {} of {} cracks before the {}", strains.size(), count, branch.turn());
    return;
  }
  const auto nth = strains.begin() + static_cast<std::ptrdiff_t>(count - 1);
  // Cracks are in the order of their cycles; a strain may have been zeroed between them.
  std::nth_element(strains.begin(), nth, strains.end());
  const double first_row = branch.rows.front().axial_strain;
  // What broke before the first row, or in a jump to a pre-strain, was seen at none of its stresses.
  const double hidden = std::min(std::max(first_row, pre_strain), branch.strain);
  n.value = stress_at(branch, std::max(*nth, hidden));
  if (*nth > hidden) return;
  n.upper_bound = true;
  n.note = fmt::format(
      "below {:.4g} MPa: the crack came {}", n.value * 1e-6,
      pre_strain > 0.0 ? "by the end of the affine pre-strain" : "before the first row of the history");
}

/// What the strength is, by the rule that gave it.
std::string strength_text(const LoadingBranch& branch) {
  if (branch.at_knee())
    return fmt::format(
        "largest {} up to the knee, where the tangent modulus over 10 % of the strain first falls "
        "below 5 % of the modulus before",
        branch.stress);
  // The first of several peaks, by the rule of tests that may harden.
  if (branch.largest < branch.highest)
    return fmt::format("{} at the first peak, behind which it falls by 10 %", branch.stress);
  return fmt::format("largest {} of the test", branch.stress);
}

/// The row where axial strain + `laterals` times lateral strain, of the gauge, is largest.
void place_turn(const LoadingBranch& branch, double laterals, Number& n) {
  const HistoryRow *first = nullptr, *best = nullptr, *last = nullptr;
  double largest = -std::numeric_limits<double>::infinity();
  for (const HistoryRow& r : branch.rows) {
    const double volume = r.axial_strain_gauge + laterals * r.lateral_strain_gauge;
    if (!std::isfinite(volume) || !std::isfinite(r.axial_stress)) continue;
    if (first == nullptr) first = &r;
    // The first of equal ones: a plateau turns where it begins.
    if (volume > largest) largest = volume, best = &r;
    last = &r;
  }
  if (branch.empty()) return;
  if (best == nullptr)
    n.note = joined(n.note, "the history has no gauge strains");
  else if (best == last)
    n.note = joined(n.note, "the volumetric strain does not turn before " + branch.point());
  // A turn needs a rise before it.
  else if (best == first || !(largest > 0.0))
    n.note = joined(n.note, "the specimen dilates from the first row on");
  else
    n.value = best->axial_stress;
}

}  // namespace

std::vector<Number> strength(const LoadingBranch& branch) {
  const std::string note = strength_note(branch);
  return {
      {branch.strength, branch.peaked ? branch.largest : nan, "Pa",
       fmt::format("{} (mean of both {}s over the initial width)", strength_text(branch), branch.body), note},
      {"peak_strain", branch.peaked ? branch.strain : nan, "1",
       fmt::format("axial strain of the {}s at {}", branch.body, branch.point()), note}};
}

std::vector<Number> strength_rule(const LoadingBranch& branch) {
  if (!branch.may_harden) return {};
  return {
      {"strength_rule", branch.empty() ? nan : static_cast<double>(branch.rule), "1",
       fmt::format("rule that gave {}: 1 peak, 2 knee, 3 largest stress without a peak or knee, which is no "
                   "strength (docs/theory/strength-from-history.md); here: {}",
                   branch.strength, branch.empty() ? "none" : to_string(branch.rule)),
       branch.empty() ? branch_note(branch) : ""},
      {"largest_stress", branch.highest, "Pa", fmt::format("largest {} of the whole test", branch.stress),
       branch.empty() ? branch_note(branch) : ""}};
}

std::string strength_note(const LoadingBranch& branch) {
  if (!branch.peaked || !branch.may_harden || (branch.largest == branch.highest && !branch.at_knee()))
    return branch_note(branch);
  std::string first = branch.at_knee() ? "a knee, no peak" : "the first peak";
  if (branch.largest == branch.highest) return first;
  return fmt::format("{}: the {} rises to {:.4g} MPa later", first, branch.stress, branch.highest * 1e-6);
}

std::vector<Number> crack_initiation(const LoadingBranch& branch, const std::vector<CrackEvent>& cracks,
                                     double pre_strain) {
  const std::string stress = branch.stress;
  Number ci{
      "sigma_ci", nan, "Pa",
      fmt::format("{} when the number of cracks reaches max(3, 1 % of the cracks at the {}); a count of "
                  "broken bonds, which no laboratory has",
                  stress, branch.turn()),
      branch_note(branch)};
  Number first{"sigma_first_crack", nan, "Pa", stress + " at the first crack", ""};
  if (branch.empty()) {
    first.note = branch_note(branch);
    return {ci, first};
  }
  std::vector<double> strains;
  for (const CrackEvent& c : cracks)
    // Behind the peak cracks run by themselves: they would shift the 1 %.
    if (c.strain <= branch.strain) strains.push_back(c.strain);
  place(branch, strains, 1, pre_strain, first);
  if (branch.peaked)
    // 1 % rounded up; fewer than three cracks are chance.
    place(branch, strains, std::max<std::size_t>(3, (strains.size() + 99) / 100), pre_strain, ci);
  return {ci, first};
}

Number crack_damage(const LoadingBranch& branch) {
  Number n{"sigma_cd", nan, "Pa",
           fmt::format("{} where the strain of the area (axial + lateral, gauge) is largest, before the {}",
                       branch.stress, branch.turn()),
           branch_note(branch)};
  place_turn(branch, 1.0, n);
  return n;
}

Number crack_damage_volume(const LoadingBranch& branch) {
  Number n{"sigma_cd_volume", nan, "Pa",
           fmt::format("{} where axial + 2 lateral strain (gauge) is largest, before the {}: the volumetric "
                       "strain of a laboratory with an axial and a lateral gauge; for nu below {:g}",
                       branch.stress, branch.turn(), largest_nu),
           branch_note(branch)};
  const Number nu = poisson_ratio(branch, {}, StrainFrom::gauge, "nu");
  // axial + 2 lateral = (1 - 2 nu) axial: near nu = 0.5 it does not shorten at all.
  if (nu.value < largest_nu)
    place_turn(branch, 2.0, n);
  else if (std::isfinite(nu.value))
    n.note = joined(n.note, fmt::format("nu is not below {:g}: axial + 2 lateral strain hardly shortens even "
                                        "where nothing cracks, and its turn means nothing",
                                        largest_nu));
  else if (!branch.empty())
    n.note = "nu is not known: " + nu.note;
  return n;
}

}  // namespace phy::analysis
