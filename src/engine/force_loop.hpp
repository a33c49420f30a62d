// The hot loop over specimens in lanes: motion and forces, row by row. One cycle is
//
//   motion   v(t+dt/2) = v(t-dt/2) + dt (F + F_damp)/m,   u(t+dt) = u(t) + dt v(t+dt/2)
//   forces   gap and normal from displacements, increments from velocities, laws, forces on both grains
//
// Cycles and rows take turns as sweep.hpp has it.
#pragma once
#include <type_traits>

#include "engine/row_loop.hpp"
#include "engine/sweep.hpp"

namespace phy::engine {
inline namespace PHY_ISA {

/// The loop over one group, with the lane constants at hand. Models: a combination of contact models
/// (contact/models.hpp), folded in at compile time.
template <class R, class Models>
class ForceLoop : public RowLoop<R> {
 public:
  using Base = RowLoop<R>;
  using typename Base::T;
  using Matrix = typename Models::Matrix;
  using Interface = typename Models::Interface;
  using Kinematics = contact::Kinematics<R>;
  using ContactForce = contact::ContactForce<R>;
  static constexpr std::size_t W = Base::W;
  static constexpr std::size_t n_contact_fields = c_fields + Models::n_fields;

  explicit ForceLoop(GroupView<T>& view) : Base(view) {
    for (std::size_t i = 0; i < Matrix::n_parameters; ++i) matrix_constants[i] = load<R>(v.matrix, i);
  }

  void move(int row, int step) {
    if (v.row_grip[row] != v.row_grip[row + 1]) this->hold_grips(row, step);
    R work(0);
    for (std::int32_t g = v.row_grain[row]; g < v.row_grain[row + 1]; ++g) {
      T* grain = this->grain_at(g);
      const GrainConst<T>& c = v.grain_const[g];
      const R linear = lane[l_accel] * R(c.inv_area);
      const R angular = lane[l_accel] * R(c.inv_inertia);
      const R alpha = lane[l_damping];
      work += move_component(grain, {g_fx, g_vx, g_ux}, linear, alpha);
      work += move_component(grain, {g_fy, g_vy, g_uy}, linear, alpha);
      work += move_component(grain, {g_tq, g_w, g_rot}, angular, alpha);
    }
    add_to(v.damping, static_cast<std::size_t>(step), work);
  }

  template <bool sample>
  void forces(int row, int step) {
    RowSums sums;
    sums.slip = this->template slip_of_bodies<sample>(row, step);
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
        const ContactForce push = matrix<sample, true>(k, R(1) > R(0), {i, step, sums});
        apply<sample>(c, k, push, sums);
      } else {
        contact::Sums<R> part;
        const ContactForce push = mixed<sample>(c, k, {i, step, part});
        apply<sample>(c, k, push, sums);
        sums.add(part);
      }
    }
    add_to(v.slip, static_cast<std::size_t>(step), sums.slip);
    if constexpr (sample) this->add_row(sums);
  }

 private:
  using Base::lane;
  using Base::v;
  using typename Base::RowSums;
  R matrix_constants[Matrix::n_parameters];

  /// One component of motion; returns the damping work times 2/dt.
  struct Component {
    GrainField force, velocity, displacement;
  };
  R move_component(T* grain, Component of, R scale, R alpha) const {
    const R force = load<R>(grain, of.force);
    const R old = load<R>(grain, of.velocity);
    const R brake = brake_of(force, old, alpha);
    const R now = old + (force - brake) * scale;
    store(grain, of.velocity, now);
    store(grain, of.displacement, load<R>(grain, of.displacement) + now * lane[l_dt]);
    store(grain, of.force, R(0));
    return brake * (old + now);
  }

  PHY_HOT Kinematics kinematics(const ContactConst<T>& c) const {
    return kinematics_of(c, motion(c.a), motion(c.b));
  }
  PHY_HOT GrainMotion<R> motion(std::int32_t g) const {
    const T* grain = this->grain_at(g);
    return {load<R>(grain, g_ux), load<R>(grain, g_uy), load<R>(grain, g_rot),
            load<R>(grain, g_vx), load<R>(grain, g_vy), load<R>(grain, g_w)};
  }

  /// A contact in a step, and where its sums go.
  struct Place {
    std::int32_t contact;
    int step;
    contact::Sums<R>& sums;
  };

  PHY_RARE void record_cracks(MaskOf<R> in_tension, MaskOf<R> in_shear, R released, int part,
                              const Place& place) {
    for (int l = 0; l < static_cast<int>(W); ++l) {
      const bool tension = NumberTraits<R>::test(in_tension, l);
      const bool shear = NumberTraits<R>::test(in_shear, l);
      if (tension || shear)
        this->record_crack({place.step, place.contact, l, part, shear ? 1 : 0,
                            static_cast<double>(NumberTraits<R>::get(released, l))});
    }
  }

  /// What a model does with a contact, in the lanes `here`.
  template <class Model, bool sample, bool everywhere, class Parameters>
  PHY_HOT ContactForce ask(const Parameters& p, const Kinematics& k, R side, MaskOf<R> here,
                           const Place& place) {
    const auto at = static_cast<std::size_t>(place.contact);
    constexpr std::size_t first_number = std::is_same_v<Model, Matrix> ? 0 : Matrix::n_geometry;
    const contact::Memory<R, everywhere> memory{v.contact + (at * n_contact_fields + c_fields) * W, here};
    const contact::Step<R> now{k, R(v.contact_const[place.contact].gap), side, lane[l_dt],
                               lane[l_extra_strength]};
    const auto broke = [&](MaskOf<R> in_tension, MaskOf<R> in_shear, R released, int part) {
      record_cracks(in_tension & here, in_shear & here, released, part, place);
    };
    const contact::Given given{p, v.geometry + at * Models::n_geometry + first_number};
    return Model::template respond<sample>(given, memory, now, place.sums, broke);
  }

  template <bool sample, bool everywhere>
  PHY_HOT ContactForce matrix(const Kinematics& k, MaskOf<R> here, const Place& place) {
    return ask<Matrix, sample, everywhere>(matrix_constants, k, R(0), here, place);
  }

  template <bool sample>
  PHY_HOT ContactForce interface(const ContactConst<T>& c, const Kinematics& k, R side, MaskOf<R> here,
                                 const Place& place) {
    const contact::Row<R> p{v.joint + static_cast<std::size_t>(c.joint) * Interface::n_parameters * W};
    return ask<Interface, sample, false>(p, k, side, here, place);
  }

  /// A contact that is an interface in some lanes: both models, blended lane by lane.
  template <bool sample>
  PHY_HOT ContactForce mixed(const ContactConst<T>& c, const Kinematics& k, const Place& place) {
    const R side = load<R>(v.contact, static_cast<std::size_t>(place.contact) * n_contact_fields + c_side);
    const auto here = abs(side) > R(0);
    if (!any(!here)) return interface<sample>(c, k, side, here, place);
    const ContactForce m = matrix<sample, false>(k, !here, place);
    const ContactForce j = interface<sample>(c, k, side, here, place);
    return {select(here, j.fx, m.fx), select(here, j.fy, m.fy), select(here, j.M, m.M)};
  }

  /// Forces and couples on both grains of a contact.
  template <bool sample>
  PHY_HOT void apply(const ContactConst<T>& c, const Kinematics& k, const ContactForce& push, RowSums& sums) {
    T* a = this->grain_at(c.a);
    T* b = this->grain_at(c.b);
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
};

/// The loop as a kernel (engine/kernels.hpp).
template <class R, class Models>
void advance_block(GroupView<ScalarOf<R>>& view, int n_steps) {
  ForceLoop<R, Models> rows(view);
  run_block(view, rows, n_steps);
}

}  // namespace PHY_ISA
}  // namespace phy::engine
