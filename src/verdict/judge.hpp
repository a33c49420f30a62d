// The verdict: does the model have the values of the table, on packings that it was not fitted to?
//
// Every value is judged by itself (margin.hpp): within its margin or not. Without a miss the model is
// calibrated, if every margin is fine enough to tell; else the table does not resolve the question, and the
// verdict says what a row would let pass and how many specimens more would change that. With misses it is
// calibrated except for these. Out of reach: E misses by more than 6 % in the fit, or the strengths together
// by more than 10 % and twice what chance explains, or by 20 %, or something has no answer at all.
#pragma once
#include <optional>
#include <vector>

#include "records/calibration.hpp"

namespace phy::verdict {

/// Is a fit of the moduli out of reach: an E off by more than 6 % and its margin, or a value without answer?
bool moduli_out_of_reach(const std::vector<Comparison>& moduli);

/// What is to be judged.
struct Results {
  std::vector<Comparison> moduli;             ///< of the fit, as the laboratory reads them
  std::vector<ParameterEstimate> parameters;  ///< of the moduli
  /// Largest error of E with full weight on nu, where nu gave way to E.
  std::optional<double> E_before_nu_gave_way;
  std::vector<Finding> limits_of_table;  ///< why no model has its E and nu
  std::vector<Finding> of_search;        ///< strengths without an answer: out of reach
  std::vector<Comparison> verification;  ///< on unseen packings, moduli first, in the order of `moduli`
};

/// Status and findings; causes and next step: explain(), when all of a calibration is known.
Verdict judge(Results results);

/// Where a model is out of reach the interval of a row may leave out what was measured: it says what the
/// model can do, not where the rock is. Takes such intervals away; true: there were some.
bool withdraw_intervals(std::vector<Comparison>& fitted);

}  // namespace phy::verdict
