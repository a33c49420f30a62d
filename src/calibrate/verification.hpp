// The verification: the calibrated model on packings that the fit has not seen, beside the table.
#pragma once
#include <vector>

#include "calibrate/stages.hpp"

namespace phy::calibrate {

/// Tests whose specimens are shown. Not at once: another model may have to show its own.
struct Pictures {
  bool at_once = true;
  Recipe recipe;
  std::vector<Target> tests;
  std::int64_t packing = 0;
};

struct Verified {
  std::vector<Comparison> rows;           ///< moduli, then strengths
  std::vector<Comparison> fitted_moduli;  ///< of the fit, as the laboratory reads them
  std::vector<Comparison> tangents;       ///< Calibration::tangent_from_test
  std::vector<Comparison> compared;       ///< K_Ic of a rock whose grain size nobody has stated
  int n_packings = 0;                     ///< tested
  std::vector<Finding> notes;
};

/// Moduli alone.
Verified verified(const Moduli& moduli);
/// With strengths. `pictures.at_once`: the tests leave pictures; else they are only named.
Verified verified(const StageTask& task, const Moduli& moduli, const Strengths& strengths,
                  Pictures& pictures);

/// Specimens for a verification that has kept none.
void run_for_pictures(const Pictures& pictures, const Listener& listener, Simulator& simulator);

/// A recipe that keeps pictures as usual.
Recipe with_pictures(Recipe recipe);

}  // namespace phy::calibrate
