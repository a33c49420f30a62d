#include "base/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "base/trimmed.hpp"

namespace phy {
namespace {

struct Unit {
  Dimension dimension;
  const char* name;
  int power;     ///< 1 unit = 10^power in SI
  double least;  ///< from this number on the unit is used for printing, up to 1e4; 0: read only
};

// In the order in which a value is tried for printing; the first unit of a dimension takes what fits nowhere.
constexpr Unit units[] = {
    {Dimension::length, "mm", -3, 0.1},
    {Dimension::length, "m", 0, 1.0},
    {Dimension::length, "um", -6, 0.1},
    {Dimension::length, "cm", -2, 0.0},
    {Dimension::pressure, "GPa", 9, 1.0},
    {Dimension::pressure, "MPa", 6, 0.1},
    {Dimension::pressure, "kPa", 3, 0.1},
    {Dimension::pressure, "Pa", 0, 0.1},
    {Dimension::stiffness, "GPa/m", 9, 1.0},
    {Dimension::stiffness, "MPa/m", 6, 1.0},
    {Dimension::stiffness, "Pa/m", 0, 0.1},
    {Dimension::stiffness, "MPa/mm", 9, 0.0},
    {Dimension::angle, "deg", 0, 0.0},
    {Dimension::speed, "m/s", 0, 0.001},
    {Dimension::speed, "mm/s", -3, 0.0},
    {Dimension::density, "kg/m^3", 0, 0.0},
    {Dimension::density, "kg/m3", 0, 0.0},
    {Dimension::density, "g/cm^3", 3, 0.0},
    {Dimension::toughness, "MPa sqrt(m)", 6, 0.1},
    {Dimension::toughness, "kPa sqrt(m)", 3, 0.1},
    {Dimension::toughness, "Pa sqrt(m)", 0, 0.1},
};

constexpr const char* beyond = "is larger or smaller than a number can be";

bool same_but_for_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

/// A decimal number with its point moved: 10^power times what the text says, rounded once. False where it is
/// beyond all numbers; an exponent of more digits than these is not read at all.
bool read_shifted(std::string_view number, int power, double& value) {
  const std::size_t e = number.find_first_of("eE");
  std::int64_t exponent = 0;
  if (e != number.npos) {
    std::string_view digits = number.substr(e + 1);
    if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
    constexpr std::int64_t most = 1000000;
    if (std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec != std::errc() ||
        exponent > most || exponent < -most)
      return false;
  }
  const std::string text = std::string(number.substr(0, e)) + "e" + std::to_string(exponent + power);
  return std::from_chars(text.data(), text.data() + text.size(), value).ec == std::errc();
}

/// 0.digits[0]digits[1]... times 10^exponent, without an exponent where that is short.
std::string decimal(const std::string& digits, int exponent) {
  const int n = static_cast<int>(digits.size());
  if (exponent > 0 && exponent <= 9)
    return exponent >= n ? digits + std::string(static_cast<std::size_t>(exponent - n), '0')
                         : digits.substr(0, static_cast<std::size_t>(exponent)) + "." +
                               digits.substr(static_cast<std::size_t>(exponent));
  if (exponent <= 0 && exponent > -5)
    return "0." + std::string(static_cast<std::size_t>(-exponent), '0') + digits;
  return digits.substr(0, 1) + (n > 1 ? "." + digits.substr(1) : "") + "e" + std::to_string(exponent - 1);
}

/// The shortest digits of a value, with the point moved by -power.
std::string print_shifted(double value, int power) {
  if (value == 0.0) return std::signbit(value) ? "-0" : "0";
  char buffer[64];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, std::fabs(value), std::chars_format::scientific).ptr;
  const std::string_view text(buffer, static_cast<std::size_t>(end - buffer));
  const std::size_t e = text.find('e');
  std::string digits;
  for (const char c : text.substr(0, e))
    if (c != '.') digits += c;
  int exponent = 0;
  const std::size_t sign = text[e + 1] == '+' ? 2 : 1;
  std::from_chars(text.data() + e + sign, end, exponent);
  return (std::signbit(value) ? "-" : "") + decimal(digits, exponent + 1 - power);
}

/// The unit that a value is written in; of a pressure without a value MPa: only moduli are larger.
std::string unit_of(double usual, Dimension dimension) {
  const bool unknown_stress = dimension == Dimension::pressure && usual == 0.0;
  const std::string text = print_quantity(unknown_stress ? 1e6 : usual, dimension);
  return text.substr(text.find(' ') + 1);
}

/// The unit that a bare number was probably meant in: that of the usual value, or, where it would be far from
/// that, the one that brings it nearest.
std::string likely_unit(double number, double usual, Dimension dimension) {
  constexpr double far = 2.0;  // orders of magnitude
  const std::string plain = unit_of(usual, dimension);
  if (number == 0.0 || usual == 0.0) return plain;
  const auto farness = [&](const Unit& u) {
    return std::fabs(std::log10(std::fabs(number / usual)) + u.power);
  };
  const Unit* nearest = nullptr;
  for (const Unit& u : units) {
    if (u.dimension != dimension) continue;
    if (u.name == plain && farness(u) <= far) return plain;
    if (nearest == nullptr || farness(u) < farness(*nearest)) nearest = &u;
  }
  return nearest->name;
}

/// "-0" is 0: an angle has one name.
double unsigned_zero(double value) { return value == 0.0 ? 0.0 : value; }

/// What is wrong with a unit that was not found, with the likeliest cause first.
std::string unit_problem(std::string_view unit, Dimension dimension) {
  std::string text = "has the wrong unit \"" + std::string(unit) + "\"; ";
  for (const Unit& u : units)
    if (u.dimension == dimension && same_but_for_case(unit, u.name))
      text += "did you mean \"" + std::string(u.name) + "\"? ";
  return text + "known here: " + unit_names(dimension);
}

}  // namespace

std::string print_number(double value) {
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

double rounded(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  double nearest = value;  // what is no number stays
  std::from_chars(text.data(), text.data() + text.size(), nearest);
  return nearest;
}

std::string unit_names(Dimension dimension) {
  std::string names;
  for (const Unit& u : units)
    if (u.dimension == dimension) names += (names.empty() ? "" : ", ") + std::string(u.name);
  return names;
}

std::string inner_unit(Dimension dimension) {
  for (const Unit& u : units)
    if (u.dimension == dimension && u.power == 0) return u.name;
  return "1";
}

Quantity parse_quantity(std::string_view text, Dimension dimension, double usual) {
  std::string_view s = trimmed(text, " \t");
  if (s.size() > 1 && s.front() == '+' && s[1] != '-') s.remove_prefix(1);
  double number = 0.0;
  const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), number);
  if (error == std::errc::invalid_argument || !std::isfinite(number))
    return {false, 0.0, "does not start with a number"};
  const auto length = static_cast<std::size_t>(end - s.data());
  const std::string_view unit = trimmed(s.substr(length), " \t");
  if (dimension == Dimension::none)
    return unit.empty()
               ? Quantity{error == std::errc(), unsigned_zero(number), error == std::errc() ? "" : beyond}
               : Quantity{false, 0.0, "has a unit, \"" + std::string(unit) + "\"; write a bare number"};
  if (unit.empty())
    return {false, 0.0,
            "has no unit; write for example \"" + std::string(s.substr(0, length)) + " " +
                likely_unit(number, usual, dimension) + "\""};
  for (const Unit& u : units) {
    if (u.dimension != dimension || unit != u.name) continue;
    double value = 0.0;
    if (!read_shifted(s.substr(0, length), u.power, value)) return {false, 0.0, beyond};
    return {true, unsigned_zero(value), ""};
  }
  return {false, 0.0, unit_problem(unit, dimension)};
}

std::string print_quantity(double value, Dimension dimension) {
  if (dimension == Dimension::none || !std::isfinite(value)) return print_number(value);
  const Unit* chosen = nullptr;
  for (const Unit& u : units) {
    if (u.dimension != dimension) continue;
    if (chosen == nullptr) chosen = &u;
    const double number = std::fabs(value) / std::pow(10.0, u.power);  // only to choose; the text is exact
    if (u.least == 0.0 || number < u.least || number >= 1e4) continue;
    chosen = &u;
    break;
  }
  return print_shifted(value, chosen->power) + " " + chosen->name;
}

}  // namespace phy
