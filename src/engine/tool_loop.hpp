// The rig in the hot loop: tools that touch or hold grains, and loads on grains, row by row (rig.hpp).
//
// Holding works without a second kind of motion: before a row moves, the force on a held component goes to
// the tool and its velocity becomes the tool's; the ordinary motion then carries it along. The force of step
// t is therefore collected in step t + 1, and that of a block's last step at the end of the block.
#pragma once
#include "engine/lane_memory.hpp"
#include "engine/view.hpp"
#include "laws/laws.hpp"

namespace phy {
inline namespace PHY_ISA {

template <class R>
class ToolLoop {
 public:
  using T = ScalarOf<R>;
  static constexpr std::size_t W = NumberTraits<R>::width;

  ToolLoop(GroupView<T>& view, const R* lane_constants) : v(view), lane(lane_constants) {}

  /// Before a row moves in `step`.
  void hold(int row, int step) {
    collect(row, step - 1);
    for (std::int32_t i = v.row_grip[row]; i < v.row_grip[row + 1]; ++i) {
      const GripPoint& p = v.grip[i];
      T* grain = grain_at(p.grain);
      const std::size_t at = tool_at(step, p.tool);
      const auto held = lane[l_grips] > R(0);
      if (p.x) store(grain, g_vx, select(held, load<R>(v.tool_v, at), load<R>(grain, g_vx)));
      if (p.y) store(grain, g_vy, select(held, load<R>(v.tool_v, at + 1), load<R>(grain, g_vy)));
      if (p.rotation) store(grain, g_w, select(held, R(0), load<R>(grain, g_w)));
    }
  }

  /// Forces on held components go to the tool, as those of `step`; before the first step they are dropped.
  void collect(int row, int step) {
    for (std::int32_t i = v.row_grip[row]; i < v.row_grip[row + 1]; ++i) {
      const GripPoint& p = v.grip[i];
      T* grain = grain_at(p.grain);
      const R fx = p.x ? take(grain, g_fx) : R(0);
      const R fy = p.y ? take(grain, g_fy) : R(0);
      if (p.rotation) take(grain, g_tq);
      if (step < 0) continue;
      add_to(v.tool_force, tool_at(step, p.tool), -fx);
      add_to(v.tool_force, tool_at(step, p.tool) + 1, -fy);
    }
  }

  /// Forces of tools and loads on the grains of a row; returns the slip work.
  template <bool sample>
  R press(int row, int step) {
    R slip(0);
    const std::int32_t end = v.row_touch[row + 1];
    for (std::int32_t i = v.row_touch[row]; i < end;) {
      const std::int32_t tool = v.touch[i].tool;
      const std::size_t at = tool_at(step, tool);
      Sums sums;
      for (; i < end && v.touch[i].tool == tool; ++i) touch<sample>(v.touch[i], at, sums);
      add_to(v.tool_force, at, sums.fx);
      add_to(v.tool_force, at + 1, sums.fy);
      slip += sums.slip;
      if constexpr (sample) add_sample(v.sample, s_strain_wall, sums.energy);
    }
    for (std::int32_t i = v.row_load[row]; i < v.row_load[row + 1]; ++i) {
      const LoadPoint<T>& p = v.load[i];
      add_to(grain_at(p.grain), g_fx, lane[l_pressure] * R(p.x));
      add_to(grain_at(p.grain), g_fy, lane[l_pressure] * R(p.y));
    }
    return slip;
  }

 private:
  GroupView<T>& v;
  const R* lane;

  struct Sums {
    R fx = R(0), fy = R(0), energy = R(0), slip = R(0);
  };

  T* grain_at(std::int32_t g) const { return v.grain + static_cast<std::size_t>(g) * n_grain_fields * W; }
  std::size_t tool_at(int step, std::int32_t tool) const {
    return (static_cast<std::size_t>(step) * static_cast<std::size_t>(v.n_tools) +
            static_cast<std::size_t>(tool)) *
           2;
  }

  /// Takes a force off a grain in the lanes whose grips hold.
  R take(T* grain, int field) {
    const auto held = lane[l_grips] > R(0);
    const R force = load<R>(grain, static_cast<std::size_t>(field));
    store(grain, static_cast<std::size_t>(field), select(held, R(0), force));
    return select(held, force, R(0));
  }

  /// The linear law with the tool as grain 1: n into the specimen, t = n turned anticlockwise.
  template <bool sample>
  void touch(const TouchPoint<T>& p, std::size_t at, Sums& sums) {
    T* grain = grain_at(p.grain);
    const std::size_t place = static_cast<std::size_t>(p.tool) * static_cast<std::size_t>(v.n_grains) +
                              static_cast<std::size_t>(p.grain);
    const R nx(p.nx), ny(p.ny), radius(v.grain_const[p.grain].radius);
    const R closure = nx * (load<R>(v.tool_u, at) - load<R>(grain, g_ux)) +
                      ny * (load<R>(v.tool_u, at + 1) - load<R>(grain, g_uy)) - load<R>(v.touch_gap, place);
    const R vx = load<R>(grain, g_vx) - load<R>(v.tool_v, at);
    const R vy = load<R>(grain, g_vy) - load<R>(v.tool_v, at + 1);
    const R d_slide = (nx * vy - ny * vx - load<R>(grain, g_w) * radius) * lane[l_dt];
    const linear::Parameters<R> law{lane[l_wall_kn], lane[l_wall_ks], lane[l_wall_inv_ks],
                                    lane[l_wall_mu] * R(p.rough)};
    linear::State<R> state{load<R>(v.touch_shear, place)};
    const Reaction<R> r = linear::respond(law, state, Motion<R>{closure, R(0), d_slide, R(0)});
    store(v.touch_shear, place, state.F_s);
    const R fx = nx * r.F_n - ny * r.F_s, fy = ny * r.F_n + nx * r.F_s;
    add_to(grain, g_fx, fx);
    add_to(grain, g_fy, fy);
    add_to(grain, g_tq, -(radius * r.F_s));
    sums.fx += fx, sums.fy += fy;
    sums.slip += r.dissipated;
    if constexpr (sample) sums.energy += linear::strain_energy(law, r.F_n, r.F_s);
  }
};

}  // namespace PHY_ISA
}  // namespace phy
