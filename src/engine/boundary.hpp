// The boundary of a group: its tools and jacket (rig.hpp) as they stand and move in every lane, and the
// points where they act. All lanes have the same tools; where these touch or hold differs by the packing
// alone. The force loop moves tools in balance itself (tool_loop.hpp); all others are planned for a block
// ahead.
#pragma once
#include <vector>

#include "engine/grain_memory.hpp"
#include "engine/neighbour_list.hpp"
#include "engine/rig.hpp"

namespace phy::engine::group {

/// A tool in a lane.
struct ToolMotion {
  Drive drive;
  double drive_time = 0.0;
  Vec2 memory;  // servo: remembered displacement per block
  ToolState state;
  Vec2 listed_at;  // displacement when the points near the tools were listed
};

/// The boundary of one lane.
struct LaneBoundary {
  std::shared_ptr<const Rig> rig;  // null: none, or an empty lane
  bool placed = false;
  double damping = 0.0, density = 1.0,
         dt = 0.0;  // of the lane: for the way on which the jacket drives a free grain
  std::vector<ToolMotion> tools;
  double pressure = 0.0;        // of the jacket [Pa]
  double swept = 0.0;           // area that it has swept since it was placed [m^2]
  std::vector<double> pressed;  // height of each sorted grain that it presses on, as it fits [m]
  double swept_from = 0.0;      // sum of height times displacement, when it was fitted [m^2]
};

template <class T>
class Boundary {
 public:
  /// interval: cycles per block.
  Boundary(const GrainMemory<T>& grains, int interval);

  LaneBoundary& lane(std::size_t l) { return lanes_[l]; }
  const LaneBoundary& lane(std::size_t l) const { return lanes_[l]; }
  void clear(std::size_t l);
  void copy(std::size_t l, Boundary<T>& to, std::size_t to_lane) const;

  /// Takes the geometry of a rig; that of the group's first specimen is that of all.
  void adopt(const Rig& rig);
  /// Sets tools and jacket against the specimen as it lies, at rest. Grains whose packing overlaps a tool
  /// touch it from the start, stress-free; the others keep their gap.
  void place(std::size_t l);
  void drive(std::size_t l, std::size_t tool, const Drive& drive);
  /// Adds the work of tools and jacket in the last block [J/m], step by step, and reads their forces.
  void add_work(std::size_t l, double& work);
  /// Displacement of a tool in a step of the last block [m].
  Vec2 displacement(std::size_t step, std::size_t tool, std::size_t l) const {
    return tool_vector(tool_u_, step, tool, l);
  }

  /// Fits the jackets to the surface as it is, before a block. A list that does not allow for the way on
  /// which the jacket drives a grain is forgotten; true if one was.
  bool fit_jackets(NeighbourList<T>& list);
  /// Way on which the jacket alone would drive each grain that nothing holds in a block [m]; empty: no
  /// jacket.
  std::vector<double> push(std::size_t l) const;

  /// The points near tools, after a new neighbour list.
  void list_touches(const NeighbourList<T>& list);
  /// How tools move in the next block.
  void plan();
  /// Where the loop has put the tools in balance.
  void read_balance();
  /// The most that a tool may be off the place where its points were listed after the next block [m].
  double reach(std::size_t l, double fastest_grain, double block) const;
  void enter(GroupView<T>& view);

 private:
  const GrainMemory<T>* grains_;
  std::size_t W_, n_steps_;
  std::vector<LaneBoundary> lanes_;
  std::size_t n_tools_ = 0;
  bool jacket_ = false;
  std::vector<Vec2> touch_normal_;          // per tool and sorted grain; zero: never touched
  Buffer<T> touch_gap_, touch_shear_;       // per tool, grain and lane
  Buffer<T> tool_u_, tool_v_, tool_force_;  // per step, tool, component and lane
  Buffer<double> tool_du_;
  Buffer<T> balance_on_, balance_force_;  // per tool, component and lane
  std::vector<BalancePoint> balanced_;    // in some lane, in the block that runs
  std::vector<std::int32_t> balanced_touch_;
  std::vector<std::int32_t> row_touch_, row_grip_, row_load_;
  std::vector<TouchPoint<T>> touch_;
  std::vector<GripPoint> grip_;
  std::vector<std::int32_t> load_;  // grains that a jacket presses in some lane
  Buffer<T> load_force_;

  bool acts(std::size_t l) const { return lanes_[l].rig && lanes_[l].placed; }
  /// Place of a tool's x component in a step; y follows W_ further on.
  std::size_t tool_at(std::size_t step, std::size_t tool, std::size_t lane) const {
    return (step * n_tools_ + tool) * 2 * W_ + lane;
  }
  Vec2 tool_vector(const Buffer<T>& field, std::size_t step, std::size_t tool, std::size_t lane) const {
    const std::size_t i = tool_at(step, tool, lane);
    return {static_cast<double>(field[i]), static_cast<double>(field[i + W_])};
  }
  void list_grips(const Rig& rig);
  void place_tool(std::size_t tool, std::size_t l);
  bool near(std::size_t tool, std::size_t g, const NeighbourList<T>& list) const;
  Vec2 block_velocity(LaneBoundary& lane, ToolMotion& tool) const;
  void plan_balance();
  void plan_lane(std::size_t l);
  double pushed_way(std::size_t grain, std::size_t l) const;
  double area_swept(std::size_t l) const;
  bool fit_jacket(std::size_t l, NeighbourList<T>& list);
  void list_loads();
};

}  // namespace phy::engine::group
