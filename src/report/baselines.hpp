// Errors of a calibration beside what much simpler rules would have missed the same cells by.
//
// Of a value of the table that is left out, three rules tell something from the others of its property and
// disc alone: a straight line in theta between the two neighbours, a parabola in theta (least squares over
// all others), and for UCS a plane of weakness in rock of one strength (theory/jaeger_fit.hpp, both fitted to
// the others). A model that predicts no better than these has not earned its cost.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "records/calibration.hpp"

namespace phy::report {

struct Baseline {
  const char* key;   ///< in calibration.json
  const char* name;  ///< for people
  /// The value of a cell by the others; NaN: the rule says nothing of it.
  double (*predict)(const std::vector<Comparison>& rows, const Target& cell);
};
const std::vector<Baseline>& baselines();

/// Root mean square errors per property, relative, of nu absolute; NaN: none.
struct ErrorRow {
  std::string of;
  std::array<double, n_properties> rms;
  bool is_left_out = false;
  std::string baseline = {};  ///< its key, of a row that is not the model's
};
/// Fitted, unseen packings, left out, and the baselines of what is left out. The last four over cells with
/// neighbours on both sides, which all of them can predict; E and nu are left out by the baselines alone.
std::vector<ErrorRow> error_rows(const Calibration& calibration);

}  // namespace phy::report
