// Two-component vectors for cold code (geometry, genesis, statics). Hot code works on packs, see pack.hpp.
#pragma once
#include <cmath>

namespace phy {

/// A point or vector in the plane [m or dimensionless].
struct Vec2 {
  double x = 0.0;
  double y = 0.0;
};

constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
constexpr Vec2 operator*(double s, Vec2 a) { return {s * a.x, s * a.y}; }
constexpr double dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// z-component of a x b.
constexpr double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
inline double norm(Vec2 a) { return std::sqrt(dot(a, a)); }
/// The tangent that belongs to a normal: n turned anticlockwise by 90 degrees.
constexpr Vec2 tangent(Vec2 n) { return {-n.y, n.x}; }

}  // namespace phy
