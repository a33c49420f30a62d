// The verdict: does the model have the values of the table, on packings that it was not fitted to?
//
// All values are judged together (cells.hpp). Calibrated: none is missed and nine of ten are met. Not
// decided: none is missed, but too many are open; the findings say how many specimens would change that.
// Calibrated except: a few are missed. Not calibrated: more than a few, or the strengths together by more
// than 10 % and twice what chance explains. Out of reach: an E is missed by more than 6 %, in the fit as
// well; or something has no answer at all; or strengths are missed together, and that is the model's limit:
// the search had settled, or the maps expect it of this model whatever the search.
#pragma once
#include <optional>
#include <vector>

#include "records/calibration.hpp"

namespace phy::verdict {

/// Is a fit of the moduli out of reach: an E missed by more than 6 %, or a value without answer?
bool moduli_out_of_reach(const std::vector<Comparison>& moduli);

/// What is to be judged.
struct Results {
  std::vector<Comparison> moduli;             ///< of the fit, as the laboratory reads them
  std::vector<ParameterEstimate> parameters;  ///< of the moduli; of strengths those that are determined
  /// Largest error of E with full weight on nu, where nu gave way to E.
  std::optional<double> E_before_nu_gave_way;
  std::vector<Finding> limits_of_table;  ///< why no model has its E and nu
  std::vector<Finding> of_search;        ///< strengths without an answer: out of reach
  bool search_settled = false;           ///< that of the strengths
  std::vector<Finding> reach;            ///< what the maps say of this model (maps/reach.hpp)
  std::vector<Comparison> verification;  ///< on unseen packings, moduli first, in the order of `moduli`
};

/// Status and findings; causes and next step: explain(), when all of a calibration is known.
Verdict judge(const Results& results);

/// Where a model misses the table the interval of a row may leave out what was measured: it says what the
/// model can do, not where the rock is. Takes such intervals away; true: there were some.
bool withdraw_intervals(std::vector<Comparison>& fitted);

}  // namespace phy::verdict
