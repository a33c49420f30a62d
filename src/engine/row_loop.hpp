// What the loops over rows have in common, over the number type R of the specimens in their lanes: grains,
// the boundary, sums, the kinematics of a contact.
//
// Gap without cancellation, also in single precision: with X the initial branch vector (length d0) and u the
// relative displacement, q = 2 X.u + u.u, d = sqrt(d0^2 + q), and the stretch d - d0 = q/(d + d0).
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

/// How a grain lies and moves.
template <class R>
struct GrainMotion {
  R ux, uy, rotation, vx, vy, w;
};

/// `c`: constants of the contact, in all lanes alike or not.
template <class R, class Constants>
PHY_HOT inline contact::Kinematics<R> kinematics_of(const Constants& c, const GrainMotion<R>& a,
                                                    const GrainMotion<R>& b) {
  using T = ScalarOf<R>;
  constexpr T closest = T(1e-4);  // of (distance of two centres / that at the start)^2
  const R dux = b.ux - a.ux;
  const R duy = b.uy - a.uy;
  const R q = R(2) * (R(c.X) * dux + R(c.Y) * duy) + (dux * dux + duy * duy);
  // Interfaces let grains slide into each other, until their centres meet: there the branch has no
  // direction (its normal fades to zero) and the interface, which has its own, does not need one.
  const R d = sqrt(max(R(c.d0 * c.d0) + q, R(c.d0 * c.d0 * closest)));
  contact::Kinematics<R> k;
  const R inv_d = R(1) / d;
  k.stretch = q / (d + R(c.d0));
  k.nx = (R(c.X) + dux) * inv_d;
  k.ny = (R(c.Y) + duy) * inv_d;
  k.lever_1 = R(c.lever_a) + R(T(0.5)) * k.stretch;
  k.lever_2 = R(c.lever_b) + R(T(0.5)) * k.stretch;
  const R roll = a.w * k.lever_1 + b.w * k.lever_2;
  k.vx = b.vx - a.vx + roll * k.ny;
  k.vy = b.vy - a.vy - roll * k.nx;
  k.rotation = b.rotation - a.rotation;
  k.spin = b.w - a.w;
  return k;
}

/// -F_damp: the force of local damping against the motion.
template <class R>
PHY_HOT inline R brake_of(R force, R velocity, R alpha) {
  const R size = alpha * abs(force);
  return select(velocity > R(0), size, select(velocity < R(0), -size, R(0)));
}

template <class R>
class RowLoop {
 public:
  using T = ScalarOf<R>;
  static constexpr std::size_t W = NumberTraits<R>::width;

  explicit RowLoop(GroupView<T>& view) : v(view) {
    for (std::size_t i = 0; i < n_lane_fields; ++i) lane[i] = load<R>(v.lane, i);
  }

  void balance(int step) { BodyLoop<R>(v, lane).balance(step); }
  /// At the end of a block, after its last cycle `step`.
  void sample(int step) {
    for (int row = 0; row < v.n_rows; ++row) BodyLoop<R>(v, lane).collect(row, step);
    sample_grains();
  }

 protected:
  GroupView<T>& v;
  R lane[n_lane_fields];

  // The boundary (body_loop.hpp), out of the way of the loop over contacts.
  PHY_RARE void hold_grips(int row, int step) { BodyLoop<R>(v, lane).hold(row, step); }
  template <bool sample>
  PHY_RARE R press_bodies(int row, int step) {
    return BodyLoop<R>(v, lane).template press<sample>(row, step);
  }
  /// Slip work of bodies on grains of the row.
  template <bool sample>
  PHY_HOT R slip_of_bodies(int row, int step) {
    const bool some = v.row_touch[row] != v.row_touch[row + 1] || v.row_load[row] != v.row_load[row + 1];
    return some ? press_bodies<sample>(row, step) : R(0);
  }

  T* grain_at(std::int32_t g) const { return v.grain + static_cast<std::size_t>(g) * n_grain_fields * W; }

  /// Sums of one row.
  struct RowSums : contact::Sums<R> {
    R force = R(0), contacts = R(0);
  };

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

  PHY_RARE void record_crack(const RawCrack& crack) {
    if (v.n_cracks < v.max_cracks) v.cracks[v.n_cracks] = crack;
    ++v.n_cracks;
  }

 private:
  /// Unbalanced force, kinetic energy (mean of both half steps) and strain gauges.
  void sample_grains() {
    for (int row = 0; row < v.n_rows; ++row) {
      R unbalanced(0), kinetic(0), axial(0), lateral(0);
      for (std::int32_t g = v.row_grain[row]; g < v.row_grain[row + 1]; ++g) {
        const T* grain = grain_at(g);
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

}  // namespace PHY_ISA
}  // namespace phy::engine
