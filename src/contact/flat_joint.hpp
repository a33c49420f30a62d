// A matrix of flat joints: every contact of a bonded-particle model has an interface of finite length that
// breaks element by element and goes on pressing and resisting rotation where it is broken (Potyondy 2012).
// The law is in laws/flat_joint. Pairs that were never joined are linear contacts of the same stiffness, and
// so is an interface without bonds whose faces have left each other: slid off by their length 2R, or opened
// by as much.
//
//   k_n 2R = E_c lambda 2 r_min/(R1 + R2),   k_s = ks_over_kn k_n,   R = lambda r_min,   strengths times 2R
//   a unit of thickness throughout; the normal is the branch vector
//
// An interface is free of force at the distance that its grains start with, whatever gap or overlap the discs
// have there; one that starts open closes after its own gap.
#pragma once
#include <type_traits>

#include "contact/step.hpp"
#include "laws/flat_joint/flat_joint.hpp"
#include "laws/linear/linear.hpp"

namespace phy::contact {

class ContactModel;

struct FlatJoint {
  static constexpr int most_elements = laws::flat_joint::most_elements;
  enum Field {
    bonds,           ///< 0: linear contact; an interface: 1 + the sum of 2^e over its bonded elements
    shear,           ///< of the linear contact, or of the interface if all of it were bonded [N/m]
    capacity,        ///< tensile capacity sigma_c 2R [N/m]; kept when broken, 0: never bonded
    shear_capacity,  ///< cohesion times 2R [N/m]
    start_gap,       ///< of an interface that starts open [m]
    element_shear,   ///< of its elements that are not bonded [N/m]
    n_fields = element_shear + most_elements
  };
  enum Parameter {
    k_n,
    k_s,
    inv_k_s,
    lambda,
    mu,
    tan_phi,
    edge,
    share,  ///< 1/N
    whole,  ///< `bonds` of an interface without any crack, 2^N
    n_parameters
  };
  enum Geometry {
    factor,  ///< k_n 2R / (E_c lambda)
    inv_factor,
    r_min,      ///< [m]
    inv_r_min,  ///< [1/m]
    elements,   ///< N
    n_geometry
  };
  static const ContactModel& model();

  template <int N>
  using Elements = std::integral_constant<int, N>;
  /// Calls `use` for the number of elements of this contact, a constant then: what is asked of few contacts
  /// is compiled for every number, the loop over all of them once.
  template <class G, class Use>
  static void of_elements(const G& g, const Use& use) {
    const auto n = static_cast<int>(of_all(g[elements]));
    n == 1   ? use(Elements<1>{})
    : n == 2 ? use(Elements<2>{})
    : n == 3 ? use(Elements<3>{})
             : use(Elements<4>{});
  }

  template <class R, class P, class G>
  PHY_HOT static laws::flat_joint::Parameters<R> law(const P& p, const G& g, R capacity, R S_0,
                                                     R extra_strength) {
    return {p[k_n] * R(g[factor]),
            p[k_s] * R(g[factor]),
            p[inv_k_s] * R(g[inv_factor]),
            p[lambda] * R(g[r_min]),
            p[mu],
            S_0,
            p[tan_phi],
            p[edge],
            capacity,
            extra_strength};
  }

  template <bool sample, class R, class P, class G, class Memory, class Broke>
  PHY_HOT static ContactForce<R> respond(const Given<P, G>& given, const Memory& memory, const Step<R>& step,
                                         Sums<R>& sums, const Broke& broke) {
    const auto& [p, g] = given;
    const Kinematics<R>& k = step.motion;
    const R d_slide = (k.vy * k.nx - k.vx * k.ny) * step.dt, before = memory.load(shear);
    const laws::flat_joint::Parameters<R> pf =
        law<R>(p, g, memory.load(capacity), memory.load(shear_capacity), step.extra_strength);
    const laws::linear::Parameters<R> pl{pf.k_n, pf.k_s, pf.inv_k_s, pf.mu};
    laws::linear::State<R> sl{before};
    const laws::Motion<R> touching{-(k.stretch + step.gap), R(0), d_slide, R(0)};
    const laws::Motion<R> joined{-k.stretch, -(k.vx * k.nx + k.vy * k.ny) * step.dt, d_slide, k.rotation,
                                 k.spin * step.dt};
    laws::Reaction<R> r = laws::linear::respond(pl, sl, touching);
    const R code = memory.load(bonds), slid = before - pf.k_s * d_slide;
    const MaskOf<R> interface = memory.here & (code > R(0));
    const laws::Reaction<R> bond = laws::flat_joint::respond_whole(pf, slid, joined);
    r.F_n = select(interface, bond.F_n, r.F_n), r.F_s = select(interface, bond.F_s, r.F_s);
    r.M = select(interface, bond.M, r.M), r.dissipated = select(interface, R(0), r.dissipated);
    memory.store(shear, r.F_s);
    const MaskOf<R> holds = laws::flat_joint::holds(pf, pf.half_length * p[share], slid, joined);
    const MaskOf<R> at_rest = (!interface) | ((code >= p[whole]) & holds);
    if (any(!at_rest))
      of_elements(g, [&]<int N>(Elements<N>) {
        broken<N, R>(pf, memory, {joined, touching.closure, at_rest}, r, broke);
      });
    sums.slip += memory.only_here(r.dissipated, R(0));
    if constexpr (sample) {
      of_elements(g, [&]<int N>(Elements<N>) { add_energy<N, R>(pf, memory, joined, r, sums); });
      sums.overlap = max(sums.overlap, memory.only_here(touching.closure * R(g[inv_r_min]), R(0)));
    }
    return {r.F_n * k.nx - r.F_s * k.ny, r.F_n * k.ny + r.F_s * k.nx, r.M};
  }

 private:
  template <class R>
  using Law = laws::flat_joint::Parameters<R>;
  template <class R, int N>
  using State = laws::flat_joint::State<R, N>;

  template <int N, class R, class Memory>
  static State<R, N> state(const Memory& memory) {
    State<R, N> s{memory.load(bonds) - R(1), memory.load(shear), {}};
    for (std::size_t e = 0; e < std::size_t{N}; ++e) s.S[e] = memory.load(element_shear + e);
    return s;
  }

  /// How an interface moves, and the discs that have it.
  template <class R>
  struct Moved {
    laws::Motion<R> m;
    R disc_closure;     ///< of the discs' own surfaces [m]
    MaskOf<R> at_rest;  ///< lanes that are done already
  };

  /// Interfaces that have broken elements, or get some in this step: not `at_rest`.
  template <int N, class R, class Memory, class Broke>
  PHY_RARE static void broken(const Law<R>& p, const Memory& memory, Moved<R> now, laws::Reaction<R>& r,
                              const Broke& broke) {
    now.m.closure = now.m.closure - memory.load(start_gap);
    State<R, N> s = state<N, R>(memory);
    const R slid = s.shear;
    laws::flat_joint::Cracks<R, N> cracks;
    laws::flat_joint::by_elements<N, R>(p, s, {now.m, now.at_rest}, r, cracks);
    for (int e = 0; cracks.some && e < N; ++e)
      if (any((cracks.tension[e] | cracks.shear[e]) & memory.here))
        broke(cracks.tension[e], cracks.shear[e], cracks.released[e], e);
    const R length = p.half_length + p.half_length;
    const MaskOf<R> apart = (abs(slid) > p.k_s * length) | (now.m.closure < -length);
    const MaskOf<R> leaves = (!now.at_rest) & (s.bonds < R(1)) & apart;
    if (any(leaves)) leave<N, R>(p, s, now, leaves, r);
    memory.store(bonds, select(leaves, R(0), s.bonds + R(1)));
    memory.store(shear, select(leaves, r.F_s, slid));
    for (std::size_t e = 0; e < std::size_t{N}; ++e)
      memory.store(element_shear + e, select(leaves, R(0), s.S[e]));
  }

  /// From now on a linear contact: what the interface held beyond that is lost as to slip.
  template <int N, class R>
  PHY_RARE static void leave(const Law<R>& p, const State<R, N>& s, const Moved<R>& moved, MaskOf<R> leaves,
                             laws::Reaction<R>& r) {
    const laws::linear::Parameters<R> linear{p.k_n, p.k_s, p.inv_k_s, p.mu};
    laws::linear::State<R> left{r.F_s};
    const laws::Reaction<R> now =
        laws::linear::respond(linear, left, laws::Motion<R>{moved.disc_closure, R(0), R(0), R(0)});
    const R lost = laws::flat_joint::strain_energy<N, R>(p, s, moved.m) -
                   laws::linear::strain_energy(linear, now.F_n, now.F_s);
    r.dissipated = r.dissipated + select(leaves, lost, R(0));
    r.F_n = select(leaves, now.F_n, r.F_n), r.F_s = select(leaves, now.F_s, r.F_s);
    r.M = select(leaves, R(0), r.M);
  }

  template <int N, class R, class Memory>
  PHY_RARE static void add_energy(const Law<R>& p, const Memory& memory, laws::Motion<R> m,
                                  const laws::Reaction<R>& r, Sums<R>& sums) {
    const State<R, N> s = state<N, R>(memory);
    const MaskOf<R> interface = memory.here & (memory.load(bonds) > R(0));
    m.closure = m.closure - memory.load(start_gap);
    const R joined = laws::flat_joint::strain_energy<N, R>(p, s, m);
    const laws::linear::Parameters<R> linear{p.k_n, p.k_s, p.inv_k_s, p.mu};
    const R touching = laws::linear::strain_energy(linear, r.F_n, r.F_s);
    sums.bond += select(interface, joined, R(0));
    sums.linear += memory.only_here(select(interface, R(0), touching), R(0));
  }
};

}  // namespace phy::contact
