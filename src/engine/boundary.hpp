// The boundary of a test: the rigid bodies around a specimen, and the pressure on its sides.
//
// Every boundary of the laboratory is one of three things, so that the engine knows no test by name:
//   touch   a body pushes grains like a wall: linear law without tension, a normal of its own for every grain
//           (a flat platen has the same everywhere, a curved jaw has not)
//   grip    a body holds grains: chosen components of their motion are those of the body
//   jacket  a stress on the grains that are the surface of the sides, or of a hole (engine/jacket.hpp)
// A body translates and does not turn. Each of its two components moves at a velocity, under a servo or in
// balance. Force and displacement of every body are kept step by step; their product is the work in the
// energy balance.
//
// Servo. Once per block (the recipe's history interval) the speed is set so that a fraction of the missing
// force would arrive within the next block; PFC's rule v = gain (F_target - F), with a memory of the speed so
// that a steady drift (the specimen bulging while it is loaded) leaves no error:
//   m <- m + integral e / K,   d = m + proportional e / K,   e = F_target - mean force of the last block
// K is what the specimen answers with within a block, stated by the laboratory. Source of the rule: Itasca
// PFC documentation, wall servo.
//
// Balance. A body without mass that touches grains and is pressed on them with a given force: in every step
// its place is the one where what it touches adds up to that force,
//   sum_i k n_ic max(0, n_i . (U - u_i) - gap_i) = F_target         solved for the component U_c
// so the force on the specimen has no error to correct (docs/decisions/0007). Taking a degree of freedom
// without mass out of the equations lowers no stable step: the stiffness that grains feel is at most that of
// a wall at rest.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/vec.hpp"

namespace phy::engine {

/// A grain (packing number) that a body may touch.
struct Touch {
  std::uint32_t grain = 0;
  Vec2 normal;       ///< unit vector, from the body into the specimen
  double gap = 0.0;  ///< before anything has moved [m]; <= 0: touches from the start, stress-free
};

/// A grain that a body holds, by component.
struct Grip {
  std::uint32_t grain = 0;
  bool x = false, y = false, rotation = false;
};

struct BoundaryBody {
  std::string name;
  std::vector<Touch> touches;
  std::vector<Grip> grips;
  bool rough = false;  ///< has the lane's body friction, else none
};

/// Two opposite bodies. Positive: they approach, they push. Strain and stress are defined by the test, from
/// their travel [m] and force [N/m].
struct LoadAxis {
  int lo = -1, hi = -1;  ///< bodies; -1: no such axis
  Vec2 direction;        ///< unit vector from lo to hi
  double loaded = 0.0;   ///< travel from which the energy balance means something [m]
  bool present() const { return lo >= 0; }
  double travel(Vec2 lo_displacement, Vec2 hi_displacement) const {
    return dot(lo_displacement - hi_displacement, direction);
  }
};

/// A circular hole, as it was cut.
struct Hole {
  Vec2 centre = {};     ///< in the packing [m]
  double radius = 0.0;  ///< [m] 0: none
};

/// The surfaces that jackets press on.
struct Jacket {
  bool sides = false;
  Hole hole = {};
  bool present() const { return sides || hole.radius > 0.0; }
};

struct Boundary {
  std::vector<BoundaryBody> bodies;
  Jacket jacket = {};
  LoadAxis axial, lateral;
};

/// Control of one component of a body by its force.
struct Servo {
  bool on = false;
  double force = 0.0;      ///< target of the force on the specimen, signed along the axis [N/m]
  double stiffness = 0.0;  ///< K: change of that force per displacement within a block, > 0 [N/m per m]
  double spring = 0.0;     ///< the target falls by this much per displacement (normal stiffness) [N/m per m]
  double max_speed = 1.0;  ///< [m/s]
};

/// One component of a body in balance with the grains that it touches.
struct Balance {
  bool on = false;
  double force = 0.0;  ///< of the body on the specimen, signed along the axis [N/m]
};

/// How a body moves.
struct PrescribedMotion {
  Vec2 velocity;      ///< [m/s]; a component under servo or in balance ignores it
  double ramp = 0.0;  ///< time in which the velocity changes linearly from `before` [s]
  Servo servo_x = {}, servo_y = {};
  Balance balance_x = {}, balance_y = {};
  Vec2 before = {};  ///< [m/s]
};

/// A body at the end of a block.
struct BodyState {
  Vec2 displacement;  ///< since it was placed [m]
  Vec2 force;         ///< on the specimen, at the last step [N/m]
  Vec2 mean_force;    ///< mean over the block [N/m]
};

/// The jacket of the sides at the end of a block.
struct JacketState {
  double pressure = 0.0;  ///< [Pa]
  double swept = 0.0;     ///< area since the boundary was placed, inwards positive [m^2]
};

}  // namespace phy::engine
