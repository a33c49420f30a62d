// The numbers of a test, read from its history alone: so the same code reads a PFC history or a
// laboratory curve. Every number carries its SI value, its unit and the definition used; what cannot be
// determined is NaN with a note. A value with a note is to be read with that note ("below ...": an upper
// bound; "no peak": the percentages refer to the largest stress so far). All reading is linear in the number
// of rows and cracks.
//
//   elastic.hpp    E_tangent E_secant E_small nu, and the same with _platen
//   strength.hpp   ucs peak_strain sigma_ci sigma_first_crack sigma_cd
//   cracks.hpp     cracks_{tension,shear}_{matrix,bedding}, and the same with _at_peak
//   tension.hpp    sigma_t in the place of ucs, failure_position failure_at_grip      (direct_tension)
//   brazilian.hpp  bts in the place of ucs, first_crack_{y,x} central_cracks          (brazilian)
//   confined.hpp   q_max in the place of ucs, sigma_1 sigma_3 confinement_error       (biaxial)
//   shear.hpp      tau_peak u_peak tau_residual sigma_n K_s mu_residual dilation ...  (direct_shear)
//   energy.hpp     energy_<column>, and the same with _at_peak; energy_error kinetic_ratio platen_difference
//                  rows_to_peak wave_transits peak_confirmed
#pragma once
#include <string>
#include <vector>

#include "analysis/branch.hpp"
#include "analysis/shear.hpp"
#include "records/result.hpp"

namespace phy {

struct AnalysisOptions {
  double grip_thickness = 0.0;    ///< of a direct tension test [m]
  double disc_diameter = 0.0;     ///< of a Brazilian test [m]
  double confining_stress = 0.0;  ///< of a biaxial test [Pa]
  NormalLoad normal_load;         ///< of a direct shear test
  double density = 0.0;           ///< of the rock [kg/m^3]; 0: not known, nor how often waves crossed
  double length = 0.0;            ///< of the specimen along the load [m]; 0: not known
  double jump_strain = 0.0;       ///< axial strain of a jump start, 0: none; cracks below it could not show
  StressRange tangent = {0.4, 0.6};  ///< of E_tangent and nu, fractions of ucs
  double secant = 0.5;               ///< level of E_secant, fraction of ucs
  /// Of E_small: before cracking, comparable with the direct elastic solution.
  StressRange small_strain = {0.1, 0.2};
};

/// All numbers of one test, by the kind that its history names, in the order above.
std::vector<Number> analyse(const History& history, const std::vector<CrackEvent>& cracks,
                            const AnalysisOptions& options = {});

/// The number of that name, or nullptr.
const Number* find(const std::vector<Number>& numbers, const std::string& name);

}  // namespace phy
