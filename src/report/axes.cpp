#include "report/axes.hpp"

namespace phy {
namespace {

/// The column of this name, if the kind of test records it.
double HistoryRow::*column(TestKind kind, const std::string& name) {
  for (const HistoryColumn& c : history_columns(kind))
    if (name == c.name) return c.value;
  return &HistoryRow::axial_stress;
}

}  // namespace

TestAxes test_axes(TestKind kind) {
  const std::string name = to_string(kind);
  if (name == "direct_tension")
    return {"elongation",
            "%",
            100.0,
            "tensile stress",
            "sigma_t",
            "direct tensile strength",
            Property::direct_tension,
            -1.0};
  if (name == "brazilian")
    return {"closure of the platens / diameter",
            "%",
            100.0,
            "tension at the centre",
            "bts",
            "Brazilian strength",
            Property::brazilian};
  if (name == "biaxial")
    return {"axial strain",      "%",     100.0,
            "deviatoric stress", "q_max", "largest deviatoric stress",
            std::nullopt,        1.0,     column(kind, "deviatoric_stress")};
  if (name == "direct_shear")
    return {"shear displacement",  "mm",        1000.0, "shear stress", "tau_peak",
            "peak shear strength", std::nullopt};
  return {"axial strain", "%", 100.0, "axial stress", "ucs", "UCS", Property::ucs};
}

}  // namespace phy
