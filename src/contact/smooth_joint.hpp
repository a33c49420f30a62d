// A bedding plane as one contact sees it: a smooth joint (Mas Ivars et al. 2011), bonded or broken, whose
// normal is that of the plane and stays. It carries no couple, and grains may slide into each other along it.
// The law is in laws/smooth_joint; stiffnesses and strengths of the recipe are per area, A = 2 lambda r_min
// per unit of thickness.
#pragma once
#include "contact/step.hpp"
#include "laws/smooth_joint/smooth_joint.hpp"

namespace phy::contact {

class ContactModel;

struct SmoothJoint {
  enum Field {
    shear,     ///< [N/m]
    closure,   ///< since the joint was made, without dilation [m]
    capacity,  ///< tensile capacity sigma_n A [N/m]; 0 = broken
    dilation,  ///< opening pushed by dilation so far [m]
    n_fields
  };
  enum Parameter { nx, ny, k_n, k_s, mu, tan_phi, tan_psi, S_0, n_parameters };
  enum Geometry { area, n_geometry };  ///< 2 r_min [m^2 per m]; lambda is in the parameters
  static const ContactModel& model();

  template <bool sample, class R, class P, class G, class Memory, class Broke>
  PHY_HOT static ContactForce<R> respond(const Given<P, G>& given, const Memory& memory, const Step<R>& step,
                                         Sums<R>& sums, const Broke& broke) {
    const auto& [p, g] = given;
    const Kinematics<R>& k = step.motion;
    const R normal_x = step.side * p[nx];
    const R normal_y = step.side * p[ny];
    const R dt = step.dt;
    const laws::Motion<R> m{R(0), -((k.vx * normal_x + k.vy * normal_y) * dt),
                            (k.vy * normal_x - k.vx * normal_y) * dt, R(0)};
    const R A(g[area]);
    const laws::smooth_joint::Parameters<R> law{p[k_n] * A, p[k_s] * A,         p[mu], p[S_0] * A, p[tan_phi],
                                                p[tan_psi], step.extra_strength};
    // Lanes without a joint here pass as bonded, or their broken bonds would call the law's rare branches.
    const R holds = select(memory.here, memory.load(capacity), R(1));
    laws::smooth_joint::State<R> st{memory.load(shear), memory.load(closure), holds, memory.load(dilation)};
    const laws::Reaction<R> r = laws::smooth_joint::respond(law, st, m);
    memory.store(shear, st.F_s);
    memory.store(closure, st.closure);
    memory.store(dilation, st.dilation);
    if (any(phy::laws::broke(r) & memory.here)) {
      memory.store(capacity, st.capacity);
      broke(r.broke_tension, r.broke_shear, r.released, 0);
    }
    sums.slip += memory.only_here(r.dissipated, R(0));
    if constexpr (sample)
      sums.joint += memory.only_here(laws::smooth_joint::strain_energy(law, r.F_n, r.F_s), R(0));
    return {r.F_n * normal_x - r.F_s * normal_y, r.F_n * normal_y + r.F_s * normal_x, R(0)};
  }
};

}  // namespace phy::contact
