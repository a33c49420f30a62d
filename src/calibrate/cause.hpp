// One sentence of verdict: status, what most of the misfit is about, and what to do next.
//
// The misfit of a cell is its error over what it may miss by (docs/calibration.md, "Verdict"); its
// squares, summed over moduli, UCS and tension, rank these three. For each a short list of rules is tried,
// from the particular to the general; a rule speaks only where numbers of the result bear it beyond chance,
// and what it says is true of the table and the model whoever reads it. What no rule explains is named by its
// farthest cell.
#pragma once
#include <string>

#include "records/calibration.hpp"

namespace phy::calibrate {

/// "out of reach: 64 % of the misfit is in E and nu: ...; next: ...".
std::string verdict_sentence(const Calibration& calibration);

}  // namespace phy::calibrate
