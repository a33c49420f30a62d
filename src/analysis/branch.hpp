// The loading branch of a history: what "before the peak" and "x % of ucs" mean, said once for all numbers.
#pragma once
#include <cstddef>
#include <span>
#include <string>

#include "analysis/strength_rule.hpp"
#include "base/nan.hpp"
#include "records/result.hpp"

namespace phy::analysis {

/// Rows from the first usable one to that of the strength: the one with the largest axial stress (the first
/// of several), unless the test may harden and an earlier peak or knee is its strength (strength_rule.hpp). A
/// row whose stress or strain is no number is not usable. Empty when the stress never rises above zero.
/// Refers to the history's own rows.
struct LoadingBranch {
  std::span<const HistoryRow> rows;
  double largest = nan;  ///< largest axial stress of these rows, in the last of them [Pa]
  double strain = nan;   ///< axial platen strain there
  /// It is the strength. Of a test that does not harden: at least one row follows.
  bool peaked = false;
  bool may_harden = false;  ///< TestDescription::may_harden: only then is there a rule
  StrengthRule rule = StrengthRule::largest;
  double highest = nan;                 ///< largest axial stress of the whole history [Pa]
  const char* strength = "ucs";         ///< what the largest stress of this kind of test is called
  const char* stress = "axial stress";  ///< and the stress
  const char* body = "platen";          ///< what pushes or pulls

  bool empty() const { return rows.empty(); }
  bool at_knee() const { return rule == StrengthRule::knee; }
  /// "peak" or "knee": what the rows lead up to.
  const char* turn() const { return at_knee() ? "knee" : "peak"; }
  /// "the largest axial stress", "the first peak of the axial stress", "the knee of the axial stress".
  std::string point() const;
};
/// `stop`: of the recipe; only tests that may harden ask for it.
LoadingBranch loading_branch(const History& history, const StopRule& stop = {});

/// A range of axial stress in fractions of the largest stress, 0 <= lo < hi <= 1.
struct StressRange {
  double lo = 0.4;
  double hi = 0.6;
};

/// Rows of the first passage: from the first row at or above lo to the last one before the first above hi.
std::span<const HistoryRow> first_passage(const LoadingBranch& branch, StressRange range);

/// Which axial strain: `gauge` is free of end effects (least squares over the middle 60 %), `platen` is what
/// a laboratory without gauges reads.
enum class StrainFrom { gauge, platen };
double HistoryRow::*axial_strain_of(StrainFrom from);

/// Axial stress [Pa] where the axial platen strain first reaches `strain`, straight between rows; before the
/// first row its stress, after the last row NaN.
double stress_at(const LoadingBranch& branch, double strain);

/// "the stress never rises above zero", "no peak: ...", or nothing: what every number of this branch has to
/// say.
std::string branch_note(const LoadingBranch& branch);

/// Joins two notes with "; ".
std::string joined(std::string a, const std::string& b);

}  // namespace phy::analysis
