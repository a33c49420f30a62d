// Curves for pages and figures that no specimen has measured: theory fitted to the specimens of a run, and
// the directions of cracks.
#pragma once
#include <string>
#include <vector>

#include "records/rock.hpp"
#include "records/specimen_record.hpp"
#include "records/variation.hpp"
#include "theory/eq1_fit.hpp"

namespace phy::report {

/// A curve over the inclination; empty, with the reason in `note`, where there is none.
struct AngleCurve {
  std::string note;           ///< what it is and how it was fitted, one sentence with the numbers
  std::vector<double> theta;  ///< [deg]
  std::vector<double> value;  ///< SI
};

struct TheoryCurves {
  AngleCurve E;    ///< Goodman's equivalent continuum fitted to E_tangent [Pa]
  AngleCurve nu;   ///< the Poisson's ratio of the same continuum [1]
  AngleCurve ucs;  ///< Jaeger's plane of weakness fitted to ucs [Pa]
};
TheoryCurves theory_curves(const RunRecord& run);
/// Values of a laboratory under the confining stress that the tests of a run have: those that may stand
/// beside them. All, where nothing was tested.
std::vector<Target> beside(const RunRecord& run, const std::vector<Target>& laboratory);

/// Of a laboratory table: E and UCS; no nu.
TheoryCurves theory_curves(const std::vector<Target>& table);

/// Cracks by direction, anticlockwise from +x: bin k is 180/n degrees wide around k times that, so that a
/// direction along the axes lies in the middle of a bin. A crack counts once.
struct Rose {
  std::vector<double> tension, shear;
  double bin() const { return 180.0 / static_cast<double>(tension.size()); }
};
Rose crack_rose(const std::vector<CrackEvent>& cracks, std::size_t n_bins = 18);

/// Eq. 1 fitted in compliance to E(theta); its E is that at 90 degrees, else `E_intact` [Pa], else free.
theory::Eq1Fit fit_moduli(const std::vector<AngleValue>& E, double E_intact);
/// Macro stiffnesses over a parameter: Eq. 1 fitted to every packing and bond seed by itself; where there is
/// no fit, no point.
std::vector<MacroPoint> macro_points(const Variation& variation, const VariedParameter& parameter);

/// Value of a number for curves and fits: NaN where the result has none, or is not to be trusted.
double value_of(const SpecimenRecord& test, const std::string& name);

}  // namespace phy::report
