// Motion and answer of a single contact, as plain numbers: what the contact bench, the closed forms and
// `phyllite contact` exchange. Signs: laws/law.hpp.
#pragma once

namespace phy {

/// Displacement of grain 2 against grain 1 at the contact, since the start.
struct ContactPoint {
  double closure = 0.0;   ///< [m]
  double slide = 0.0;     ///< along t [m]
  double rotation = 0.0;  ///< [rad]
};
constexpr ContactPoint operator-(ContactPoint p, ContactPoint q) {
  return {p.closure - q.closure, p.slide - q.slide, p.rotation - q.rotation};
}
constexpr ContactPoint operator+(ContactPoint p, ContactPoint q) {
  return {p.closure + q.closure, p.slide + q.slide, p.rotation + q.rotation};
}
constexpr ContactPoint operator*(double f, ContactPoint p) {
  return {f * p.closure, f * p.slide, f * p.rotation};
}

/// What the contact does to grain 2.
struct ContactForces {
  double F_n = 0.0;  ///< compression positive [N/m]
  double F_s = 0.0;  ///< along t [N/m]
  double M = 0.0;    ///< [N]
};

}  // namespace phy
