// The matrix of a bonded-particle model: linear contact and parallel bond side by side, each grain pair
// having the first, bonded ones both (Potyondy & Cundall 2004). When a bond breaks the linear contact is
// left. The normal is the branch vector. The laws are in laws/linear and laws/parallel_bond; here is what
// they get: which closure counts from where, and how moduli of the recipe and radii of the packing become
// stiffnesses.
//
//   linear   k_n = E_c f,          f = 1 (pfc31) or 2 r_min/(R1 + R2) (pfc5);   k_s = ks_over_kn k_n
//   bond     kb_n A = E_b lambda 2 r_min/(R1 + R2),   kb_n I = E_b lambda^3 (2/3) r_min^3/(R1 + R2)
//   a unit of thickness throughout; strengths times A = 2 lambda r_min
//
// Where the stiffness is uneven, by directions (direction.hpp) or layers of the bedding, each bonded contact
// has a factor of its own on all its stiffnesses. It depends on how the layers lie, so it is memory of the
// lane, not geometry that lanes share. That costs a field and some operations: it is a model beside the one
// without.
#pragma once
#include "contact/step.hpp"
#include "laws/linear/linear.hpp"
#include "laws/parallel_bond/parallel_bond.hpp"

namespace phy::contact {

class ContactModel;

template <bool uneven>
struct LinearBondWith {
  enum Field {
    shear,           ///< of the linear contact [N/m]
    bond_shear,      ///< [N/m]
    capacity,        ///< tensile capacity sigma_c A [N/m]; 0 = broken or never bonded
    shear_capacity,  ///< tau_c A [N/m]
    excess,          ///< uneven: factor of the stiffness - 1, so that a pair without memory has 1
    n_fields = uneven ? excess + 1 : excess
  };
  enum Parameter { k_n, k_s, inv_k_s, mu, kb_n, kb_s, kb_m, arm, tan_phi, n_parameters };
  enum Geometry {
    linear_factor,  ///< k_n / E_c
    inv_linear_factor,
    bond_factor,  ///< kb_n A / (E_b lambda)
    bend_factor,  ///< kb_n I / (E_b lambda^3) [m^2]
    inv_r_min,    ///< [1/m]
    n_geometry
  };
  static const ContactModel& model();

  template <bool sample, class R, class P, class G, class Memory, class Broke>
  PHY_HOT static ContactForce<R> respond(const Given<P, G>& given, const Memory& memory, const Step<R>& step,
                                         Sums<R>& sums, const Broke& broke) {
    const auto& [p, g] = given;
    const Kinematics<R>& k = step.motion;
    const R d_slide = (k.vy * k.nx - k.vx * k.ny) * step.dt;
    const R d_closure = -((k.vx * k.nx + k.vy * k.ny) * step.dt);
    laws::linear::Parameters<R> pl{p[k_n] * R(g[linear_factor]), p[k_s] * R(g[linear_factor]),
                                   p[inv_k_s] * R(g[inv_linear_factor]), p[mu]};
    [[maybe_unused]] const R factor = uneven ? R(1) + memory.load(excess) : R(1);
    if constexpr (uneven)
      pl.k_n = pl.k_n * factor, pl.k_s = pl.k_s * factor, pl.inv_k_s = pl.inv_k_s / factor;
    laws::linear::State<R> sl{memory.load(shear)};
    const laws::Reaction<R> rl =
        laws::linear::respond(pl, sl, laws::Motion<R>{-(k.stretch + step.gap), d_closure, d_slide, R(0)});
    laws::parallel_bond::Parameters<R> pb{p[kb_n] * R(g[bond_factor]), p[kb_s] * R(g[bond_factor]),
                                          p[kb_m] * R(g[bend_factor]), p[arm] * R(g[inv_r_min]),
                                          memory.load(shear_capacity), p[tan_phi],
                                          step.extra_strength};
    if constexpr (uneven) pb.k_n = pb.k_n * factor, pb.k_s = pb.k_s * factor, pb.k_m = pb.k_m * factor;
    laws::parallel_bond::State<R> sb{memory.load(bond_shear), memory.load(capacity)};
    const laws::Reaction<R> rb =
        laws::parallel_bond::respond(pb, sb, laws::Motion<R>{-k.stretch, d_closure, d_slide, k.rotation});
    memory.store(shear, sl.F_s);
    memory.store(bond_shear, sb.F_s);
    if (any(phy::laws::broke(rb) & memory.here)) {
      memory.store(capacity, sb.capacity);
      broke(rb.broke_tension, rb.broke_shear, rb.released, 0);
    }
    sums.slip += memory.only_here(rl.dissipated, R(0));
    const R F_n = rl.F_n + rb.F_n;
    const R F_s = rl.F_s + rb.F_s;
    if constexpr (sample) {
      sums.linear += memory.only_here(laws::linear::strain_energy(pl, rl.F_n, rl.F_s), R(0));
      sums.bond += memory.only_here(laws::parallel_bond::strain_energy(pb, rb.F_n, rb.F_s, rb.M), R(0));
      sums.overlap = max(sums.overlap, memory.only_here(-(k.stretch + step.gap) * R(g[inv_r_min]), R(0)));
    }
    return {F_n * k.nx - F_s * k.ny, F_n * k.ny + F_s * k.nx, rb.M};
  }
};

using LinearBond = LinearBondWith<false>;
/// With a stiffness that differs from contact to contact.
using UnevenBond = LinearBondWith<true>;

}  // namespace phy::contact
