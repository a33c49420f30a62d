// Colours of figures and films: of series by their role, of cracks by mode and place, of bedding. Those of
// curves on paper differ in lightness, so that they hold for colour-blind readers and in grey; figures add
// symbols, dashes and words.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "records/result.hpp"
#include "report/figure.hpp"

namespace phy::report {

using Color = std::uint32_t;  ///< 0xRRGGBB

inline std::string hex_color(Color c) { return fmt::format("#{:06x}", c); }

/// Numbered by crack_kind(). Shear is darker than tension, in grey too; the discs below show the place.
constexpr std::array<Color, 4> crack_colors = {0xd1400b, 0x5b1670, 0x0a66c2, 0x004d33};
constexpr std::array<const char*, 4> crack_names = {"matrix, tension", "matrix, shear", "bedding, tension",
                                                    "bedding, shear"};
/// Among the numbers of a result.
constexpr std::array<const char*, 4> crack_numbers = {"cracks_tension_matrix", "cracks_shear_matrix",
                                                      "cracks_tension_bedding", "cracks_shear_bedding"};
inline std::size_t crack_kind(const CrackEvent& c) {
  return (c.mode == CrackMode::shear ? 1U : 0U) + (c.place == CrackPlace::bedding ? 2U : 0U);
}

/// Discs between two bedding planes, between the next two, and discs with a joint.
constexpr std::array<Color, 3> disc_colors = {0xe4ded2, 0xcfc6b4, 0x8d9a92};

/// From light to dark, for a series on paper.
constexpr std::array<Color, 7> ramp = {0xe0a100, 0xd87a1e, 0xc2503a, 0x9c3560, 0x6f2d7a, 0x40297c, 0x0b1f45};

/// 0 at 0 degrees, 1 at 90; 180 - theta looks like theta.
inline double part_of_ninety(double theta) {
  return std::clamp(std::min(theta, 180.0 - theta) / 90.0, 0.0, 1.0);
}
/// NaN: the middle.
inline Color color_at(const std::array<Color, 7>& colors, double part) {
  return colors[static_cast<std::size_t>(std::lround(6.0 * (part >= 0.0 ? part : 0.5)))];
}

/// Of parameters and others without an order: differ in lightness too (Okabe & Ito 2008).
constexpr std::array<Color, 8> line_colors = {0x0072b2, 0xd55e00, 0x009e73, 0xcc79a7,
                                              0x56b4e9, 0xe69f00, 0x000000, 0x7f7f7f};

/// On paper; `number` and `shade` as of a series (report/figure.hpp).
inline Color paper_color(Role role, std::size_t number, double shade) {
  switch (role) {
    case Role::ordered: return color_at(ramp, shade);
    case Role::listed: return line_colors[number % line_colors.size()];
    case Role::model:
    case Role::bare: return 0x0072b2;
    case Role::specimen: return 0x555555;
    case Role::interval: return 0xa9cbe6;
    case Role::between: return 0xe9e6e1;
    case Role::theory: return 0x9a3f7d;
    case Role::left_out: return 0xd55e00;
    case Role::others: return 0x444444;
    case Role::crack: return crack_colors[number % crack_colors.size()];
    case Role::intact:
    case Role::bedding: return 0x000000;
    case Role::frame: return 0xaaaaaa;
    default: return 0x222222;
  }
}
/// On terminals, light or dark: an order runs from blue to red.
inline Color screen_color(Role role, std::size_t number, double shade) {
  constexpr std::array<Color, 7> ordered = {0x3f5bd0, 0x2187c4, 0x0f9a8b, 0x4f9638,
                                            0xa5860a, 0xd96b20, 0xc2305d};
  if (role == Role::ordered) return color_at(ordered, shade);
  const Color paper = paper_color(role, number, shade);
  return paper == 0x000000 || paper == 0x222222 ? Color{0x7a868c} : paper;
}

}  // namespace phy::report
