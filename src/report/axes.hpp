// What the curve of a test is, per kind of test: which columns, in which direction and unit, and which number
// is its strength. The one list for page, figures and films.
#pragma once
#include <optional>
#include <string>

#include "records/result.hpp"
#include "records/rock.hpp"

namespace phy {

struct TestAxes {
  std::string strain, strain_unit;       ///< "axial strain", "%"
  double strain_factor = 100.0;          ///< from the recorded value to `strain_unit`
  std::string stress;                    ///< "axial stress", drawn in MPa
  std::string strength, strength_label;  ///< number of the result, "ucs", and its name, "UCS"
  std::optional<Property> property;      ///< of the laboratory that it stands beside
  double sign = 1.0;                     ///< -1: recorded as negative, as tension is
  double HistoryRow::*value = &HistoryRow::axial_stress;

  /// Grow while the test loads. [1] (direct shear: m), [Pa]
  double strain_of(const HistoryRow& row) const { return sign * row.axial_strain; }
  double stress_of(const HistoryRow& row) const { return sign * (row.*value); }
};

TestAxes test_axes(TestKind kind);

}  // namespace phy
