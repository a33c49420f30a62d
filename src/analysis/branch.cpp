#include "analysis/branch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/nan.hpp"
#include "records/test_description.hpp"

namespace phy::analysis {

namespace {

/// Ends the branch at the strength of a test that may harden.
void apply_rule(LoadingBranch& branch, const History& history, const StopRule& stop) {
  std::vector<const HistoryRow*> rows;
  std::vector<double> strain, stress;
  for (const HistoryRow& r : history.rows) {
    if (!std::isfinite(r.axial_stress) || !std::isfinite(r.axial_strain)) continue;
    rows.push_back(&r), strain.push_back(r.axial_strain), stress.push_back(r.axial_stress);
  }
  // Rows that hold no number are no part of a curve; the answer is a place among those that are.
  const StrengthPoint point = strength_point(strain, stress, stop);
  const HistoryRow* const at = rows[point.row];
  // All numbers before the strength are read in rows up to it.
  branch.rows = {branch.rows.data(), static_cast<std::size_t>(at - branch.rows.data()) + 1};
  branch.rule = point.rule, branch.peaked = point.rule != StrengthRule::largest;
  branch.largest = at->axial_stress, branch.strain = at->axial_strain;
}

}  // namespace

std::string LoadingBranch::point() const {
  if (at_knee()) return std::string("the knee of the ") + stress;
  return std::string(largest < highest ? "the first peak of the " : "the largest ") + stress;
}

LoadingBranch loading_branch(const History& history, const StopRule& stop) {
  LoadingBranch branch;
  const TestDescription& test = *history.kind;
  branch.strength = test.curve.strength.c_str(), branch.stress = test.stress, branch.body = test.body;
  branch.may_harden = test.may_harden;
  const auto& rows = history.rows;
  std::size_t first = rows.size();
  double largest = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const HistoryRow& r = rows[i];
    if (!std::isfinite(r.axial_stress) || !std::isfinite(r.axial_strain)) continue;
    first = std::min(first, i);
    // A row that does not exceed the largest stress confirms it as a peak.
    branch.peaked = !branch.rows.empty();
    // Strictly: of equal rows the first is the peak.
    if (!(r.axial_stress > largest)) continue;
    largest = branch.largest = branch.highest = r.axial_stress;
    branch.strain = r.axial_strain;
    branch.rows = {rows.data() + first, i + 1 - first};
    branch.peaked = false;
  }
  if (branch.may_harden && !branch.empty()) apply_rule(branch, history, stop);
  return branch;
}

std::span<const HistoryRow> first_passage(const LoadingBranch& branch, StressRange range) {
  const auto& rows = branch.rows;
  std::size_t first = 0;
  while (first < rows.size() && !(rows[first].axial_stress >= range.lo * branch.largest)) ++first;
  std::size_t last = first;
  // The first passage: a stress that swings back into the range later is not read again.
  while (last < rows.size() && !(rows[last].axial_stress > range.hi * branch.largest)) ++last;
  return rows.subspan(first, last - first);
}

double HistoryRow::*axial_strain_of(StrainFrom from) {
  return from == StrainFrom::gauge ? &HistoryRow::axial_strain_gauge : &HistoryRow::axial_strain;
}

double stress_at(const LoadingBranch& branch, double strain) {
  const HistoryRow* before = nullptr;
  for (const HistoryRow& r : branch.rows) {
    if (!std::isfinite(r.axial_stress) || !std::isfinite(r.axial_strain)) continue;
    if (r.axial_strain >= strain) {
      // Nothing is known before the first row.
      if (before == nullptr) return r.axial_stress;
      const double w = (strain - before->axial_strain) / (r.axial_strain - before->axial_strain);
      return before->axial_stress + w * (r.axial_stress - before->axial_stress);
    }
    before = &r;
  }
  return nan;
}

std::string branch_note(const LoadingBranch& branch) {
  if (branch.empty()) return "the stress never rises above zero";
  if (branch.peaked) return "";
  if (!branch.may_harden)
    return fmt::format("no peak: the largest stress, {:.4g} MPa, is in the last row", branch.largest * 1e-6);
  return fmt::format("no peak and no knee: the largest stress is {:.4g} MPa", branch.largest * 1e-6);
}

std::string joined(std::string a, const std::string& b) {
  if (!a.empty() && !b.empty()) a += "; ";
  return a + b;
}

}  // namespace phy::analysis
