// Figures of what varies: the paper's Figs. 4 (macro stiffnesses), 5 (E) and 6 (strength) over its
// parameters.
#pragma once
#include "records/variation.hpp"
#include "report/figure.hpp"

namespace phy::report {

/// K_n and K_s over every parameter, divided by its base, from Eq. 1 fitted to E(theta), and what others
/// found for them. A stiffness that no parameter has gets no panel.
Figure macro_figure(const Variation& variation);
/// E and UCS over the inclination, for every value of one parameter; lines: Eq. 1 fitted.
Figure parameter_figure(const Variation& variation, const VariedParameter& parameter);

// For print; they throw InputError when the study does not hold what they show.

Figure stiffness_figure(const Variation& variation);
/// E, a panel per stiffness of the joints.
Figure modulus_figure(const Variation& variation);
/// UCS, a panel per parameter.
Figure strength_figure(const Variation& variation);

}  // namespace phy::report
