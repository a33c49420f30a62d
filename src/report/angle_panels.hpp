// What figures over the inclination of the bedding have in common.
#pragma once
#include <string>

#include "records/rock.hpp"
#include "report/curves.hpp"
#include "report/figure.hpp"

namespace phy::report {

/// Cells of one panel: of one test over the inclination, of sheared bedding over the stress across it.
bool same_panel(const Target& a, const Target& b);
/// Where a cell stands there: [deg], or [MPa].
double place_in_panel(const Target& target);

/// A property in the unit in which people read it.
Axis axis_of(Property property);
/// The inclination, as far as the points go and 90 degrees at least, in panels whose abscissa nobody has
/// named; the rest as fit_axes().
void fit_over_angles(Figure& figure);

Series laboratory_series();
/// Its mean with the 95 % interval; `factor` from SI.
Point point_of(const Target& target, double factor);
Series theory_series(const std::string& name, const AngleCurve& curve, double factor);
/// "Goodman fitted to the model": whoever of Goodman and Jaeger has a curve.
std::string theory_name(const TheoryCurves& curves, const std::string& fitted_to);
/// "error +4.1 %" of a model's value [SI], of a ratio "error +0.012"; empty without a value of the
/// laboratory.
std::string error_beside(double model, const Target* laboratory);

}  // namespace phy::report
