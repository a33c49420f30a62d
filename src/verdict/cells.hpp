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

enum class Outcome { met, missed, open, unanswered };

struct JudgedCell {
  Comparison row;
  Outcome outcome = Outcome::unanswered;
  double bound = nan;   ///< errors up to this one are not excluded; relative, but of nu absolute
  bool alone = false;   ///< called missed by a test of its own at 5 %
  double change = 0.0;  ///< model over laboratory, a logarithm; of nu the difference
  double error = 0.0;   ///< standard error of `change`, by which laboratory and packings contribute
  double of_packings = 0.0, degrees = 0.0;
};

/// In the order of the rows.
std::vector<JudgedCell> judge_cells(const std::vector<Comparison>& rows);

/// Specimens more with which this difference would be met; nothing: no number below a hundred.
std::optional<int> specimens_missing(const JudgedCell& cell);

}  // namespace phy::verdict
