#include "base/units.hpp"

#include <charconv>
#include <cmath>

namespace phy {
namespace {

struct Unit {
  Dimension dimension;
  const char* name;
  double times;  ///< value in SI = number * times / over; one of the two is 1
  double over;
};

// In the order in which a value is tried for printing.
constexpr Unit units[] = {
    {Dimension::length, "mm", 1.0, 1e3},       {Dimension::length, "cm", 1.0, 1e2},
    {Dimension::length, "um", 1.0, 1e6},       {Dimension::length, "m", 1.0, 1.0},
    {Dimension::pressure, "GPa", 1e9, 1.0},    {Dimension::pressure, "MPa", 1e6, 1.0},
    {Dimension::pressure, "kPa", 1e3, 1.0},    {Dimension::pressure, "Pa", 1.0, 1.0},
    {Dimension::stiffness, "GPa/m", 1e9, 1.0}, {Dimension::stiffness, "MPa/mm", 1e9, 1.0},
    {Dimension::stiffness, "MPa/m", 1e6, 1.0}, {Dimension::stiffness, "Pa/m", 1.0, 1.0},
    {Dimension::angle, "deg", 1.0, 1.0},       {Dimension::speed, "m/s", 1.0, 1.0},
    {Dimension::speed, "mm/s", 1.0, 1e3},      {Dimension::density, "kg/m^3", 1.0, 1.0},
    {Dimension::density, "kg/m3", 1.0, 1.0},   {Dimension::density, "g/cm^3", 1e3, 1.0},
};

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t')) s.remove_suffix(1);
  return s;
}

bool friendly(double number) { return std::fabs(number) >= 0.1 && std::fabs(number) < 1e5; }

}  // namespace

std::string print_number(double value) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

std::string unit_names(Dimension dimension) {
  std::string names;
  for (const Unit& u : units)
    if (u.dimension == dimension) names += (names.empty() ? "" : ", ") + std::string(u.name);
  return names;
}

Quantity parse_quantity(std::string_view text, Dimension dimension) {
  const std::string_view s = trimmed(text);
  double number = 0.0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), number);
  if (error != std::errc() || !std::isfinite(number)) return {false, 0.0, "does not start with a number"};
  const std::string_view unit = trimmed(s.substr(static_cast<std::size_t>(end - s.data())));
  if (unit.empty())
    return {false, 0.0,
            "has no unit; write for example \"" + print_number(number) + " " +
                unit_names(dimension).substr(0, unit_names(dimension).find(',')) + "\""};
  for (const Unit& u : units)
    if (u.dimension == dimension && unit == u.name) return {true, number * u.times / u.over, ""};
  return {false, 0.0,
          "has the wrong unit \"" + std::string(unit) + "\"; known here: " + unit_names(dimension)};
}

std::string print_quantity(double value, Dimension dimension) {
  if (dimension == Dimension::none) return print_number(value);
  std::string fallback;
  for (const bool only_friendly : {true, false}) {
    for (const Unit& u : units) {
      if (u.dimension != dimension) continue;
      const double number = value * u.over / u.times;
      if (only_friendly && number != 0.0 && !friendly(number)) continue;
      const std::string text = print_number(number) + " " + u.name;
      if (parse_quantity(text, dimension).value == value && text.size() < 24) return text;
      fallback = text;
    }
  }
  return fallback;  // the last unit is SI, or exact by construction
}

}  // namespace phy
