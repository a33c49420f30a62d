// Fracture toughness in a calibration: K_Ic of the semi-circular bend test (lab/semi_circular_bend).
//
// A bonded model breaks at the end of a notch where the first bond there does, and what a bond feels of K_I
// shrinks with the root of its distance from that end: K_Ic = sigma_t sqrt(pi alpha R), sigma_t the tensile
// strength, R the mean radius of the grains (Potyondy & Cundall 2004, Int. J. Rock Mech. Min. Sci.
// 41:1329-1364). At strengths that the rest of a table fixes, K_Ic is a matter of the size of the grains: it
// is fitted where somebody has stated that size, else compared with, and the size that would meet it is told.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "calibrate/evidence.hpp"
#include "calibrate/surrogate.hpp"
#include "records/calibration.hpp"

namespace phy::calibrate {

/// What is known of log(K_Ic/sigma_c) [of sqrt(m)] beforehand: the Brazilian strength that is expected at the
/// same inclination, where a disc splits along its load as a half disc from its notch, times
/// sqrt(pi alpha R); sigma_c in place of that strength where nothing was mapped. `splitting`: of
/// log(BTS/sigma_c), nothing where nothing was mapped.
PriorMean prior_toughness(const Recipe& recipe, const std::optional<PriorMean>& splitting);

/// Mean diameter of the grains [m] that would meet the table at the same strengths:
/// d (K_Ic of the table/K_Ic of the model)^2, the geometric mean over the rows; NaN without an answer.
double grain_size_to_meet(const std::vector<Comparison>& toughness, double grain_size);

/// May a specimen of the model's size be made of grains of this mean diameter [m]?
bool can_hold(const Recipe& model, double grain_size);

/// The same in words, with how many grains of that size go into the specimen.
std::string compared_in_words(const std::vector<Comparison>& toughness, const Recipe& model);

}  // namespace phy::calibrate
