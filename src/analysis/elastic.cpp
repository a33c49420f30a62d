#include "analysis/elastic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "base/nan.hpp"
#include "base/stats.hpp"

namespace phy::analysis {
namespace {

constexpr std::size_t enough_rows = 3;  // two rows would always lie on a line
constexpr double straight = 0.9;  // below this R2 the curve is no line: noise, or failure within the range

constexpr std::ptrdiff_t chance = 3;  // cracks, as of sigma_ci: fewer tell nothing

std::string range_text(StressRange range) {
  return fmt::format("{:g} and {:g} %", 100 * range.lo, 100 * range.hi);
}

std::string place_of(const LoadingBranch& branch, StrainFrom from) {
  return from == StrainFrom::gauge ? "gauge (middle 60 %)" : std::string(branch.body) + "s";
}

/// The stress at which the history begins, over the largest: late by an affine pre-strain, or a record
/// switched on late.
double start_of(const LoadingBranch& branch) { return branch.rows.front().axial_stress / branch.largest; }

/// Slope of y over x in the range.
void fit(const LoadingBranch& branch, StressRange range, double HistoryRow::*x, double HistoryRow::*y,
         Number& n) {
  n.note = branch_note(branch);
  if (branch.empty()) return;
  if (const double start = start_of(branch); start > range.lo)
    n.note = joined(n.note, fmt::format("the history starts at {:.3g} % of the largest stress", 100 * start));
  std::vector<double> xs, ys;
  for (const HistoryRow& r : first_passage(branch, range))
    if (std::isfinite(r.*x) && std::isfinite(r.*y)) xs.push_back(r.*x), ys.push_back(r.*y);
  // A few rows lie on a line by chance, and E would be what it likes.
  if (xs.size() < enough_rows) {
    n.note = joined(n.note, start_of(branch) > range.hi
                                ? fmt::format("no row between {} of it", range_text(range))
                                : fmt::format("only {} usable rows between {} of the largest stress, {} are "
                                              "needed: write the history more often",
                                              xs.size(), range_text(range), enough_rows));
    return;
  }
  const LineFit line = fit_line(xs, ys);
  n.value = line.slope;
  if (!std::isfinite(n.value))
    n.note = joined(n.note, "the strain does not change in the range");
  else if (line.R2 < straight)
    n.note = joined(n.note, fmt::format("no straight line: R2 = {:.2f}", line.R2));
}

/// Minus the slope of lateral over axial strain of the gauge.
double nu_of(std::span<const HistoryRow> rows) {
  std::vector<double> axial, lateral;
  for (const HistoryRow& r : rows)
    if (std::isfinite(r.axial_strain_gauge) && std::isfinite(r.lateral_strain_gauge))
      axial.push_back(r.axial_strain_gauge), lateral.push_back(r.lateral_strain_gauge);
  return axial.size() < enough_rows ? nan : -fit_line(axial, lateral).slope;
}

/// Of the cracks up to the strain `end`, those between two strains.
double share_of_cracks(const std::vector<CrackEvent>& cracks, double from, double to, double end) {
  const auto up_to = [&](double strain) {
    return std::count_if(cracks.begin(), cracks.end(),
                         [=](const CrackEvent& c) { return c.strain <= strain; });
  };
  const auto before =
      std::count_if(cracks.begin(), cracks.end(), [=](const CrackEvent& c) { return c.strain < from; });
  const auto inside = up_to(to) - before;
  return inside < chance ? 0.0 : static_cast<double>(inside) / static_cast<double>(up_to(end));
}

}  // namespace

Number tangent_modulus(const LoadingBranch& branch, StressRange range, StrainFrom from, std::string name) {
  Number n{
      std::move(name), nan, "Pa",
      fmt::format(
          "slope of the least-squares line of {} over axial strain of the {} at the first passage between {} "
          "of {}, before the {}",
          branch.stress, place_of(branch, from), range_text(range), branch.strength, branch.turn()),
      ""};
  fit(branch, range, axial_strain_of(from), &HistoryRow::axial_stress, n);
  // A gauge that lengthens under load sits beside a crack.
  if (n.value <= 0.0) n.value = nan, n.note = "the strain falls in this range: no modulus is read";
  return n;
}

Number poisson_ratio(const LoadingBranch& branch, StressRange range, StrainFrom from, std::string name) {
  Number n{std::move(name), nan, "1",
           fmt::format("minus the slope of the least-squares line of lateral strain (gauge) over axial "
                       "strain of the {} at "
                       "the first passage between {} of {}, before the {}",
                       place_of(branch, from), range_text(range), branch.strength, branch.turn()),
           ""};
  fit(branch, range, axial_strain_of(from), &HistoryRow::lateral_strain_gauge, n);
  n.value = 0.0 - n.value;  // not -x: a slope of 0 gives 0
  return n;
}

std::vector<Number> window_checks(const LoadingBranch& branch, const std::vector<CrackEvent>& cracks,
                                  StressRange range) {
  const std::string window = fmt::format("between {} of {}", range_text(range), branch.strength),
                    note = branch_note(branch);
  Number area{
      "area_change", nan, "1",
      "1 - nu: shortening of the area of the middle over its axial strain, in the range of stress " + window,
      note};
  Number spread{"nu_spread", nan, "1",
                "half the difference of nu between the two halves of the range of stress " + window, note};
  Number share{"cracks_in_window", nan, "1",
               fmt::format("cracks while the stress passes the range {} / cracks up to the {}; fewer than "
                           "three count as none",
                           window, branch.turn()),
               note};
  const auto rows = first_passage(branch, range);
  const std::size_t half = rows.size() / 2;
  area.value = 1.0 - nu_of(rows);
  // Two halves that agree: nu is a property there and no passing value.
  if (half >= enough_rows)
    spread.value = 0.5 * std::fabs(nu_of(rows.subspan(half)) - nu_of(rows.first(half)));
  if (!rows.empty())
    share.value = share_of_cracks(cracks, rows.front().axial_strain, rows.back().axial_strain, branch.strain);
  return {area, spread, share};
}

Number secant_modulus(const LoadingBranch& branch, double fraction, StrainFrom from, std::string name) {
  Number n{std::move(name), nan, "Pa",
           fmt::format("{} over axial strain of the {} where the stress first reaches {:g} % of {}",
                       branch.stress, place_of(branch, from), 100 * fraction, branch.strength),
           branch_note(branch)};
  // Of the strength, so that weak and strong rock are read at like states.
  const double level = fraction * branch.largest;
  const auto strain = axial_strain_of(from);
  const HistoryRow* before = nullptr;
  for (const HistoryRow& r : branch.rows) {
    if (!std::isfinite(r.axial_stress) || !std::isfinite(r.*strain)) continue;
    if (r.axial_stress < level) {
      before = &r;
      continue;
    }
    // The history begins above this level: there is nothing to interpolate from.
    if (before == nullptr) break;
    const double w = (level - before->axial_stress) / (r.axial_stress - before->axial_stress);
    const double at_level = before->*strain + w * (r.*strain - before->*strain);
    if (at_level > 0.0)
      n.value = level / at_level;
    else
      n.note = joined(n.note, "the strain at this stress is not positive");
    return n;
  }
  if (!branch.empty())
    n.note = joined(n.note, fmt::format("no row below {:g} % of the largest stress", 100 * fraction));
  return n;
}

}  // namespace phy::analysis
