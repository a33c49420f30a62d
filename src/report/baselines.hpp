// Errors of a calibration beside what much simpler rules would have missed the same cells by.
//
// Of a value of the table that is left out, curves tell something from the others of its test alone. One list
// registers them. A model that predicts no better than the best of them has not earned its cost between the
// angles of a table. They are compared over cells with neighbours on both sides, and a curve that cannot
// predict all of these (for want of angles) is not compared.
#pragma once
#include <array>
#include <span>
#include <string>
#include <vector>

#include "records/calibration.hpp"

namespace phy::report {

struct Baseline {
  const char* key;     ///< in calibration.json
  const char* name;    ///< for people
  std::size_t fewest;  ///< other angles that it needs
  /// The value of a cell by these others; NaN: the curve says nothing of it.
  double (*curve)(std::span<const Target* const> others, const Target& cell);
  double predict(const std::vector<Comparison>& rows, const Target& cell) const;
};
const std::vector<Baseline>& baselines();

/// Root mean square errors per property, relative, of nu absolute; NaN: none.
struct ErrorRow {
  std::string of;
  std::array<double, n_properties> rms;
  bool is_left_out = false;
  std::string baseline = {};  ///< its key, of a row that is not the model's
};
/// Fitted, unseen packings, left out by the model alone and with its discrepancy, and every curve; E and nu
/// are left out by the curves alone.
std::vector<ErrorRow> error_rows(const Calibration& calibration);

/// Who predicts the values of a property best that were left out.
struct LeftOutErrors {
  Property property = Property::E;
  double model = nan;              ///< alone
  double with_discrepancy = nan;   ///< NaN: the file is of a version without
  const Baseline* best = nullptr;  ///< of the curves; nullptr: none could be fitted
  double curve = nan;              ///< its error
  int cells = 0;
};
/// Of every property that the model has predicted unseen.
std::vector<LeftOutErrors> left_out_errors(const Calibration& calibration);
/// "Left out one at a time, UCS is predicted within 7.1 % (root mean square). The best curve, ..., has 9.8
/// %."
std::string sentence(const LeftOutErrors& errors);

}  // namespace phy::report
