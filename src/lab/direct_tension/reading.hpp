// Direct tension: tensile strength, moduli in tension, and the place of failure.
//
// The history is compression positive, so a tension test runs into the negative; its numbers are read from
// the mirrored history and are positive. Bonded-particle rock is softer in tension than in compression when
// its linear contacts carry no tension: E_tangent of a press and of a tension test are different material
// numbers.
//   sigma_t           largest tension
//   failure_position  median height of the cracks from the peak on, 0 = bottom, 1 = top
//   failure_at_grip   share of these cracks within 1.5 grip thicknesses of an end; above one half the
//                     strength is that of the gripping, a lower bound, and its note says so
#pragma once
#include <vector>

#include "analysis/energy.hpp"
#include "records/result.hpp"

namespace phy::lab {

/// The history and cracks of a tension test seen in a mirror: tension, elongation and widening positive.
History mirrored(History history);
std::vector<CrackEvent> mirrored(std::vector<CrackEvent> cracks);

/// failure_position and failure_at_grip [1] of an unmirrored test whose peak came at axial strain
/// `peak_strain` (negative); NaN with a note without cracks from there on.
std::vector<Number> place_of_failure(const History& history, const std::vector<CrackEvent>& cracks,
                                     double peak_strain, double grip_thickness);

/// All numbers of an unmirrored test. `path`: of a wave between the grips.
std::vector<Number> tension_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                    double grip_thickness, const analysis::WavePath& path);

}  // namespace phy::lab
