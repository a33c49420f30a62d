// Quantities as people write them: "38 mm", "3360 GPa/m", "35 deg". Inside the program everything is SI and
// degrees. One list of units serves recipes, tables of laboratories, curves, the page and Python.
//
// The units of SI are powers of ten of each other. Reading and printing them only move the decimal point of
// the text and leave the one rounding to std::from_chars and std::to_chars, which are exact and the same in
// every locale: "0.007 mm" is the double nearest to 7e-6 m, and every double prints to a text that reads back
// to the same bits. Rejected: multiplying by a factor; it rounds twice and misses the nearest double for one
// text in four. Only units that are no power of ten (psi, inch, radian) are multiplied; none is printed.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace phy {

enum class Dimension { none, length, pressure, stiffness, angle, speed, density, toughness, strain };

/// A unit that somebody wrote: "N/mm²" is "MPa", "×10⁴ MPa" is "10^4 MPa".
struct UnitName {
  Dimension dimension = Dimension::none;
  std::string name;  ///< ours; parse_quantity reads it
};
/// The unit that a text means, in any of its spellings: case, blanks, dots, superscripts and the signs of
/// powers do not matter, "x10^4" in front multiplies. Nothing: it is none of the list.
std::optional<UnitName> find_unit(std::string_view text);

/// A row of the list, for documents: our name, what else is read, what one of it is.
struct UnitRow {
  Dimension dimension;
  std::string name, spellings, size;
};
const std::vector<UnitRow>& unit_rows();
/// "pressure" and so on, for documents and messages.
std::string to_string(Dimension dimension);

struct Quantity {
  bool ok = false;
  double value = 0.0;   ///< SI or degrees
  std::string problem;  ///< what is wrong, as the end of a sentence; empty when ok
};

/// Reads a number with a unit of the dimension, in any spelling of find_unit. A bare number is refused,
/// naming the unit that it should probably have: that of a `usual` value, where one is given, or a likelier
/// one where that is far off.
Quantity parse_quantity(std::string_view text, Dimension dimension, double usual = 0.0);
/// Writes a value with the friendliest unit; reads back to the same bits (finite values).
std::string print_quantity(double value, Dimension dimension);
/// "mm, m, um, cm, km, in, ft"; empty for Dimension::none.
std::string unit_names(Dimension dimension);
/// The unit of the values inside the program: "m", "Pa", "Pa/m", "deg", "m/s", "kg/m^3", "Pa sqrt(m)",
/// and "1" for strain and none.
std::string inner_unit(Dimension dimension);
/// To so many decimal digits.
double rounded(double value, int digits);
/// Shortest text that reads back to the same bits ("nan" and "inf" for what is not finite).
std::string print_number(double value);

}  // namespace phy
