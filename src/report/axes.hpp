// What the curve of a test is, per kind of test: which columns, in which direction and unit, and which number
// is its strength. The one list for page, figures, films and the terminal.
#pragma once
#include <string>

#include "records/result.hpp"
#include "records/rock.hpp"

namespace phy {

struct TestAxes {
  std::string strain, strain_unit;      ///< "axial strain", "%"
  double strain_factor = 100.0;         ///< from the recorded value to `strain_unit`
  std::string stress;                   ///< "axial stress", in MPa
  double HistoryRow::*value = nullptr;  ///< the stress
  double sign = 1.0;                    ///< -1: recorded as negative, as tension is
  std::string strength;                 ///< number of the result: "ucs"
  std::string strength_label;           ///< "UCS"
  Property property = Property::ucs;    ///< of the laboratory that it stands beside

  /// Grow while the test loads. [1] (direct shear: m), [Pa]
  double strain_of(const HistoryRow& row) const { return sign * row.axial_strain; }
  double stress_of(const HistoryRow& row) const { return sign * (row.*value); }
};

TestAxes test_axes(TestKind kind);

}  // namespace phy
