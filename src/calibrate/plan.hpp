// What a calibration by one model will do: what is fitted, on which packings, and what must be left of the
// budget for what follows the search. Pure: it follows from the table and the options.
#pragma once
#include <cstdint>
#include <vector>

#include "calibrate/options.hpp"
#include "records/evidence.hpp"

namespace phy::calibrate {

/// Packings by their seeds, from that of the rock's recipe on.
struct Packings {
  std::vector<std::int64_t> fit;     ///< of the elastic fit
  std::vector<std::int64_t> spare;   ///< more for it, where packings differ much
  std::vector<std::int64_t> search;  ///< of the strengths, which hardly takes one twice
  std::vector<std::int64_t> unseen;  ///< of the verification, at first
  std::int64_t next_unseen;          ///< where it asks for more
  std::int64_t first_of_ensemble;    ///< of those that nothing before has seen
};
Packings packings_from(std::int64_t first);

/// Seeds from `first` on.
std::vector<std::int64_t> seeds_from(std::int64_t first, int n);

/// The options of a calibration of this table: effort "auto" is normal, and quick where the forecast sees the
/// table out of reach.
CalibrationOptions settled(CalibrationOptions options, const Evidence& evidence);

constexpr int n_softened = 5;  ///< packings on which softening is measured at the estimate

/// What is fitted, and notes on what is not.
struct Scope {
  bool moduli = true, strengths = true;
  /// The table's moduli are those of tests, softened by what breaks and slips until they are read. With
  /// neither UCS nor moduli under confinement there is no test to read them in.
  bool read_in_tests = false;
  std::vector<Finding> notes = {};
};
/// Throws InputError where there is nothing to fit.
Scope scope_of(const Evidence& evidence, const CalibrationOptions& options);

/// Tests in compression on one packing beside the search: some are done to read moduli in alone.
std::int64_t tests_per_packing(const Evidence& evidence, bool read_in_tests);
/// All of them: on unseen packings, and where softening is measured.
std::int64_t tests_beside_search(const Evidence& evidence, bool read_in_tests);
/// Fewest tests in compression; none where no strengths are fitted.
std::int64_t least_tests(const Evidence& evidence, const CalibrationOptions& options);

/// Throws InputError where nothing of the table can be fitted, or the budget is too small for any search: at
/// once, and before anything is begun.
void check_budget(const Evidence& evidence, const CalibrationOptions& options);

}  // namespace phy::calibrate
