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

struct Yardstick {
  const char* key;   ///< in calibration.json
  const char* name;  ///< for people
  /// The value of a cell by the others; NaN: the rule says nothing of it.
  double (*predict)(const std::vector<Comparison>& rows, const Target& cell);
};
const std::vector<Yardstick>& yardsticks();

/// Root mean square errors per property, relative, of nu absolute; NaN: none.
struct ErrorRow {
  std::string of;
  std::array<double, n_properties> rms;
};
/// Fitted, unseen packings, left out, and the yardsticks of what is left out. The last four over cells with
/// neighbours on both sides, which all of them can tell; E and nu are left out by the yardsticks alone.
std::vector<ErrorRow> error_rows(const Calibration& calibration);

/// "4.1 %", of nu "0.042"; "-" for none.
std::string error_text(Property property, double rms);

}  // namespace phy::report
