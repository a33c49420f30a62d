// The boundary in the hot loop: bodies that touch or hold grains, and the jacket, row by row (boundary.hpp).
//
// Holding works without a second kind of motion: before a row moves, the force on a held component goes to
// the body and its velocity becomes the body's; the ordinary motion then carries it along. The force of step
// t is therefore collected in step t + 1, and that of a block's last step at the end of the block.
//
// Balance is found by Newton's method on a sum of springs that only push: piecewise linear and rising, so
// that a step or two meet the root. Every lane stops when its own force is met: no lane's bits depend on its
// neighbours.
#pragma once
#include "base/lane_memory.hpp"
#include "contact/wall.hpp"
#include "engine/view.hpp"

namespace phy::engine {
inline namespace PHY_ISA {

template <class R>
class BodyLoop {
 public:
  using T = ScalarOf<R>;
  static constexpr std::size_t W = NumberTraits<R>::width;

  BodyLoop(GroupView<T>& view, const R* lane_constants) : v(view), lane(lane_constants) {}

  /// Before a row moves in `step`: the forces of the step before go to the bodies, their velocities to the
  /// grains.
  PHY_HOT void hold(int row, int step) {
    for (std::int32_t i = v.row_grip[row]; i < v.row_grip[row + 1];) {
      const std::size_t at = body_at(step, v.grip[i].body);
      const R vx = load<R>(v.body_v, at), vy = load<R>(v.body_v, at + 1);
      i = each_of_body(i, row, step - 1, [&](const GripPoint& p, T* grain, MaskOf<R> held) {
        if (p.x) store(grain, g_vx, select(held, vx, load<R>(grain, g_vx)));
        if (p.y) store(grain, g_vy, select(held, vy, load<R>(grain, g_vy)));
        if (p.rotation) store(grain, g_w, select(held, R(0), load<R>(grain, g_w)));
      });
    }
  }

  /// Forces on held components go to the bodies, as those of `step`.
  void collect(int row, int step) {
    for (std::int32_t i = v.row_grip[row]; i < v.row_grip[row + 1];)
      i = each_of_body(i, row, step, [](const GripPoint&, T*, MaskOf<R>) {});
  }

  /// Forces of bodies and jacket on the grains of a row; returns the slip work.
  template <bool sample>
  R press(int row, int step) {
    R slip(0);
    const std::int32_t end = v.row_touch[row + 1];
    for (std::int32_t i = v.row_touch[row]; i < end;) {
      const std::int32_t body = v.touch[i].body;
      const std::size_t at = body_at(step, body);
      Sums sums;
      for (; i < end && v.touch[i].body == body; ++i) touch<sample>(v.touch[i], at, sums);
      add_to(v.body_force, at, sums.fx);
      add_to(v.body_force, at + 1, sums.fy);
      slip += sums.slip;
      if constexpr (sample) add_sample(v.sample, s_strain_wall, sums.energy);
    }
    for (std::int32_t i = v.row_load[row]; i < v.row_load[row + 1]; ++i) {
      const std::size_t at = 2 * static_cast<std::size_t>(i);
      add_to(grain_at(v.load[i]), g_fx, load<R>(v.load_force, at));
      add_to(grain_at(v.load[i]), g_fy, load<R>(v.load_force, at + 1));
    }
    return slip;
  }

  /// Puts the bodies in balance where they stand in `step`; all rows have moved.
  void balance(int step) {
    for (int i = 0; i < v.n_balanced; ++i) {
      const BalancePoint& p = v.balanced[i];
      const auto component = static_cast<std::size_t>(p.component);
      const std::size_t at = body_at(step, p.body), place = body_at(0, p.body) + component;
      const MaskOf<R> on = load<R>(v.balance_on, place) > R(0);
      const R planned = load<R>(v.body_u, at + component), force = load<R>(v.balance_force, place);
      const std::size_t last = body_at(step > 0 ? step - 1 : 0, p.body) + component;
      const R before = select(on, load<R>(v.body_u, last), planned);
      R now = before;
      MaskOf<R> off = on;
      for (int k = 0; k < most_balance_steps; ++k) {
        store(v.body_u, at + component, now);
        const Response r = response(p, at);
        const R missing = force - r.force;
        off = off & (abs(missing) > R(force_met) * abs(force));
        if (!any(off)) break;
        const R start = select(r.stiffness > R(0), now, now + r.reach);
        now = select(off, start + missing / max(r.stiffness, wall()[contact::wall::k_n]), now);
      }
      store(v.body_u, at + component, now);
      const R speed = (now - before) / lane[l_dt];
      store(v.body_v, at + component, select(on, speed, load<R>(v.body_v, at + component)));
    }
  }

 private:
  // Of the force asked for; single precision resolves no less once the specimen has bulged.
  static constexpr T force_met = T(1e-4);
  static constexpr int most_balance_steps = 8;  // Newton's; two are usual

  GroupView<T>& v;
  const R* lane;

  /// Force of a body along a component, as it stands, how it changes with the body's place, and how far it is
  /// to the nearest grain (where it touches none).
  struct Response {
    R force = R(0), stiffness = R(0), nearest = R(T(-1e30)), reach = R(0);
  };
  Response response(const BalancePoint& p, std::size_t at) const {
    Response r;
    for (std::int32_t i = p.first; i < p.end; ++i) {
      const TouchPoint<T>& t = v.touch[v.balanced_touch[i]];
      const T along = p.component == 0 ? t.nx : t.ny;
      const R push = wall()[contact::wall::k_n] * R(along), depth = closure(t, at);
      r.force += push * max0(depth);
      r.stiffness += select(depth > R(0), push * R(along), R(0));
      r.reach = select(depth > r.nearest, R(T(-1) / along) * depth, r.reach);
      r.nearest = max(r.nearest, depth);
    }
    return r;
  }

  struct Sums {
    R fx = R(0), fy = R(0), energy = R(0), slip = R(0);
  };

  static_assert(n_lane_fields - l_wall == contact::wall::n_parameters);
  const R* wall() const { return lane + l_wall; }
  T* grain_at(std::int32_t g) const { return v.grain + static_cast<std::size_t>(g) * n_grain_fields * W; }
  std::size_t body_at(int step, std::int32_t body) const {
    return (static_cast<std::size_t>(step) * static_cast<std::size_t>(v.n_bodies) +
            static_cast<std::size_t>(body)) *
           2;
  }

  /// Grips of a row from `i` on that belong to one body: their forces go to it as those of `step`, before the
  /// first step nowhere; then `also` has the grain. Returns the next grip. A body may hold all grains: its
  /// sum stays in a register.
  template <class Also>
  PHY_HOT std::int32_t each_of_body(std::int32_t i, int row, int step, const Also& also) {
    const std::int32_t body = v.grip[i].body;
    const std::size_t at = body_at(step < 0 ? 0 : step, body);
    const MaskOf<R> held = lane[l_grips] > R(0);
    R sum_x = load<R>(v.body_force, at), sum_y = load<R>(v.body_force, at + 1);
    for (; i < v.row_grip[row + 1] && v.grip[i].body == body; ++i) {
      const GripPoint& p = v.grip[i];
      T* grain = grain_at(p.grain);
      const R fx = p.x ? take(grain, g_fx, held) : R(0);
      const R fy = p.y ? take(grain, g_fy, held) : R(0);
      if (p.rotation) take(grain, g_tq, held);
      sum_x = sum_x + -fx, sum_y = sum_y + -fy;
      also(p, grain, held);
    }
    if (step >= 0) store(v.body_force, at, sum_x), store(v.body_force, at + 1, sum_y);
    return i;
  }

  std::size_t place_of(const TouchPoint<T>& p) const {
    return static_cast<std::size_t>(p.body) * static_cast<std::size_t>(v.n_grains) +
           static_cast<std::size_t>(p.grain);
  }
  R closure(const TouchPoint<T>& p, std::size_t at) const {
    const T* grain = grain_at(p.grain);
    return R(p.nx) * (load<R>(v.body_u, at) - load<R>(grain, g_ux)) +
           R(p.ny) * (load<R>(v.body_u, at + 1) - load<R>(grain, g_uy)) - load<R>(v.touch_gap, place_of(p));
  }

  /// Takes a force off a grain in the lanes whose grips hold.
  static R take(T* grain, int field, MaskOf<R> held) {
    const R force = load<R>(grain, static_cast<std::size_t>(field));
    store(grain, static_cast<std::size_t>(field), select(held, R(0), force));
    return select(held, force, R(0));
  }

  /// The body is grain 1: n into the specimen, t = n turned anticlockwise.
  template <bool sample>
  void touch(const TouchPoint<T>& p, std::size_t at, Sums& sums) {
    T* grain = grain_at(p.grain);
    const std::size_t place = place_of(p);
    const R nx(p.nx), ny(p.ny), radius(v.grain_const[p.grain].radius);
    const R vx = load<R>(grain, g_vx) - load<R>(v.body_v, at);
    const R vy = load<R>(grain, g_vy) - load<R>(v.body_v, at + 1);
    const R d_slide = (nx * vy - ny * vx - load<R>(grain, g_w) * radius) * lane[l_dt];
    const auto law = contact::wall::law(wall(), R(p.rough));
    R shear = load<R>(v.touch_shear, place);
    const laws::Reaction<R> r = contact::wall::respond(law, shear, closure(p, at), d_slide);
    store(v.touch_shear, place, shear);
    const R fx = nx * r.F_n - ny * r.F_s, fy = ny * r.F_n + nx * r.F_s;
    add_to(grain, g_fx, fx);
    add_to(grain, g_fy, fy);
    add_to(grain, g_tq, -(radius * r.F_s));
    sums.fx += fx, sums.fy += fy;
    sums.slip += r.dissipated;
    if constexpr (sample) sums.energy += contact::wall::strain_energy(law, r);
  }
};

}  // namespace PHY_ISA
}  // namespace phy::engine
