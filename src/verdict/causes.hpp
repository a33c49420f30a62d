// Why a calibration ended as it did, and what to do next.
//
// The misfit of a cell is its error over what it may miss by (docs/calibration.md, "Verdict"); its
// squares, summed over moduli, UCS and tension, rank these three. For each a short list of rules is tried,
// from the particular to the general; a rule speaks only where numbers of the result bear it beyond chance,
// and what it says is true of the table and the model whoever reads it. What no rule explains is named by its
// farthest cell.
#pragma once
#include <optional>
#include <vector>

#include "records/calibration.hpp"
#include "verdict/view.hpp"

namespace phy::verdict {

/// Sets uses, causes and next step of a verdict whose status and findings are known.
void explain(Calibration& calibration);

/// What the model is good for and what not.
void state_uses(const Calibration& calibration, Verdict& verdict);

/// A rule: what is wrong with its part of the table, with the advice; nothing: it does not apply.
using CauseRule = std::optional<Finding>(const View&);
CauseRule nu_of_no_body, finer_grains, stiffening, of_no_body, moduli_scaled, modulus_ratio;  // moduli
CauseRule weakest_angle, ucs_ratio;                                                           // compression
CauseRule tension_ratio, initiation_ratio, grains_for_toughness;  // other strengths

/// What the maps expect the model to miss as well, where the part is farthest off.
std::optional<Finding> expected_in_maps(const View& view, Part part);

/// May a longer search come nearer? Where this one had not settled, a longer one is left, the table is not
/// out of reach, and the maps expect the model to miss the strengths by less than it does.
bool search_can_help(const View& view);

}  // namespace phy::verdict
