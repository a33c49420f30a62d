// Every value of a table judged together with the others: met, missed, or open.
//
// Two questions, each with the standard error of the difference of both means, that of the laboratory's
// specimens and that of the model's packings (Welch 1947, degrees of freedom by Satterthwaite 1946). Is it
// missed: does chance explain the difference, all values taken together? Holm's step-down over weighted
// hypotheses (Benjamini & Hochberg 1997): where the model is the rock, no value is called missed in 95 % of
// tables, however many values they have. Is it met: is an error beyond coarsest() excluded (two one-sided
// tests, Schuirmann 1987, 5 % each)? What is neither is open: poor data leave values open and miss none.
#pragma once
#include <optional>
#include <vector>

#include "records/calibration.hpp"

namespace phy::verdict {

/// Misses that pass whatever the scatter.
inline double tolerance(Property property) { return measured(property).tolerance; }
/// The least error that matters: below it a value is met.
inline double coarsest(Property property) { return measured(property).coarsest; }

/// From where a table is out of reach: the miss of an E, the root mean square of those of the strengths.
constexpr double modulus_limit = 0.06, strength_limit = 0.10;

/// Standard errors beyond which a difference is no chance, 1 % to both sides.
constexpr double z_99 = 2.58;

/// Model less laboratory: relative, but of nu absolute.
double miss_of(const Comparison& row);

enum class Outcome { met, missed, open, unanswered };

struct JudgedCell {
  Comparison row;
  Outcome outcome = Outcome::unanswered;
  double bound = nan;   ///< errors up to this one are not excluded; relative, but of nu absolute
  bool alone = false;   ///< called missed by a test of its own at 5 %
  double change = 0.0;  ///< model over laboratory, a logarithm; of nu the difference
  double error = 0.0;   ///< standard error of `change`, by which laboratory and packings contribute
  double of_packings = 0.0, degrees = 0.0;

  /// The miss over the one that passes by itself: the tolerance, or what chance explains in 95 % of tables.
  double scaled_miss() const;
};

/// In the order of the rows.
std::vector<JudgedCell> judge_cells(const std::vector<Comparison>& rows);

/// Calibrated: none is missed and nine of ten are met. With exceptions: a third is missed at most, and half
/// are met or more. Not calibrated: more are missed, or fewer met. Not decided: none is missed, but too many
/// are open. Values that chance would flag need no share of their own: Holm's step-down flags none of them.
VerdictStatus status_of(const std::vector<JudgedCell>& cells);

/// Specimens more with which this difference would be met; nothing: no number below a hundred.
std::optional<int> specimens_missing(const JudgedCell& cell);

/// Unseen packings of a verification. Five are enough where the means over them are known to a quarter of the
/// tolerance (standard error, root mean square over the strengths); where packings differ by more, their
/// scatter would leave values open, so five more are tested, and once more.
constexpr std::size_t first_packings = 5, most_packings = 15;
bool wants_packings(const std::vector<Comparison>& verification);

}  // namespace phy::verdict
