// Quantities as people write them: "38 mm", "3360 GPa/m", "35 deg". Inside the program everything is SI and
// degrees.
//
// Every unit is a power of ten of the SI unit. Reading and printing therefore only move the decimal point of
// the text and leave the one rounding to std::from_chars and std::to_chars, which are exact and the same in
// every locale: "0.007 mm" is the double nearest to 7e-6 m, and every double prints to a text that reads back
// to the same bits. Rejected: multiplying by a factor; it rounds twice and misses the nearest double for one
// text in four.
#pragma once
#include <string>
#include <string_view>

namespace phy {

enum class Dimension { none, length, pressure, stiffness, angle, speed, density, toughness };

struct Quantity {
  bool ok = false;
  double value = 0.0;   ///< SI or degrees
  std::string problem;  ///< what is wrong, as the end of a sentence; empty when ok
};

/// Reads a number with a unit of the dimension. A bare number is refused, naming the unit that it should
/// probably have: that of a `usual` value, where one is given, or a likelier one where that is far off.
Quantity parse_quantity(std::string_view text, Dimension dimension, double usual = 0.0);
/// Writes a value with the friendliest unit; reads back to the same bits (finite values).
std::string print_quantity(double value, Dimension dimension);
/// "mm, m, cm, um"; empty for Dimension::none.
std::string unit_names(Dimension dimension);
/// The unit of the values inside the program: "m", "Pa", "Pa/m", "deg", "m/s", "kg/m^3", "Pa sqrt(m)",
/// and "1" for none.
std::string inner_unit(Dimension dimension);
/// To so many decimal digits.
double rounded(double value, int digits);
/// Shortest text that reads back to the same bits ("nan" and "inf" for what is not finite).
std::string print_number(double value);

}  // namespace phy
