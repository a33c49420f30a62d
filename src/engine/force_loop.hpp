// The hot loop: motion and forces, row by row, over lanes. One cycle is
//
//   motion   v(t+dt/2) = v(t-dt/2) + dt (F + F_damp)/m,   u(t+dt) = u(t) + dt v(t+dt/2)
//   forces   gap and normal from displacements, increments from velocities, laws, forces on both grains
//
// Gap without cancellation, also in single precision: with X the initial branch vector (length d0) and u the
// relative displacement, q = 2 X.u + u.u, d = sqrt(d0^2 + q), and the stretch d - d0 = q/(d + d0).
//
// Time skewing. forces(row) needs the rows `row` and `row - 1` moved in this cycle and not yet in the next.
// So a sweep over fronts can run several cycles at once, each one row behind the other, while the rows lie in
// the cache:
//   for front: for t: row = front - t; move(row); forces(row)
// Every grain sees the same operations in the same order as without skewing; no bit changes. If a contact
// joins rows that are not neighbours (fragments), the group runs with skew 1, where any lower row has been
// moved already. Bodies in balance (boundary.hpp) forbid skewing: where they stand in a cycle depends on all
// rows.
//
// Energy. Local damping F_damp = -alpha |F| sign(v) takes alpha |F| sign(v) (v_old + v_new)/2 dt, which
// closes the kinetic energy of the leap-frog exactly; per cycle the sum goes to `damping` (times 2/dt), slip
// work to `slip`. Contributions of lanes in which a contact does nothing are zero and leave every sum
// unchanged: a lane's bits do not depend on its neighbours.
#pragma once
#include "base/lane_memory.hpp"
#include "contact/step.hpp"
#include "engine/body_loop.hpp"
#include "engine/view.hpp"

namespace phy::engine {
inline namespace PHY_ISA {

/// The loop over one group, with the lane constants at hand. Models: a combination of contact models
/// (contact/models.hpp), folded in at compile time.
template <class R, class Models>
class ForceLoop {
 public:
  using T = ScalarOf<R>;
  using Matrix = typename Models::Matrix;
  using Interface = typename Models::Interface;
  using Kinematics = contact::Kinematics<R>;
  using ContactForce = contact::ContactForce<R>;
  static constexpr std::size_t W = NumberTraits<R>::width;
  static constexpr std::size_t n_contact_fields = c_fields + Models::n_fields;
  static constexpr T closest = T(1e-4);  // of (distance of two centres / that at the start)^2

  explicit ForceLoop(GroupView<T>& view) : v(view) {
    for (std::size_t i = 0; i < n_lane_fields; ++i) lane[i] = load<R>(v.lane, i);
    for (std::size_t i = 0; i < Matrix::n_parameters; ++i) matrix_constants[i] = load<R>(v.matrix, i);
  }

  void advance(int n_steps) {
    int done = 0;
    if (v.n_balanced > 0) {
      step_by_step(n_steps);
      done = n_steps - 1;
    }
    while (done + 1 < n_steps) {
      const int depth = n_steps - 1 - done < v.skew ? n_steps - 1 - done : v.skew;
      sweep(done, depth);
      done += depth;
    }
    for (int row = 0; row < v.n_rows; ++row) {
      if (v.n_balanced == 0) move_row(row, done);
      forces_row<true>(row, done);
    }
    for (int row = 0; row < v.n_rows; ++row) BodyLoop<R>(v, lane).collect(row, done);
    sample_grains();
  }

 private:
  GroupView<T>& v;
  R lane[n_lane_fields];
  R matrix_constants[Matrix::n_parameters];

  void sweep(int first, int depth) {
    for (int front = 0; front < v.n_rows + depth - 1; ++front) {
      for (int t = 0; t < depth; ++t) {
        const int row = front - t;
        if (row < 0 || row >= v.n_rows) continue;
        move_row(row, first + t);
        forces_row<false>(row, first + t);
      }
    }
  }

  /// All cycles but the forces of the last, where bodies in balance have to know all rows. Forces of a cycle
  /// and motion of the next still share a sweep, unless contacts join rows that are not neighbours.
  void step_by_step(int n_steps) {
    const int behind = v.skew > 1 ? 1 : v.n_rows;
    for (int row = 0; row < v.n_rows; ++row) move_row(row, 0);
    for (int step = 0; step + 1 < n_steps; ++step) {
      BodyLoop<R>(v, lane).balance(step);
      for (int front = 0; front < v.n_rows + behind; ++front) {
        if (front < v.n_rows) forces_row<false>(front, step);
        if (front >= behind) move_row(front - behind, step + 1);
      }
    }
    BodyLoop<R>(v, lane).balance(n_steps - 1);
  }

  // The boundary (body_loop.hpp), out of the way of the loop over contacts.
  PHY_RARE void hold_grips(int row, int step) { BodyLoop<R>(v, lane).hold(row, step); }
  template <bool sample>
  PHY_RARE R press_bodies(int row, int step) {
    return BodyLoop<R>(v, lane).template press<sample>(row, step);
  }

  /// -F_damp: the force of local damping against the motion.
  PHY_HOT static R brake_of(R force, R velocity, R alpha) {
    const R size = alpha * abs(force);
    return select(velocity > R(0), size, select(velocity < R(0), -size, R(0)));
  }

  /// One component of motion; returns the damping work times 2/dt.
  static R move_component(T* grain, GrainField f, GrainField vel, GrainField u, R scale, R alpha, R dt) {
    const R force = load<R>(grain, f);
    const R old = load<R>(grain, vel);
    const R brake = brake_of(force, old, alpha);
    const R now = old + (force - brake) * scale;
    store(grain, vel, now);
    store(grain, u, load<R>(grain, u) + now * dt);
    store(grain, f, R(0));
    return brake * (old + now);
  }

  void move_row(int row, int step) {
    if (v.row_grip[row] != v.row_grip[row + 1]) hold_grips(row, step);
    R work(0);
    for (std::int32_t g = v.row_grain[row]; g < v.row_grain[row + 1]; ++g) {
      T* grain = v.grain + static_cast<std::size_t>(g) * n_grain_fields * W;
      const GrainConst<T>& c = v.grain_const[g];
      const R linear = lane[l_accel] * R(c.inv_area);
      const R angular = lane[l_accel] * R(c.inv_inertia);
      const R alpha = lane[l_damping];
      work += move_component(grain, g_fx, g_vx, g_ux, linear, alpha, lane[l_dt]);
      work += move_component(grain, g_fy, g_vy, g_uy, linear, alpha, lane[l_dt]);
      work += move_component(grain, g_tq, g_w, g_rot, angular, alpha, lane[l_dt]);
    }
    add_to(v.damping, static_cast<std::size_t>(step), work);
  }

  T* grain_at(std::int32_t g) const { return v.grain + static_cast<std::size_t>(g) * n_grain_fields * W; }

  PHY_HOT Kinematics kinematics(const ContactConst<T>& c) const {
    const T* a = grain_at(c.a);
    const T* b = grain_at(c.b);
    const R dux = load<R>(b, g_ux) - load<R>(a, g_ux);
    const R duy = load<R>(b, g_uy) - load<R>(a, g_uy);
    const R q = R(2) * (R(c.X) * dux + R(c.Y) * duy) + (dux * dux + duy * duy);
    // Interfaces let grains slide into each other, until their centres meet: there the branch has no
    // direction (its normal fades to zero) and the interface, which has its own, does not need one.
    const R d = sqrt(max(R(c.d0 * c.d0) + q, R(c.d0 * c.d0 * closest)));
    Kinematics k;
    const R inv_d = R(1) / d;
    k.stretch = q / (d + R(c.d0));
    k.nx = (R(c.X) + dux) * inv_d;
    k.ny = (R(c.Y) + duy) * inv_d;
    k.lever_1 = R(c.lever_a) + R(T(0.5)) * k.stretch;
    k.lever_2 = R(c.lever_b) + R(T(0.5)) * k.stretch;
    const R w_1 = load<R>(a, g_w), w_2 = load<R>(b, g_w);
    const R roll = w_1 * k.lever_1 + w_2 * k.lever_2;
    k.vx = load<R>(b, g_vx) - load<R>(a, g_vx) + roll * k.ny;
    k.vy = load<R>(b, g_vy) - load<R>(a, g_vy) - roll * k.nx;
    k.rotation = load<R>(b, g_rot) - load<R>(a, g_rot);
    k.spin = w_2 - w_1;
    return k;
  }

  /// Sums of one row.
  struct RowSums : contact::Sums<R> {
    R force = R(0), contacts = R(0);
  };

  PHY_RARE void record_cracks(MaskOf<R> in_tension, MaskOf<R> in_shear, R released, int part, int step,
                              std::int32_t contact) {
    for (int l = 0; l < static_cast<int>(W); ++l) {
      const bool tension = NumberTraits<R>::test(in_tension, l);
      const bool shear = NumberTraits<R>::test(in_shear, l);
      if (!tension && !shear) continue;
      if (v.n_cracks < v.max_cracks)
        v.cracks[v.n_cracks] = {step, contact,       l,
                                part, shear ? 1 : 0, static_cast<double>(NumberTraits<R>::get(released, l))};
      ++v.n_cracks;
    }
  }

  /// What a model does with contact i, in the lanes `here`.
  template <class Model, bool sample, bool everywhere, class Parameters>
  PHY_HOT ContactForce ask(const Parameters& p, std::size_t first_number, const Kinematics& k, R side,
                           MaskOf<R> here, std::int32_t i, int step, contact::Sums<R>& sums) {
    const auto at = static_cast<std::size_t>(i);
    const contact::Memory<R, everywhere> memory{v.contact + (at * n_contact_fields + c_fields) * W, here};
    const contact::Step<R> now{k, v.contact_const[i].gap, side, lane[l_dt], lane[l_extra_strength]};
    const auto broke = [&](MaskOf<R> in_tension, MaskOf<R> in_shear, R released, int part) {
      record_cracks(in_tension & here, in_shear & here, released, part, step, i);
    };
    return Model::template respond<sample>(p, v.geometry + at * Models::n_geometry + first_number, memory,
                                           now, sums, broke);
  }

  template <bool sample, bool everywhere>
  PHY_HOT ContactForce matrix(const Kinematics& k, MaskOf<R> here, std::int32_t i, int step,
                              contact::Sums<R>& sums) {
    return ask<Matrix, sample, everywhere>(matrix_constants, 0, k, R(0), here, i, step, sums);
  }

  template <bool sample>
  PHY_HOT ContactForce interface(const ContactConst<T>& c, const Kinematics& k, R side, MaskOf<R> here,
                                 std::int32_t i, int step, contact::Sums<R>& sums) {
    const contact::Row<R> p{v.joint + static_cast<std::size_t>(c.joint) * Interface::n_parameters * W};
    return ask<Interface, sample, false>(p, Matrix::n_geometry, k, side, here, i, step, sums);
  }

  /// A contact that is an interface in some lanes: both models, blended lane by lane.
  template <bool sample>
  PHY_HOT ContactForce mixed(const ContactConst<T>& c, const Kinematics& k, std::int32_t i, int step,
                             contact::Sums<R>& sums) {
    const R side = load<R>(v.contact, static_cast<std::size_t>(i) * n_contact_fields + c_side);
    const auto here = abs(side) > R(0);
    if (!any(!here)) return interface<sample>(c, k, side, here, i, step, sums);
    const ContactForce m = matrix<sample, false>(k, !here, i, step, sums);
    const ContactForce j = interface<sample>(c, k, side, here, i, step, sums);
    return {select(here, j.fx, m.fx), select(here, j.fy, m.fy), select(here, j.M, m.M)};
  }

  /// Forces and couples on both grains of a contact.
  template <bool sample>
  PHY_HOT void apply(const ContactConst<T>& c, const Kinematics& k, const ContactForce& push, RowSums& sums) {
    T* a = grain_at(c.a);
    T* b = grain_at(c.b);
    add_to(b, g_fx, push.fx);
    add_to(b, g_fy, push.fy);
    add_to(a, g_fx, -push.fx);
    add_to(a, g_fy, -push.fy);
    const R across = push.fy * k.nx - push.fx * k.ny;
    add_to(a, g_tq, -(k.lever_1 * across + push.M));
    add_to(b, g_tq, push.M - k.lever_2 * across);
    if constexpr (sample) {
      const R size = sqrt(push.fx * push.fx + push.fy * push.fy);
      sums.force += size;
      sums.contacts += select(size > R(0), R(1), R(0));
    }
  }

  template <bool sample>
  void forces_row(int row, int step) {
    RowSums sums;
    if (v.row_touch[row] != v.row_touch[row + 1] || v.row_load[row] != v.row_load[row + 1])
      sums.slip = press_bodies<sample>(row, step);
    const std::int32_t end = v.row_contact[row + 1];
    // The next contact's square root and divisions run while this contact's law is evaluated: one contact is
    // a chain of some 150 cycles, longer than what the processor looks ahead.
    Kinematics ahead =
        v.row_contact[row] < end ? kinematics(v.contact_const[v.row_contact[row]]) : Kinematics{};
    for (std::int32_t i = v.row_contact[row]; i < end; ++i) {
      const Kinematics k = ahead;
      ahead = kinematics(v.contact_const[i + 1 < end ? i + 1 : i]);
      const ContactConst<T>& c = v.contact_const[i];
      if (c.joint < 0) {
        const ContactForce push = matrix<sample, true>(k, R(1) > R(0), i, step, sums);
        apply<sample>(c, k, push, sums);
      } else {
        contact::Sums<R> part;
        const ContactForce push = mixed<sample>(c, k, i, step, part);
        apply<sample>(c, k, push, sums);
        sums.add(part);
      }
    }
    add_to(v.slip, static_cast<std::size_t>(step), sums.slip);
    if constexpr (sample) add_row(sums);
  }

  void add_row(const RowSums& sums) {
    add_sample(v.sample, s_strain_linear, sums.linear);
    add_sample(v.sample, s_strain_bond, sums.bond);
    add_sample(v.sample, s_strain_joint, sums.joint);
    add_sample(v.sample, s_contact_force, sums.force);
    add_sample(v.sample, s_contacts, sums.contacts);
    for (int l = 0; l < static_cast<int>(W); ++l) {
      double& worst = v.sample[s_overlap * static_cast<int>(W) + l];
      const double here = static_cast<double>(NumberTraits<R>::get(sums.overlap, l));
      worst = here > worst || here != here ? here : worst;
    }
  }

  /// Unbalanced force, kinetic energy (mean of both half steps) and strain gauges.
  void sample_grains() {
    for (int row = 0; row < v.n_rows; ++row) {
      R unbalanced(0), kinetic(0), axial(0), lateral(0);
      for (std::int32_t g = v.row_grain[row]; g < v.row_grain[row + 1]; ++g) {
        const T* grain = v.grain + static_cast<std::size_t>(g) * n_grain_fields * W;
        const GrainConst<T>& c = v.grain_const[g];
        const R fx = load<R>(grain, g_fx), fy = load<R>(grain, g_fy);
        unbalanced += sqrt(fx * fx + fy * fy);
        kinetic += kinetic_of(grain, g_fx, g_vx, lane[l_accel] * R(c.inv_area)) +
                   kinetic_of(grain, g_fy, g_vy, lane[l_accel] * R(c.inv_area)) +
                   kinetic_of(grain, g_tq, g_w, lane[l_accel] * R(c.inv_inertia));
        axial -= R(c.gauge_y) * load<R>(grain, g_uy);
        lateral -= R(c.gauge_x) * load<R>(grain, g_ux);
      }
      add_sample(v.sample, s_unbalanced, unbalanced);
      add_sample(v.sample, s_kinetic, kinetic);
      add_sample(v.sample, s_gauge_axial, axial);
      add_sample(v.sample, s_gauge_lateral, lateral);
    }
  }

  /// (m/4)(v_old^2 + v_new^2), with m = dt / scale.
  R kinetic_of(const T* grain, GrainField f, GrainField vel, R scale) const {
    const R old = load<R>(grain, vel);
    const R force = load<R>(grain, f);
    const R now = old + (force - brake_of(force, old, lane[l_damping])) * scale;
    return R(T(0.25)) * (old * old + now * now) * select(scale > R(0), lane[l_dt] / scale, R(0));
  }
};

/// The loop as a kernel (engine/kernels.hpp).
template <class R, class Models>
void advance_block(GroupView<ScalarOf<R>>& view, int n_steps) {
  ForceLoop<R, Models>(view).advance(n_steps);
}

}  // namespace PHY_ISA
}  // namespace phy::engine
