// The hot loop over one specimen that has its group to itself: the lanes hold contacts, W at a time.
//
// A batch is W contacts of one row and one model, in any order (wide_contacts.hpp). What its grains do is
// read grain by grain and turned into lanes (lane_records.hpp), the law is that of every other loop, and the
// forces on both grains are turned back into a record per contact. Nothing has been added to a grain by then:
// that is done afterwards, for the whole row, in the order in which the loop over specimens does it. So are
// the sums. Every number then sees the same operations in the same order: a specimen has the same bits alone,
// in a lane and one contact after the other, and no contacts need to be kept apart because they share a
// grain.
//
// A grain moves as a whole, three components at a time, in registers of four.
#pragma once
#include <type_traits>

#include "base/lane_records.hpp"
#include "engine/row_loop.hpp"
#include "engine/sweep.hpp"

namespace phy::engine {
inline namespace PHY_ISA {

template <class R, class Models>
class WideLoop : public RowLoop<ScalarOf<R>> {
 public:
  using T = ScalarOf<R>;
  using Base = RowLoop<T>;
  using Matrix = typename Models::Matrix;
  using Interface = typename Models::Interface;
  using Kinematics = contact::Kinematics<R>;
  using ContactForce = contact::ContactForce<R>;
  static constexpr std::size_t W = NumberTraits<R>::width;
  static constexpr std::size_t n_contact_fields = c_fields + Models::n_fields;
  static constexpr std::size_t n_constants = n_wide_constants + Models::n_geometry;

  explicit WideLoop(GroupView<T>& view) : Base(view), dt(lane[l_dt]), extra_strength(lane[l_extra_strength]) {
    for (std::size_t i = 0; i < Matrix::n_parameters; ++i) matrix_constants[i] = R(v.matrix[i]);
  }

  void move(int row, int step) {
    if (v.row_grip[row] != v.row_grip[row + 1]) this->hold_grips(row, step);
    T work(0);
    const std::int32_t end = v.row_grain[row + 1];
    const GrainConst<T>* const constants = v.grain_const;
    const Step per{lane[l_accel], lane[l_damping], lane[l_dt]};
    T* grain = this->grain_at(v.row_grain[row]);
    for (std::int32_t g = v.row_grain[row]; g < end; ++g, grain += n_grain_fields) {
      const Four taken = move_grain(grain, constants[g], per);
      work += taken[0], work += taken[1], work += taken[2];
    }
    v.damping[step] += work;
  }

  template <bool sample>
  void forces(int row, int step) {
    RowSums sums;
    sums.slip = this->template slip_of_bodies<sample>(row, step);
    n_slips = 0;
    const WideView<T> w = v.wide;
    const std::int32_t first = w.row_batch[row], end = w.row_batch[row + 1];
    // As in the loop over specimens, a batch's square root and divisions run while the law of the batch
    // before it is evaluated.
    Kinematics ahead = first < end ? kinematics(w, first) : Kinematics{};
    for (std::int32_t batch = first; batch < end; ++batch) {
      const Kinematics k = ahead;
      ahead = kinematics(w, batch + 1 < end ? batch + 1 : batch);
      w.joint[batch] < 0 ? press<sample, true>(w, k, batch, batch - first, step)
                         : press<sample, false>(w, k, batch, batch - first, step);
    }
    push_grains(row);
    if (n_slips > 0) sums.slip = with_slips(sums.slip);
    v.slip[step] += sums.slip;
    if constexpr (sample) this->add_row(with_samples(row, sums));
  }

 private:
  using Base::lane;
  using Base::v;
  using typename Base::RowSums;
  using Four = Pack<T, 4>;
  R dt, extra_strength;
  R matrix_constants[Matrix::n_parameters];
  std::size_t n_slips = 0;  // of the row

  struct Step {
    Four accel, damping, dt;
  };
  /// Returns the work of damping times 2/dt, by component.
  PHY_HOT static Four move_grain(T* grain, const GrainConst<T>& c, const Step& step) {
    static_assert(g_ux == g_fx + 3 && g_vx == g_ux + 3 && n_grain_fields == g_vx + 3);
    const Four force = four(grain + g_fx), place = four(grain + g_ux);
    const auto moving = four(grain + g_vx - 1).v;  // rotation, then velocities
    const Four old = Four::of(__builtin_shufflevector(moving, moving, 1, 2, 3, 3));
    Four inverse;
    __builtin_memcpy(&inverse, &c, sizeof inverse);
    const Four scale = step.accel * Four::of(__builtin_shufflevector(inverse.v, inverse.v, 0, 0, 1, 1));
    const Four brake = brake_of(force, old, step.damping);
    const Four now = old + (force - brake) * scale;
    const Four to = place + now * step.dt;
    const Four none(T(0));
    put(grain + g_fx, __builtin_shufflevector(none.v, to.v, 0, 1, 2, 4));
    put(grain + g_ux, __builtin_shufflevector(to.v, now.v, 0, 1, 2, 4));
    put(grain + g_vx - 1, __builtin_shufflevector(to.v, now.v, 2, 4, 5, 6));
    return brake * (old + now);
  }
  static Four four(const T* at) {
    Four x;
    __builtin_memcpy(&x, at, sizeof x);
    return x;
  }
  static void put(T* at, typename Four::Lanes x) { __builtin_memcpy(at, &x, sizeof x); }

  PHY_HOT Kinematics kinematics(const WideView<T>& w, std::int32_t which) const {
    const auto batch = static_cast<std::size_t>(which);
    return kinematics_of(constants(w.constants + batch * n_constants * W), motion(w.a + batch * W),
                         motion(w.b + batch * W));
  }
  PHY_HOT GrainMotion<R> motion(const std::int32_t* grains) const {
    static_assert(g_w == g_fx + record_size);
    R x[record_size];  // all but the first field
    load_records(v.grain + 1, grains, n_grain_fields, x);
    return {x[g_ux - 1], x[g_uy - 1], x[g_rot - 1], x[g_vx - 1], x[g_vy - 1], x[g_w - 1]};
  }

  struct Constants {
    R X, Y, d0, lever_a, lever_b;
  };
  PHY_HOT static Constants constants(const T* c) {
    return {load<R>(c, wide_X), load<R>(c, wide_Y), load<R>(c, wide_d0), load<R>(c, wide_lever_a),
            load<R>(c, wide_lever_b)};
  }

  /// A batch in a step, and where its sums go.
  struct Place {
    const WideView<T>& w;
    std::size_t batch;
    int step;
    contact::Sums<R>& sums;
  };

  PHY_RARE void record_cracks(MaskOf<R> in_tension, MaskOf<R> in_shear, R released, int part,
                              const Place& place) {
    const std::int32_t* const contacts = place.w.contact + place.batch * W;
    for (int l = 0; l < static_cast<int>(W); ++l) {
      const bool tension = NumberTraits<R>::test(in_tension, l);
      const bool shear = NumberTraits<R>::test(in_shear, l);
      if (tension || shear)
        this->record_crack({place.step, contacts[l], 0, part, shear ? 1 : 0,
                            static_cast<double>(NumberTraits<R>::get(released, l))});
    }
  }

  /// What a model does with the contacts of a batch.
  template <class Model, bool sample, bool everywhere, class Parameters>
  PHY_HOT ContactForce ask(const Parameters& p, const Kinematics& k, R side, MaskOf<R> here,
                           const Place& place) {
    constexpr std::size_t first_number = std::is_same_v<Model, Matrix> ? 0 : Matrix::n_geometry;
    const T* c = place.w.constants + place.batch * n_constants * W;
    const contact::Memory<R, everywhere> memory{
        place.w.state + (place.batch * n_contact_fields + c_fields) * W, here};
    const contact::Step<R> now{k, load<R>(c, wide_gap), side, dt, extra_strength};
    const auto broke = [&](MaskOf<R> in_tension, MaskOf<R> in_shear, R released, int part) {
      record_cracks(in_tension & here, in_shear & here, released, part, place);
    };
    const contact::Given given{p, contact::Row<R>{c + (n_wide_constants + first_number) * W}};
    return Model::template respond<sample>(given, memory, now, place.sums, broke);
  }

  /// Forces of a batch, into the records of its places. `number`: of the batch in its row.
  template <bool sample, bool of_matrix>
  PHY_HOT void press(const WideView<T>& w, const Kinematics& k, std::int32_t which, std::int32_t number,
                     int step) {
    const auto batch = static_cast<std::size_t>(which), place = static_cast<std::size_t>(number) * W;
    contact::Sums<R> sums;
    const Place here{w, batch, step, sums};
    ContactForce push;
    if constexpr (of_matrix) {
      push = ask<Matrix, sample, true>(matrix_constants, k, R(0), R(1) > R(0), here);
    } else {
      const R side = load<R>(w.state, batch * n_contact_fields + c_side);
      const T* row = v.joint + static_cast<std::size_t>(w.joint[batch]) * Interface::n_parameters;
      push = ask<Interface, sample, false>(Alike{row}, k, side, abs(side) > R(0), here);
    }
    keep(k, push, w.push + place * record_size);
    if constexpr (sample) keep_sums(push, sums, place);
    // Most contacts slip by nothing, and adding nothing changes no sum.
    if (const auto slip = !(R(0) >= abs(sums.slip)); any(slip))
      keep_slips(slip, sums.slip, w.contact + batch * W);
  }
  /// Parameters that all contacts of a batch share.
  struct Alike {
    const T* base;
    R operator[](std::size_t i) const { return R(base[i]); }
  };

  /// Forces and couples on grain a, then on grain b. The fourth number meets the displacement that stands
  /// behind the forces of a grain: -0 leaves every number what it is.
  PHY_HOT static void keep(const Kinematics& k, const ContactForce& push, T* records) {
    const R across = push.fy * k.nx - push.fx * k.ny;
    const R nothing(-T(0));
    const R record[record_size] = {-push.fx, -push.fy, -(k.lever_1 * across + push.M), nothing,
                                   push.fx,  push.fy,  push.M - k.lever_2 * across,    nothing};
    store_records(records, record);
  }
  PHY_RARE void keep_slips(MaskOf<R> where, R slip, const std::int32_t* contacts) {
    for (int l = 0; l < static_cast<int>(W); ++l)
      if (NumberTraits<R>::test(where, l))
        v.wide.slips[n_slips++] = {contacts[l], NumberTraits<R>::get(slip, l)};
  }
  /// Adds them in the order of the contacts: those of one model come in order, a few of another stand behind.
  /// (A sort of the library, compiled for one instruction set, might be the one that the linker keeps for
  /// all.)
  PHY_RARE T with_slips(T sum) const {
    ContactSlip<T>* const slips = v.wide.slips;
    for (std::size_t i = 1; i < n_slips; ++i)
      for (std::size_t k = i; k > 0 && slips[k].contact < slips[k - 1].contact; --k) {
        const ContactSlip<T> later = slips[k - 1];
        slips[k - 1] = slips[k], slips[k] = later;
      }
    for (std::size_t i = 0; i < n_slips; ++i) sum += slips[i].work;
    return sum;
  }
  void keep_sums(const ContactForce& push, const contact::Sums<R>& sums, std::size_t place) {
    const auto put_sum = [&](WideSum sum, const R& x) {
      store(v.wide.sums + static_cast<std::size_t>(sum) * v.wide.most_places + place, 0, x);
    };
    put_sum(wide_linear, sums.linear), put_sum(wide_bond, sums.bond), put_sum(wide_joint, sums.joint);
    put_sum(wide_overlap, sums.overlap);
    put_sum(wide_force, sqrt(push.fx * push.fx + push.fy * push.fy));
  }

  /// Forces of a row onto its grains and those below, in the order of the contacts for each of them.
  PHY_HOT void push_grains(int row) const {
    const WideView<T>& w = v.wide;
    for (std::int32_t i = w.row_group[row]; i < w.row_group[row + 1]; ++i) {
      const PushedGrains group = w.group[i];
      switch (group.n_pushes) {
        case 1: push_group<1>(w, group); break;
        case 2: push_group<2>(w, group); break;
        case 3: push_group<3>(w, group); break;
        case 4: push_group<4>(w, group); break;
        default: push_group<0>(w, group);
      }
    }
  }
  /// n: number of pushes where it is known when this is compiled.
  template <int n>
  PHY_HOT void push_group(const WideView<T>& w, const PushedGrains& group) const {
    T* const grains = v.grain + g_fx;
    const T* const push = w.push;
    const int count = n > 0 ? n : group.n_pushes;
    const std::int32_t *pushes = w.pushes + group.first_push, *const end = w.pushed + group.end;
    for (const std::int32_t* grain = w.pushed + group.first; grain < end; ++grain, pushes += count) {
      T* const force = grains + static_cast<std::size_t>(*grain) * n_grain_fields;
      Four sum = four(force);
      for (int i = 0; i < count; ++i) sum += four(push + pushes[i]);
      put(force, sum.v);
    }
  }
  template <class Use>
  void each_of_row(int row, WideSum sum, const Use& use) const {
    const T* of = v.wide.sums + static_cast<std::size_t>(sum) * v.wide.most_places;
    for (std::int32_t i = v.row_contact[row]; i < v.row_contact[row + 1]; ++i) use(of[v.wide.place[i]]);
  }
  PHY_RARE T sum_of(int row, WideSum sum, T start) const {
    each_of_row(row, sum, [&](T x) { start += x; });
    return start;
  }
  PHY_RARE RowSums with_samples(int row, RowSums sums) const {
    sums.linear = sum_of(row, wide_linear, sums.linear);
    sums.bond = sum_of(row, wide_bond, sums.bond);
    sums.joint = sum_of(row, wide_joint, sums.joint);
    sums.force = sum_of(row, wide_force, sums.force);
    each_of_row(row, wide_overlap, [&](T x) { sums.overlap = max(sums.overlap, x); });
    each_of_row(row, wide_force, [&](T x) { sums.contacts += select(x > T(0), T(1), T(0)); });
    return sums;
  }
};

/// The loop as a kernel (engine/kernels.hpp).
template <class R, class Models>
void advance_wide(GroupView<ScalarOf<R>>& view, int n_steps) {
  WideLoop<R, Models> rows(view);
  run_block(view, rows, n_steps);
}

}  // namespace PHY_ISA
}  // namespace phy::engine
