#include "report/axes.hpp"

namespace phy {

TestAxes test_axes(TestKind kind) {
  TestAxes a{"axial strain", "%", 100.0, "axial stress", "ucs", "UCS", Property::ucs};
  switch (kind) {
    case TestKind::uniaxial: break;
    case TestKind::direct_tension:
      a.strain = "elongation", a.stress = "tensile stress", a.sign = -1.0;
      a.strength = "sigma_t", a.strength_label = "direct tensile strength";
      a.property = Property::direct_tension;
      break;
    case TestKind::brazilian:
      a.strain = "closure of the platens / diameter", a.stress = "tension at the centre";
      a.strength = "bts", a.strength_label = "Brazilian strength", a.property = Property::brazilian;
      break;
    case TestKind::biaxial:
      a.stress = "deviatoric stress", a.value = &HistoryRow::deviatoric_stress;
      a.strength = "q_max", a.strength_label = "largest deviatoric stress", a.property = std::nullopt;
      break;
    case TestKind::direct_shear:
      a.strain = "shear displacement", a.strain_unit = "mm", a.strain_factor = 1000.0;
      a.stress = "shear stress", a.strength = "tau_peak", a.strength_label = "peak shear strength";
      a.property = std::nullopt;
      break;
  }
  return a;
}

}  // namespace phy
