#include "base/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <utility>

#include "base/trimmed.hpp"

namespace phy {
namespace {

constexpr double foreign = -1.0;
constexpr double degrees_of_radian = 57.295779513082320877;  // 180/pi

struct Unit {
  Dimension dimension;
  const char* name;
  int power;     ///< 1 unit = factor 10^power in SI
  double least;  ///< printed from this number on, up to 1e4; 0: read, and proposed; foreign: read only
  const char* spellings;  ///< others that are read, separated by ", "
  double factor = 1.0;
};

// In the order in which a value is tried for printing; the first unit of a dimension takes what fits nowhere.
// Pound and inch by international definition (0.45359237 kg, 25.4 mm), g = 9.80665 m/s^2.
constexpr Unit units[] = {
    {Dimension::length, "mm", -3, 0.1, "мм"},
    {Dimension::length, "m", 0, 1.0, "м"},
    {Dimension::length, "um", -6, 0.1, "µm, micron, microns, мкм"},
    {Dimension::length, "cm", -2, 0.0, "см"},
    {Dimension::length, "km", 3, foreign, "км"},
    {Dimension::length, "in", -4, foreign, "inch, inches, \"", 254.0},
    {Dimension::length, "ft", -4, foreign, "foot, feet", 3048.0},
    {Dimension::pressure, "GPa", 9, 1.0, "kN/mm2, GN/m2, ГПа"},
    {Dimension::pressure, "MPa", 6, 0.1, "N/mm2, MN/m2, megapascal, N mm^-2, MN m^-2, МПа, Н/мм2, МН/м2"},
    {Dimension::pressure, "kPa", 3, 0.1, "kN/m2, kN m^-2, кПа"},
    {Dimension::pressure, "Pa", 0, 0.1, "N/m2, N m^-2, Па"},
    {Dimension::pressure, "kN/cm2", 7, foreign, "kN cm^-2"},
    {Dimension::pressure, "hPa", 2, foreign, "mbar"},
    {Dimension::pressure, "psi", 0, foreign, "lb/in2, lbf/in2, lbs/in2, lb/sq in", 6894.757293168361},
    {Dimension::pressure, "ksi", 3, foreign, "kpsi, kip/in2", 6894.757293168361},
    {Dimension::pressure, "Mpsi", 6, foreign, "msi", 6894.757293168361},
    {Dimension::pressure, "bar", 5, foreign, "bars, daN/cm2, бар"},
    {Dimension::pressure, "kbar", 8, foreign, "кбар"},
    {Dimension::pressure, "atm", 0, foreign, "", 101325.0},
    {Dimension::pressure, "kgf/cm2", 0, foreign, "kg/cm2, kg/sq cm, kp/cm2, kgf cm^-2, кгс/см2, кг/см2",
     98066.5},
    {Dimension::pressure, "kgf/mm2", 2, foreign, "kg/mm2, kp/mm2, kgf mm^-2, кгс/мм2, кг/мм2", 98066.5},
    {Dimension::pressure, "tf/m2", 0, foreign, "t/m2, тс/м2", 9806.65},
    {Dimension::stiffness, "GPa/m", 9, 1.0, "GN/m3"},
    {Dimension::stiffness, "MPa/m", 6, 1.0, "MN/m3"},
    {Dimension::stiffness, "Pa/m", 0, 0.1, "N/m3, N m^-3"},
    {Dimension::stiffness, "MPa/mm", 9, 0.0, "N/mm3"},
    {Dimension::stiffness, "kPa/m", 3, foreign, "kN/m3"},
    {Dimension::stiffness, "GPa/mm", 12, foreign, "kN/mm3"},
    {Dimension::stiffness, "psi/in", 4, foreign, "lb/in3, lbf/in3", 6894.757293168361 / 254.0},
    {Dimension::angle, "deg", 0, 0.0, "°, º, ˚, degree, degrees, град, градус"},
    {Dimension::angle, "rad", 0, foreign, "radian, radians, рад", degrees_of_radian},
    {Dimension::speed, "m/s", 0, 0.001, "m s^-1, м/с"},
    {Dimension::speed, "mm/s", -3, 0.0, "mm s^-1, мм/с"},
    {Dimension::speed, "cm/s", -2, foreign, "cm s^-1"},
    {Dimension::speed, "um/s", -6, foreign, "µm/s"},
    {Dimension::speed, "mm/min", 0, foreign, "mm min^-1, мм/мин", 1e-3 / 60.0},
    {Dimension::density, "kg/m^3", 0, 0.0, "kg m^-3, кг/м3"},
    {Dimension::density, "g/cm^3", 3, 0.0, "g/cc, g cm^-3, t/m3, Mg/m3, г/см3, т/м3"},
    {Dimension::density, "pcf", 0, foreign, "lb/ft3, lbf/ft3, lbs/ft3", 16.018463373960142},
    {Dimension::toughness, "MPa sqrt(m)", 6, 0.1,
     "MPa√m, MPa m^0.5, MPa m^1/2, MPa root m, MN/m^1.5, MN/m^3/2, MN m^-1.5, MN m^-3/2, МПа√м, МПа м^0.5"},
    {Dimension::toughness, "kPa sqrt(m)", 3, 0.1,
     "kPa√m, kPa m^0.5, kPa m^1/2, kPa root m, kN/m^1.5, kN/m^3/2, kN m^-1.5, kN m^-3/2"},
    {Dimension::toughness, "Pa sqrt(m)", 0, 0.1,
     "Pa√m, Pa m^0.5, Pa m^1/2, Pa root m, N/m^1.5, N/m^3/2, N m^-1.5, N m^-3/2"},
    {Dimension::strain, "1", 0, foreign, "-, mm/mm, m/m, in/in"},
    {Dimension::strain, "%", -2, foreign, "percent"},
    {Dimension::strain, "permille", -3, foreign, "‰, mm/m, millistrain"},
    {Dimension::strain, "microstrain", -6, foreign, "µε, µm/m, ue"},
};

/// Signs that mean the same: powers, products, roots, Greek and full-width letters.
constexpr std::pair<const char*, const char*> same_signs[] = {
    {"⁰", "^0"},
    {"¹", "^1"},
    {"²", "^2"},
    {"³", "^3"},
    {"⁴", "^4"},
    {"⁵", "^5"},
    {"⁶", "^6"},
    {"⁷", "^7"},
    {"⁸", "^8"},
    {"⁹", "^9"},
    {"⁻", "^-"},
    {"−", "-"},
    {"–", "-"},
    {"—", "-"},
    {"·", "*"},
    {"⋅", "*"},
    {"•", "*"},
    {"×", "x"},
    {"✕", "x"},
    {"√", "sqrt"},
    {"½", "1/2"},
    {"µ", "u"},
    {"μ", "u"},
    {"／", "/"},
    {"％", "%"},
    {"″", "\""},
    {"”", "\""},
    {"㎜", "mm"},
    {"㎝", "cm"},
    {"㎫", "MPa"},
    {"㎬", "GPa"},
    {"㎪", "kPa"},
    {"㎩", "Pa"},
    {"㎏", "kg"},
    {"\xC2\xA0", " "},
    {"\xE2\x80\x89", " "},
    {"\xE2\x80\xAF", " "},
    {"\xE3\x80\x80", " "},
    {"ɛ", "ε"},
};

/// A unit with one sign for one thing, and one "^" before a power.
std::string with_same_signs(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    // Bytes and not characters: what is in no pair goes through byte by byte.
    if (static_cast<unsigned char>(text.front()) < 0x80) {  // none of the list
      out += text.front(), text.remove_prefix(1);
      continue;
    }
    const auto sign = std::find_if(std::begin(same_signs), std::end(same_signs),
                                   [&](const auto& s) { return text.starts_with(s.first); });
    // A byte of a character that has no other sign.
    if (sign == std::end(same_signs)) {
      out += text.front(), text.remove_prefix(1);
      continue;
    }
    // "10⁻⁶" is one power of three signs.
    std::string_view same = sign->second;
    const std::size_t power = out.find_last_not_of("-0123456789");
    if (same.size() > 1 && same.front() == '^' && power != out.npos && out[power] == '^')
      same.remove_prefix(1);
    out += same;
    text.remove_prefix(std::string_view(sign->first).size());
  }
  return out;
}

/// A unit as spellings are compared: without blanks, signs of powers and products, brackets. Lower case, but
/// for a single letter: "M" is no metre.
std::string spelling(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (std::string_view(" \t_*.^(){}").find(c) == std::string_view::npos) out += c;
  if (out.size() > 1)
    for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

/// Every unit by its name and spellings, as spelling() has them.
const std::map<std::string, const Unit*, std::less<>>& units_by_spelling() {
  static const std::map<std::string, const Unit*, std::less<>> all = [] {
    std::map<std::string, const Unit*, std::less<>> made;
    for (const Unit& u : units) {
      std::string_view rest = u.spellings;
      for (std::string_view word = u.name; !word.empty();) {
        made.emplace(spelling(with_same_signs(word)), &u);
        const std::size_t end = std::min(rest.find(", "), rest.size());
        word = rest.substr(0, end), rest.remove_prefix(std::min(end + 2, rest.size()));
      }
    }
    return made;
  }();
  return all;
}

/// Takes "x10^4", "10^5", "x 10" or "1e4" from the front. Without a sign of product or power it is no factor.
int take_power(std::string_view& text) {
  std::string_view s = trimmed(text, " \t");
  const bool times = s.starts_with('x') || s.starts_with('X') || s.starts_with('*');
  if (times) s = trimmed(s.substr(1), " \t");
  int power = 1;
  const bool exponential = s.starts_with("1e") || s.starts_with("1E");
  if (!exponential && !s.starts_with("10")) return 0;
  s.remove_prefix(2);
  if (exponential || s.starts_with('^') || s.starts_with("**")) {
    while (!exponential && (s.starts_with('^') || s.starts_with('*'))) s.remove_prefix(1);
    if (s.starts_with('+')) s.remove_prefix(1);
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), power);
    // Larger powers are no units, but numbers of specimens and the like.
    if (error != std::errc() || std::abs(power) > 12) return 0;
    s.remove_prefix(static_cast<std::size_t>(end - s.data()));
  } else if (!times) {
    return 0;
  }
  text = s;
  return power;
}

struct ScaledUnit {
  const Unit* unit = nullptr;
  int power = 0;  // of the unit and of what stands in front of it
};

std::optional<ScaledUnit> scaled_unit(std::string_view text) {
  const std::string same = with_same_signs(text);
  std::string_view rest = same;
  int power = take_power(rest);
  // "psi x 10^6": the factor may stand behind, too.
  if (const std::size_t times = rest.find_last_of("xX*"); power == 0 && times != rest.npos && times > 0) {
    std::string_view behind = rest.substr(times);
    // Only a power stands behind, and nothing after it.
    if (power = take_power(behind); power != 0 && trimmed(behind).empty())
      rest = rest.substr(0, times);
    else
      power = 0;
  }
  const std::string spelled = power != 0 && trimmed(rest).empty() ? "1" : spelling(rest);
  const auto found = units_by_spelling().find(spelled);
  if (found == units_by_spelling().end()) return {};
  return ScaledUnit{found->second, found->second->power + power};
}

constexpr const char* beyond = "is larger or smaller than a number can be";

/// A decimal number with its point moved: 10^power times what the text says, rounded once. False where it is
/// beyond all numbers; an exponent of more digits than these is not read at all.
bool read_shifted(std::string_view number, int power, double& value) {
  const std::size_t e = number.find_first_of("eE");
  std::int64_t exponent = 0;
  // Moved in the text: "30.1 GPa" is 30.1e9 rounded once, where 30.1 * 1e9 would be rounded twice.
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
      // The shortest digits that read back as this number.
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
  // Zero has no unit that suits it.
  const bool unknown_stress = dimension == Dimension::pressure && usual == 0.0;
  const std::string text = print_quantity(unknown_stress ? 1e6 : usual, dimension);
  return text.substr(text.find(' ') + 1);
}

/// The unit that a bare number was probably meant in: that of the usual value, or, where it would be far from
/// that, the one that brings it nearest.
std::string likely_unit(double number, double usual, Dimension dimension) {
  constexpr double far = 2.0;  // orders of magnitude
  const std::string plain = unit_of(usual, dimension);
  // Zero has no order of magnitude.
  if (number == 0.0 || usual == 0.0) return plain;
  const auto farness = [&](const Unit& u) {
    return std::fabs(std::log10(std::fabs(number / usual)) + u.power);
  };
  const Unit* nearest = nullptr;
  for (const Unit& u : units) {
    // Foreign units are read and never proposed.
    if (u.dimension != dimension || u.least < 0.0) continue;
    if (u.name == plain && farness(u) <= far) return plain;
    if (nearest == nullptr || farness(u) < farness(*nearest)) nearest = &u;
  }
  return nearest->name;
}

/// "-0" is 0: an angle has one name.
double unsigned_zero(double value) { return value == 0.0 ? 0.0 : value; }

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

std::optional<UnitName> find_unit(std::string_view text) {
  const auto found = scaled_unit(text);
  if (!found) return {};
  const int times = found->power - found->unit->power;
  const std::string power = times == 0 ? "" : "10^" + std::to_string(times) + " ";
  return UnitName{found->unit->dimension, power + found->unit->name};
}

const std::vector<UnitRow>& unit_rows() {
  static const std::vector<UnitRow> rows = [] {
    std::vector<UnitRow> all;
    for (const Unit& u : units) {
      // Powers of ten are shown as such.
      const std::string size = u.factor == 1.0 ? fmt::format("1e{}", u.power)
                                               : fmt::format("{:.10g}", u.factor * std::pow(10.0, u.power));
      all.push_back(
          {u.dimension, u.name, u.spellings, (size == "1e0" ? "1" : size) + " " + inner_unit(u.dimension)});
    }
    return all;
  }();
  return rows;
}

std::string to_string(Dimension dimension) {
  switch (dimension) {
    case Dimension::none: return "number";
    case Dimension::length: return "length";
    case Dimension::pressure: return "stress";
    case Dimension::stiffness: return "stiffness";
    case Dimension::angle: return "angle";
    case Dimension::speed: return "speed";
    case Dimension::density: return "density";
    case Dimension::toughness: return "fracture toughness";
    case Dimension::strain: return "strain";
  }
  return "";
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
  const auto known = scaled_unit(unit);
  if (!known || known->unit->dimension != dimension)
    return {false, 0.0,
            "has the wrong unit \"" + std::string(unit) + "\"; known here: " + unit_names(dimension)};
  // A factor goes to the number before its point is moved: 3 in are 762e-4 m.
  const double factor = known->unit->factor;
  const std::string shown = factor == 1.0 ? std::string(s.substr(0, length)) : print_number(number * factor);
  double value = 0.0;
  if (!std::isfinite(number * factor) || !read_shifted(shown, known->power, value))
    return {false, 0.0, beyond};
  return {true, unsigned_zero(value), ""};
}

std::string print_quantity(double value, Dimension dimension) {
  if (dimension == Dimension::none || !std::isfinite(value)) return print_number(value);
  const Unit* chosen = nullptr;
  for (const Unit& u : units) {
    if (u.dimension != dimension) continue;
    if (chosen == nullptr) chosen = &u;
    const double number = std::fabs(value) / std::pow(10.0, u.power);  // only to choose; the text is exact
    if (u.least <= 0.0 || number < u.least || number >= 1e4) continue;
    chosen = &u;
    break;
  }
  return print_shifted(value, chosen->power) + " " + chosen->name;
}

}  // namespace phy
