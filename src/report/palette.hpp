// Colours of figures and films: of cracks by mode and place, of inclinations, of bedding. Those of curves on
// paper differ in lightness, so that they hold for colour-blind readers and in grey; figures add symbols,
// dashes and words.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include <fmt/format.h>

#include "records/result.hpp"

namespace phy::report {

using Color = std::uint32_t;  ///< 0xRRGGBB

inline std::string hex_color(Color c) { return fmt::format("#{:06x}", c); }

/// Numbered by crack_kind().
constexpr std::array<Color, 4> crack_colors = {0xd1400b, 0x8b2fa0, 0x0a66c2, 0x00875f};
constexpr std::array<const char*, 4> crack_names = {"matrix, tension", "matrix, shear", "bedding, tension",
                                                    "bedding, shear"};
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
inline Color color_at(const std::array<Color, 7>& colors, double part) {
  return colors[static_cast<std::size_t>(std::lround(6.0 * part))];
}

constexpr Color intact_color = 0x3d464c;
/// On screens, light or dark: from blue (0 degrees) to red (90).
inline Color angle_color(const TestResult& r) {
  constexpr std::array<Color, 7> ordered = {0x3f5bd0, 0x2187c4, 0x0f9a8b, 0x4f9638,
                                            0xa5860a, 0xd96b20, 0xc2305d};
  return r.intact ? intact_color : color_at(ordered, part_of_ninety(r.theta));
}
/// On paper.
inline Color paper_color(const TestResult& r) {
  return r.intact ? Color{0x000000} : color_at(ramp, part_of_ninety(r.theta));
}

}  // namespace phy::report
