// The rock around an opening in one direction from its middle (lab/opening).
#pragma once
#include <cstdint>

namespace phy {

/// Moments of a test at which the wall is looked at.
enum class WallMoment : std::uint8_t { standing, end };
constexpr WallMoment all_wall_moments[] = {WallMoment::standing, WallMoment::end};
constexpr const char* to_string(WallMoment moment) {
  return moment == WallMoment::standing ? "standing" : "end";
}

struct WallPoint {
  WallMoment moment = WallMoment::standing;
  double angle = 0.0;                            ///< from +x, anticlockwise [deg]
  double borne_stress = 0.0;                     ///< of the history then [Pa]
  double hoop = 0.0, radial = 0.0, shear = 0.0;  ///< in the ring behind the wall, compression positive [Pa]
  double inwards = 0.0;                          ///< displacement of the wall since the excavation began [m]
  double breakout = 0.0;                         ///< depth of rock that hangs on the rest by no bond [m]
};

}  // namespace phy
