// The numbers of a test, read from its history alone: so the same code reads a PFC history or a
// laboratory curve. Every number carries its SI value, its unit and the definition used; what cannot be
// determined is NaN with a note. A value with a note is to be read with that note ("below ...": an upper
// bound; "no peak": the percentages refer to the largest stress so far; "a knee": it is no peak). Reading
// is linear in the number of rows and cracks, but for the strength of tests that may harden
// (strength_rule.hpp).
//
//   elastic.hpp    E_tangent E_secant E_small nu, and the same with _platen; area_change nu_spread
//                  cracks_in_window
//   strength.hpp   ucs (or what the strength of the test is called) peak_strain strength_rule largest_stress
//                  sigma_ci sigma_first_crack sigma_cd sigma_cd_volume
//   crack_strain.hpp  sigma_ci_strain
//   cracks.hpp     cracks_{tension,shear}_{matrix,bedding}, and the same with _at_peak
//   energy.hpp     energy_<column>, and the same with _at_peak; energy_error kinetic_ratio platen_difference
//                  rows_to_peak wave_transits peak_confirmed
//
// A test composes its list from these and from what is its own (lab/NAME/reading.hpp).
#pragma once
#include <string>
#include <vector>

#include "analysis/branch.hpp"
#include "analysis/energy.hpp"
#include "records/result.hpp"

namespace phy::analysis {

struct AxialOptions {
  WavePath path;
  double pre_strain = 0.0;           ///< affine axial pre-strain, 0: none; cracks below it could not show
  StressRange tangent = {0.4, 0.6};  ///< of E_tangent and nu, fractions of the strength
  double secant = 0.5;               ///< level of E_secant, fraction of the strength
  /// Of E_small: before cracking, comparable with the direct elastic solution.
  StressRange small_strain = {0.1, 0.2};
};

/// A specimen loaded along its axis: strength, elasticity, damage, then what every test has.
std::vector<Number> axial_numbers(const History& history, const LoadingBranch& branch,
                                  const std::vector<CrackEvent>& cracks, const AxialOptions& options);

/// What every test has: cracks, energies, checks.
std::vector<Number> common_numbers(const History& history, const LoadingBranch& branch,
                                   const std::vector<CrackEvent>& cracks, const WavePath& path);

/// Puts more numbers behind those that are there.
void add(std::vector<Number>& numbers, std::vector<Number> more);

/// The list as a result holds it: what has no finite value is NaN, and says why.
std::vector<Number> with_reasons(std::vector<Number> numbers);

/// The number of that name, or nullptr.
const Number* find(const std::vector<Number>& numbers, const std::string& name);

/// Says of every modulus, of nu and of the onset of cracks whose range of stress was passed while the loading
/// bodies changed their speed, between the strains `from` and `to`, that it was: inertia bends the curve
/// there.
void note_slowing(std::vector<Number>& numbers, const LoadingBranch& branch, double from, double to);

}  // namespace phy::analysis
