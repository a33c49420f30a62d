#include "lab/direct_shear/reading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/analyse.hpp"
#include "analysis/strength.hpp"
#include "base/nan.hpp"
#include "base/stats.hpp"

namespace phy::lab {
namespace {

constexpr double residual_part = 0.25;  // of the shear displacement, at its end
constexpr double touching = 0.05;       // of the normal load: with less the boxes hardly touch

using Rows = std::vector<const HistoryRow*>;

Rows between(const History& history, double from, double to) {
  Rows rows;
  for (const HistoryRow& r : history.rows)
    if (r.axial_strain >= from && r.axial_strain <= to) rows.push_back(&r);
  return rows;
}

double mean(const Rows& rows, double HistoryRow::*value) {
  double sum = 0.0;
  for (const HistoryRow* r : rows) sum += r->*value / static_cast<double>(rows.size());
  return rows.empty() ? nan : sum;
}

double slope(const Rows& rows, double HistoryRow::*y) {
  std::vector<double> u, v;
  for (const HistoryRow* r : rows) u.push_back(r->axial_strain), v.push_back(r->*y);
  return fit_line(u, v).slope;
}

/// Of the normal stress in each row, over the load asked for; empty without one.
std::vector<double> load_errors(const Rows& rows, const NormalLoad& load) {
  std::vector<double> errors;
  for (const HistoryRow* r : rows)
    if (load.stress > 0.0)
      // With a spring the load asked for grows as the boxes are lifted.
      errors.push_back(r->lateral_stress / (load.stress - load.stiffness * r->lateral_strain) - 1.0);
  return errors;
}

double largest(const std::vector<double>& errors) {
  double most = errors.empty() ? nan : 0.0;
  for (const double e : errors) most = std::max(most, std::fabs(e));
  return most;
}

double root_mean_square(const std::vector<double>& errors) {
  double squares = 0.0;
  for (const double e : errors) squares += e * e;
  // NaN where there are none, which is what the number then is.
  return std::sqrt(squares / static_cast<double>(errors.size()));
}

double lifted_share(const std::vector<double>& errors) {
  const auto n = std::count_if(errors.begin(), errors.end(), [](double e) { return e < touching - 1.0; });
  // Without a normal load there are no rows: NaN.
  return static_cast<double>(n) / static_cast<double>(errors.size());
}

/// How well the normal load was kept: up to the peak, in the last quarter, and in all rows that something is
/// read from behind the peak.
std::vector<Number> load_numbers(const Rows& rising, const Rows& residual, const Rows& behind,
                                 const NormalLoad& load, const std::string& branch_note) {
  const std::vector<double> errors = load_errors(rising, load);
  const std::string note = load.stress > 0.0 ? branch_note : "no normal stress";
  return {
      {"sigma_n", mean(rising, &HistoryRow::lateral_stress), "Pa", "mean normal stress up to the peak",
       branch_note},
      {"sigma_n_error", largest(errors), "1",
       "largest relative deviation of the normal stress from the load asked for, up to the peak", note},
      {"sigma_n_error_rms", root_mean_square(errors), "1",
       "root mean square of the relative deviation of the normal stress from the load asked for, up to "
       "the peak",
       note},
      {"sigma_n_error_residual", root_mean_square(load_errors(residual, load)), "1",
       "root mean square of the relative deviation of the normal stress from the load asked for, over the "
       "last quarter of the shear displacement",
       note},
      {"box_lifted", lifted_share(load_errors(behind, load)), "1",
       "share of the rows that tau_residual and dilation are read from in which the normal stress is below "
       "5 % of the load asked for",
       note}};
}

}  // namespace

std::vector<Number> plane_numbers(const History& history, const analysis::LoadingBranch& branch,
                                  const NormalLoad& load) {
  const std::string note = analysis::branch_note(branch);
  const double end = history.rows.empty() ? nan : history.rows.back().axial_strain;
  const Rows rising = between(history, 0.0, branch.strain);
  const Rows residual = between(history, (1.0 - residual_part) * end, end);
  // Right behind the peak asperities still break: dilation is read where they slide.
  const Rows sliding = between(history, 0.5 * (branch.strain + end), end);
  // Between 40 and 60 % of the strength: beyond the seating of the boxes, before slip.
  Rows middle;
  for (const HistoryRow& r : analysis::first_passage(branch, {0.4, 0.6})) middle.push_back(&r);
  // Without a peak nothing is behind it.
  const double tau_residual = branch.peaked ? mean(residual, &HistoryRow::axial_stress) : nan;
  std::vector<Number> out = {
      {"tau_peak", branch.peaked ? branch.largest : nan, "Pa",
       "largest shear stress (mean of both boxes over the initial width)", note},
      {"u_peak", branch.peaked ? branch.strain : nan, "m", "shear displacement at the largest shear stress",
       note},
      {"tau_residual", tau_residual, "Pa",
       "mean shear stress over the last quarter of the shear displacement", note},
      {"K_s", slope(middle, &HistoryRow::axial_stress), "Pa/m",
       "slope of shear stress over shear displacement between 40 and 60 % of tau_peak", note},
      // Over the stress that was there, not over the one asked for: it is the friction of what slides.
      {"mu_residual", tau_residual / mean(residual, &HistoryRow::lateral_stress), "1",
       "tau_residual over the mean normal stress of the same quarter",
       load.stress > 0.0 ? note : "no normal stress"},
      {"dilation",
       branch.peaked ? -std::atan(slope(sliding, &HistoryRow::lateral_strain)) * 180.0 / std::numbers::pi
                     : nan,
       "deg",
       "angle of dilation: opening over shear displacement in the second half of the sliding after the peak",
       note}};
  // Both end with the test, so that the longer one holds the other.
  const Rows& behind = residual.size() > sliding.size() ? residual : sliding;
  const std::vector<Number> kept = load_numbers(rising, residual, behind, load, note);
  // Beside the strengths that depend on them.
  out.insert(out.begin() + 3, kept.begin(), kept.end());
  return out;
}

std::vector<Number> shear_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                  const NormalLoad& load) {
  const analysis::LoadingBranch branch = analysis::loading_branch(history);
  std::vector<Number> out = plane_numbers(history, branch, load);
  analysis::add(out, analysis::crack_initiation(branch, cracks, 0.0));
  analysis::add(out, analysis::common_numbers(history, branch, cracks, {}));  // the boxes carry no wave
  return out;
}

}  // namespace phy::lab
