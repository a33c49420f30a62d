#include "analysis/energy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/nan.hpp"

namespace phy::analysis {
namespace {

using Rows = std::span<const HistoryRow>;
constexpr const char* no_energies = "the history holds no energies";

/// Terms of the energy balance, in the order of the history's columns.
std::vector<HistoryColumn> energy_columns() {
  std::vector<HistoryColumn> terms;
  for (const HistoryColumn& c : balance_columns())
    // By the unit: a term that comes later is taken along.
    if (std::string(c.unit) == "J/m") terms.push_back(c);
  return terms;
}

double largest_work(Rows rows) {
  double work = 0.0;
  for (const HistoryRow& r : rows)
    if (std::isfinite(r.boundary_work)) work = std::max(work, r.boundary_work);
  return work;
}

/// Largest finite |value(row)|; NaN when there is none.
template <class F>
double largest(Rows rows, F&& value) {
  double most = nan;
  for (const HistoryRow& r : rows) {
    const double v = std::fabs(value(r));
    // Negated, so that the first finite value replaces NaN.
    if (std::isfinite(v) && !(v <= most)) most = v;
  }
  return most;
}

double kinetic_ratio(const LoadingBranch& branch) {
  // At the start little energy is stored, and any motion is large beside it.
  const auto early = first_passage(branch, {0.0, 0.2});
  return largest(branch.rows.subspan(early.size()), [](const HistoryRow& r) {
    return r.kinetic / (r.strain_linear + r.strain_bond + r.strain_joint + r.strain_wall);
  });
}

void platen_checks(const LoadingBranch& branch, std::vector<Number>& out) {
  std::vector<double> differences;
  for (const HistoryRow& r : branch.rows) {
    const double d = std::fabs(r.stress_top - r.stress_bottom) / branch.largest;
    if (std::isfinite(d)) differences.push_back(d);
  }
  const std::string difference = fmt::format("|top - bottom {} stress| / {}", branch.body, branch.strength);
  Number all{"platen_difference", nan, "1", "largest " + difference + " before the " + branch.turn(),
             branch_note(branch)};
  Number most{"platen_difference_95", nan, "1",
              difference + " that 95 % of the rows before the " + branch.turn() + " do not exceed", all.note};
  if (!differences.empty()) {
    all.value = *std::max_element(differences.begin(), differences.end());
    // A crack sends a wave that single rows catch: 95 % of the rows say whether the test is quasi-static.
    const auto nth = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() * 95 / 100);
    std::nth_element(differences.begin(), nth, differences.end());
    most.value = *nth;
  } else if (!branch.empty()) {
    all.note = most.note = joined(all.note, "the history has no platen stresses");
  }
  out.push_back(all), out.push_back(most);
}

/// How far the test has gone on behind its peak: a stress that falls by a fifth, or half as much strain again
/// without a new largest stress, is enough.
Number peak_confirmed(const LoadingBranch& branch, const History& history) {
  Number n{
      "peak_confirmed", nan, "1",
      fmt::format(
          "the larger of the fall of stress behind {0} / 20 % of {0} and the strain behind it / 50 % of its "
          "strain",
          branch.strength),
      branch_note(branch)};
  if (branch.at_knee()) n.note = "a knee, no peak";
  if (!branch.peaked || branch.at_knee()) return n;
  double least = branch.largest, farthest = branch.strain;
  for (const HistoryRow& r : std::span(history.rows)
                                 .subspan(static_cast<std::size_t>(branch.rows.data() + branch.rows.size() -
                                                                   history.rows.data()))) {
    // A first peak that is exceeded later was none to those who look on.
    if (r.axial_stress > branch.largest) break;  // a first peak, exceeded later
    if (std::isfinite(r.axial_stress)) least = std::min(least, r.axial_stress);
    if (std::isfinite(r.axial_strain)) farthest = std::max(farthest, r.axial_strain);
  }
  // Either is enough: stiff rock falls at once, ductile rock only strains.
  n.value = std::max((1.0 - least / branch.largest) / 0.2, (farthest / branch.strain - 1.0) / 0.5);
  return n;
}

/// Time in which the strain of the peak is reached at the strain rate of the second half of the way [s]: the
/// way before may have been jumped over, or run through in a ramp.
double rise_time(const LoadingBranch& branch) {
  const auto& rows = branch.rows;
  // One row has no rate.
  if (rows.size() < 2) return nan;
  std::size_t half = rows.size() - 2;
  // The second half is loaded evenly in every test.
  while (half > 0 && rows[half - 1].axial_strain >= 0.5 * branch.strain) --half;
  // Over half of the way and not two rows: rows are noisy.
  const HistoryRow &from = rows[half], &to = rows.back();
  return branch.strain * (to.time - from.time) / (to.axial_strain - from.axial_strain);
}

/// A wave of speed sqrt(E/rho), with E of the peak's stress and strain: the softest that the rock has been.
Number wave_transits(const LoadingBranch& branch, const WavePath& path) {
  Number n{
      "wave_transits", nan, "1",
      fmt::format("crossings of a wave through the specimen in the time until the peak, at the strain rate "
                  "of its second half. The wave has the speed sqrt(E/density), with the secant E at {}",
                  branch.strength),
      branch_note(branch)};
  if (path.density > 0.0 && path.length > 0.0 && branch.peaked)
    n.value = rise_time(branch) / path.length *
              std::sqrt(path.modulus_factor * branch.largest / branch.strain / path.density);
  else if (branch.peaked)
    n.note = "the way of a wave through the specimen is not known";
  return n;
}

}  // namespace

std::vector<Number> energy_budget(const LoadingBranch& branch, const History& history) {
  const bool present = largest_work(history.rows) > 0.0;
  const std::string missing = present ? "" : no_energies;
  std::vector<Number> out;
  for (const HistoryColumn& c : energy_columns())
    out.push_back({std::string("energy_") + c.name, present ? history.rows.back().*c.value : nan, "J/m",
                   std::string(c.meaning) + ", in the last row", missing});
  for (const HistoryColumn& c : energy_columns())
    out.push_back({std::string("energy_") + c.name + "_at_peak",
                   present && branch.peaked ? branch.rows.back().*c.value : nan, "J/m",
                   std::string(c.meaning) + ", at " + branch.point(), joined(branch_note(branch), missing)});
  return out;
}

std::vector<Number> run_checks(const LoadingBranch& branch, const History& history, const WavePath& path) {
  const double work = largest_work(history.rows);
  // energy_error is per work of its own row; over the work of the whole test the start counts little.
  const auto lost = [](const HistoryRow& r) { return r.energy_error * r.boundary_work; };
  const auto own = [](const HistoryRow& r) { return r.energy_error; };
  // Histories of other programs have no energies.
  const bool present = work > 0.0;
  const std::string missing = present ? "" : no_energies;
  std::vector<Number> out = {
      {"energy_error", present ? largest(history.rows, lost) / work : nan, "1",
       "largest |work not accounted for| of any row / largest boundary work of the test", missing},
      {"energy_error_of_row", present ? largest(history.rows, own) : nan, "1",
       "largest |work not accounted for| / boundary work, both up to the same row", missing},
      {"kinetic_ratio", present && !branch.empty() ? kinetic_ratio(branch) : nan, "1",
       fmt::format("largest kinetic energy / stored strain energy from 20 % of {} to the {}", branch.strength,
                   branch.turn()),
       joined(branch_note(branch), missing)}};
  platen_checks(branch, out);
  out.push_back({"rows_to_peak", branch.peaked ? static_cast<double>(branch.rows.size()) : nan, "1",
                 fmt::format("rows of the history up to {}", branch.strength), branch_note(branch)});
  out.push_back(wave_transits(branch, path));
  out.push_back(peak_confirmed(branch, history));
  return out;
}

}  // namespace phy::analysis
