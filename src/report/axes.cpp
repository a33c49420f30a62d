#include "report/axes.hpp"

namespace phy {

TestAxes test_axes(TestKind kind) {
  TestAxes a;
  a.value = &HistoryRow::axial_stress;
  switch (kind) {
    case TestKind::direct_tension:
      a.strain = "elongation", a.strain_unit = "%", a.stress = "tensile stress", a.sign = -1.0;
      a.strength = "sigma_t", a.strength_label = "direct tensile strength",
      a.property = Property::direct_tension;
      return a;
    case TestKind::uniaxial: break;
  }
  a.strain = "axial strain", a.strain_unit = "%", a.stress = "axial stress";
  a.strength = "ucs", a.strength_label = "UCS";
  return a;
}

}  // namespace phy
