#include "lab/biaxial/reading.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/analyse.hpp"
#include "analysis/strength.hpp"
#include "base/nan.hpp"

namespace phy::lab {

History deviatoric(History history) {
  for (HistoryRow& r : history.rows) {
    // The numbers of uniaxial compression read in q = sigma_1 - sigma_3, which is zero when loading begins.
    for (double* stress : {&r.axial_stress, &r.stress_top, &r.stress_bottom}) *stress -= r.lateral_stress;
  }
  return history;
}

std::vector<Number> confined_strength(const History& history, const analysis::LoadingBranch& branch,
                                      double confining_stress) {
  const std::string note = analysis::branch_note(branch);
  Number axial{"sigma_1", nan, "Pa", "axial stress at " + branch.point(), analysis::strength_note(branch)};
  Number lateral{"sigma_3", nan, "Pa", "lateral stress at " + branch.point(), note};
  Number error{
      "confinement_error", nan, "1",
      std::string("largest |lateral stress / target - 1| from the start of loading to the ") + branch.turn(),
      note};
  for (const HistoryRow& r : history.rows) {
    // Behind the peak the sides may well lose their stress: nothing is read there.
    if (branch.empty() || r.axial_strain > branch.strain) break;
    if (confining_stress > 0.0)
      error.value = std::fmax(error.value, std::fabs(r.lateral_stress / confining_stress - 1.0));
    if (branch.peaked && r.axial_strain == branch.strain)
      axial.value = r.axial_stress, lateral.value = r.lateral_stress;
  }
  if (confining_stress == 0.0) error.note = "not confined";
  return {axial, lateral, error};
}

std::vector<Number> confined_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                     double confining_stress, const analysis::WavePath& path,
                                     const analysis::StopRule& stop) {
  const History q = deviatoric(history);
  const analysis::LoadingBranch branch = analysis::loading_branch(q, stop);
  std::vector<Number> out = analysis::axial_numbers(q, branch, cracks, {path});
  const std::vector<Number> own = confined_strength(history, branch, confining_stress);
  // Beside the strength, where a table of confined tests is read first.
  out.insert(out.begin() + 2, own.begin(), own.end());
  return out;
}

}  // namespace phy::lab
