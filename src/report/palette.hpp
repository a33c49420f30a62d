// Colours of figures and films: of cracks by mode and place, of inclinations, of bedding. They differ in
// lightness too, so that they hold for colour-blind readers and in grey; figures add symbols and words.
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

constexpr Color intact_color = 0x3d464c;
/// From blue (0 degrees) to red (90); 180 - theta looks like theta.
inline Color angle_color(const TestResult& r) {
  constexpr std::array<Color, 7> ordered = {0x3f5bd0, 0x2187c4, 0x0f9a8b, 0x4f9638,
                                            0xa5860a, 0xd96b20, 0xc2305d};
  if (r.intact) return intact_color;
  const double part = std::min(r.theta, 180.0 - r.theta) / 90.0;
  return ordered[static_cast<std::size_t>(std::lround(6.0 * std::clamp(part, 0.0, 1.0)))];
}

}  // namespace phy::report
