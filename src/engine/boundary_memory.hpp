// The boundary of a group: its bodies and jacket (boundary.hpp) as they stand and move in every lane, and the
// points where they act. All lanes have the same bodies; where these touch or hold differs by the packing
// alone. The force loop moves bodies in balance itself (body_loop.hpp); all others are planned for a block
// ahead.
#pragma once
#include <vector>

#include "engine/boundary.hpp"
#include "engine/grain_memory.hpp"
#include "engine/neighbour_list.hpp"

namespace phy::engine::group {

/// A body in a lane.
struct BodyMotion {
  PrescribedMotion prescribed;
  double motion_time = 0.0;
  Vec2 memory;  // servo: remembered displacement per block
  BodyState state;
  Vec2 listed_at;  // displacement when the points near the bodies were listed
};

/// A surface under a jacket.
struct PressedSurface {
  Vec2 stress;             // along x and y [Pa]
  double swept = 0.0;      // area that it has swept since it was placed [m^2]
  std::vector<Vec2> area;  // of each sorted grain that it presses on, as it fits [m]; empty: no such surface
  Vec2 swept_from;         // sum of area times displacement, when it was fitted [m^2]
};

/// The boundary of one lane.
struct LaneBoundary {
  std::shared_ptr<const Boundary> boundary;  // null: none, or an empty lane
  bool placed = false;
  // Of the lane: for the way on which the jacket pushes a free grain.
  double damping = 0.0, density = 1.0, dt = 0.0;
  std::vector<BodyMotion> bodies;
  PressedSurface sides, hole;
};

template <class T>
class BoundaryMemory {
 public:
  /// interval: cycles per block.
  BoundaryMemory(const GrainMemory<T>& grains, int interval);

  LaneBoundary& lane(std::size_t l) { return lanes_[l]; }
  const LaneBoundary& lane(std::size_t l) const { return lanes_[l]; }
  void clear(std::size_t l);
  void copy(std::size_t l, BoundaryMemory<T>& to, std::size_t to_lane) const;

  /// Takes the geometry of a boundary; that of the group's first specimen is that of all.
  void adopt(const Boundary& boundary);
  /// Sets bodies and jacket against the specimen as it lies, at rest. Grains whose packing overlaps a body
  /// touch it from the start, stress-free; the others keep their gap.
  void place(std::size_t l);
  void prescribe(std::size_t l, std::size_t body, const PrescribedMotion& prescribed);
  /// Adds the work of bodies and jacket in the last block [J/m], step by step, and reads their forces.
  void add_work(std::size_t l, double& work);
  /// Displacement of a body in a step of the last block [m].
  Vec2 displacement(std::size_t step, std::size_t body, std::size_t l) const {
    return body_vector(body_u_, step, body, l);
  }

  /// Fits the jackets to the surface as it is, before a block. A list that does not allow for the way on
  /// which the jacket pushes a grain is forgotten; true if one was.
  bool fit_jackets(NeighbourList<T>& list);
  /// Way on which the jacket alone would push each grain that nothing holds in a block [m]; empty: no
  /// jacket.
  std::vector<double> push(std::size_t l) const;

  /// What a block changes, planned motions among it.
  struct State {
    std::vector<LaneBoundary> lanes;
    std::vector<T> touch_shear;
  };
  void keep(State& in) const { in.lanes = lanes_, touch_shear_.keep(in.touch_shear); }
  void restore(const State& from) { lanes_ = from.lanes, touch_shear_.restore(from.touch_shear); }

  /// A grain that went farther than the lane's list allows for presses on a body, which it may not have been
  /// held against from the start of the block.
  bool missed(std::size_t l, const NeighbourList<T>& list) const;
  /// The points near bodies, after a new neighbour list.
  void list_touches(const NeighbourList<T>& list);
  /// How bodies move in the next block.
  void plan();
  /// Where the loop has put the bodies in balance.
  void read_balance();
  /// The most that a body may be off the place where its points were listed after the next block [m].
  double reach(std::size_t l, double fastest_grain, double block) const;
  void enter(GroupView<T>& view);

 private:
  const GrainMemory<T>* grains_;
  std::size_t W_, n_steps_;
  std::vector<LaneBoundary> lanes_;
  std::size_t n_bodies_ = 0;
  Jacket jacket_;
  std::vector<Vec2> touch_normal_;          // per body and sorted grain; zero: never touched
  Buffer<T> touch_gap_, touch_shear_;       // per body, grain and lane
  Buffer<T> body_u_, body_v_, body_force_;  // per step, body, component and lane
  Buffer<double> body_du_;
  Buffer<T> balance_on_, balance_force_;  // per body, component and lane
  std::vector<BalancePoint> balanced_;    // in some lane, in the block that runs
  std::vector<std::int32_t> balanced_touch_;
  std::vector<std::int32_t> row_touch_, row_grip_, row_load_;
  std::vector<TouchPoint<T>> touch_;
  std::vector<GripPoint> grip_;
  std::vector<std::int32_t> load_;  // grains that a jacket presses in some lane
  Buffer<T> load_force_;

  bool acts(std::size_t l) const { return lanes_[l].boundary && lanes_[l].placed; }
  /// Place of a body's x component in a step; y follows W_ further on.
  std::size_t body_at(std::size_t step, std::size_t body, std::size_t lane) const {
    return (step * n_bodies_ + body) * 2 * W_ + lane;
  }
  Vec2 body_vector(const Buffer<T>& field, std::size_t step, std::size_t body, std::size_t lane) const {
    const std::size_t i = body_at(step, body, lane);
    return {static_cast<double>(field[i]), static_cast<double>(field[i + W_])};
  }
  void list_grips(const Boundary& boundary);
  void place_body(std::size_t body, std::size_t l);
  bool near(std::size_t body, std::size_t g, const NeighbourList<T>& list) const;
  Vec2 block_velocity(LaneBoundary& lane, BodyMotion& body) const;
  void plan_balance();
  void plan_lane(std::size_t l);
  double pushed_way(std::size_t grain, std::size_t l) const;
  Vec2 pressing(std::size_t grain, std::size_t l) const;
  Vec2 area_swept(const PressedSurface& surface, std::size_t l) const;
  void add_work(PressedSurface& surface, std::size_t l, double& work) const;
  bool fit_jacket(std::size_t l, NeighbourList<T>& list);
  void list_loads();
};

}  // namespace phy::engine::group
