// The paper's way to parameters, step by step, beside this program's own (docs/calibration.md, "The paper's
// sequence"): moduli in closed form, then one strength after the other. What follows - verification on unseen
// packings, verdict, files - is the same for both (calibration.cpp).
//
// Of the paper: Eq. 1 through E(theta) gives E, K_n and K_s of the rock; Eq. 2, a line through K over k of
// the joints, gives k_n from K_n and k_s from K_s; strengths hardly move moduli and come after them, one at a
// time. Our text of the paper ends before its own example, so the rest is decided here:
//
//   E in Eq. 1   is E(90), in the table and in the model alike; without it, E is free.
//   k_s/k_n      by bisection, from nu(90), or from nu(0) E/E(0), which is the same number of any body with
//                planes in isotropic rock; without either, the recipe's.
//   E_c          from E: the packing without joints has it.
//   Eq. 2        is regenerated on the packings of the fit, contacts that only push, five factors on k about
//   a
//                base, which moves until what is sought lies within the factors.
//   strengths    by bisection of single tests on one packing, as the paper's users do, at the speed of the
//                verification: sigma_c against UCS near 90 degrees, else near 0 (the joints' strengths hardly
//                move either, docs/paper.md, Fig. 6); cohesion of the joints against the lowest other UCS;
//                sigma_n of the joints against the steepest of the rest, which it moves most (same figure).
//                Strengths that come later go along in proportion. Rounds, until one moves nothing.
//   the rest     - tau_c/sigma_c (1 in the paper), both frictions - stays as the recipe has it.
//
// A sequence has no intervals: estimates have NaN there.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "calibrate/elastic_fit.hpp"
#include "calibrate/strength_stage.hpp"

namespace phy::calibrate {

/// Throws InputError with everything in a rock or its table that the sequence cannot work with.
void check_sequence(const Evidence& evidence);

/// In place of fit_elastic().
ElasticFit moduli_by_sequence(const Evidence& evidence, const std::vector<std::int64_t>& seeds,
                              Simulator& simulator, const std::function<void(const Finding&)>& begins);

/// Rounds of the strengths until one moves nothing, at most.
constexpr int most_sequence_rounds = 4;

/// In place of fit_strength(), on the first packing of the task; moduli are fitted anew after every round
/// that moved a strength.
void strengths_by_sequence(const SearchTask& task, StrengthFit& fit);

}  // namespace phy::calibrate
