// The direct elastic solution against the press: the same specimens, loaded step by step to a small strain.
//
// Two independent ways to one number. Statics factors a matrix of tangent stiffnesses; the press integrates
// motion with the force updates of the laws. With unbreakable bonds and slip off they must agree; with slip
// and cracking on the press shows what the direct solution leaves out. All overlaps count as stress-free in
// both.
#pragma once
#include <string>
#include <vector>

#include "records/recipe.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"
#include "study/work.hpp"

namespace phy::study {

/// Axial strain up to which the press is compared.
constexpr double press_check_strain = 2e-4;

/// E and nu of a press run by the gauge: slopes of stress and lateral strain over axial strain in the upper
/// half of the run. NaN if the press did not get there; `outcome` says why.
struct PressModuli {
  std::string name;  ///< of the specimen
  double E = 0.0;    ///< [Pa]
  double nu = 0.0;
  std::int64_t n_cracks = 0;
  double slip_share = 0.0;  ///< dissipated by slip, of the boundary work
  std::string outcome;      ///< empty if the run reached the strain
};

/// Runs the specimens up to press_check_strain. `elastic`: nothing breaks and nothing slips; else as the
/// recipe has it.
std::vector<PressModuli> press_moduli(const std::vector<Specimen>& specimens, const Recipe& recipe,
                                      const MachineOptions& machine, bool elastic);

}  // namespace phy::study
