// Quantities as people write them: "38 mm", "3360 GPa/m", "35 deg". Inside the program everything is SI and
// degrees. A unit is an exact ratio of decimal powers, so "38 mm" is the double nearest to 0.038 and prints
// back as "38 mm".
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace phy {

enum class Dimension { none, length, pressure, stiffness, angle, speed, density };

struct Quantity {
  bool ok = false;
  double value = 0.0;   ///< SI or degrees
  std::string problem;  ///< what is wrong, empty when ok
};

/// Reads a number with a unit of the dimension. A bare number is refused, naming the units that would do.
Quantity parse_quantity(std::string_view text, Dimension dimension);
/// Writes a value with the friendliest unit that reads back to the same bits.
std::string print_quantity(double value, Dimension dimension);
/// "mm, cm, m, um"
std::string unit_names(Dimension dimension);
/// Shortest text that reads back to the same bits.
std::string print_number(double value);

}  // namespace phy
