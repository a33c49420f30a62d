// The numbers of a compression test, read from its history alone: so the same code reads a PFC history or a
// laboratory curve. Every number carries its unit and the definition used; what cannot be determined is NaN
// with a note.
//
// Definitions (compression positive; gauge = least-squares strain of the middle 60 %)
//   ucs            largest axial stress
//   E_tangent      slope of the straight line fitted to stress over strain between 40 and 60 % of ucs, before
//   the peak E_secant       stress / strain at 50 % of ucs E_small        slope between 5 and 15 % of ucs:
//   before cracking, comparable with the direct elastic solution nu             -slope of lateral over axial
//   strain, 40-60 % of ucs sigma_ci       axial stress when the number of cracks reaches max(3, 1 % of the
//   cracks at the peak) sigma_cd       axial stress where the volumetric strain eps_axial + eps_lateral is
//   largest, before the peak
// Source of sigma_ci: Potyondy & Cundall 2004 (IJRMMS 41:1329-1364).
#pragma once
#include <vector>

#include "records/result.hpp"

namespace phy {

struct AnalysisOptions {
  double jump_strain = 0.0;  ///< axial strain of a jump start; cracks below it could not show
};

/// All numbers of one test.
std::vector<Number> analyse(const History& history, const std::vector<CrackEvent>& cracks,
                            const AnalysisOptions& options = {});

/// The number of that name, or nullptr.
const Number* find(const std::vector<Number>& numbers, const std::string& name);

}  // namespace phy
