// The hot side of a contact model: what the force loop hands over for every contact in every step, and what
// it gets back. Compiled once per instruction set, always inlined.
//
// A model of the hot side is a struct of compile-time constants and one function:
//
//   enum Field      ..., n_fields       lane vectors of memory that each contact has
//   enum Parameter  ..., n_parameters   lane vectors of a row of parameters (ContactModel::parameters)
//   enum Geometry   ..., n_geometry     numbers of each contact in all lanes (ContactModel::geometry)
//   static const ContactModel& model();                                   its cold side
//
//   template <bool sample, class R, class P, class G, class Memory, class Broke>
//   static ContactForce<R> respond(const Given<P, G>& given, const Memory& memory, const Step<R>& step,
//                                  Sums<R>& sums, const Broke& broke);
//
// It is asked for every pair in the list, in all lanes, also where the grains are far apart: forces and
// fields have to be zero there. p[i], g[i] and memory.load(i) are a parameter, a number of the geometry and a
// field; a number of the geometry is one for all lanes where they hold specimens, one per lane where they
// hold contacts of one specimen (engine/wide_loop.hpp): R(g[i]) is right for both. `respond` turns the
// kinematics into the motion of its laws, stores its memory, adds to the sums (energies only where `sample`;
// to each once at most, or the order of additions would not be the same in all loops) and reports what broke:
// broke(tension, shear, released, part), at most once per part and ContactModel::Size::cracks times in the
// life of a contact. A contact that breaks as one has one part, number 0.
#pragma once
#include "base/lane_memory.hpp"

namespace phy::contact {
inline namespace PHY_ISA {

/// What a contact's two grains 1 and 2 do, in the frame of the branch vector from centre 1 to centre 2.
template <class R>
struct Kinematics {
  R nx, ny;            ///< unit branch vector
  R stretch;           ///< growth of the distance of the centres since the start [m]
  R vx, vy;            ///< velocity of 2 against 1 at the contact point [m/s]
  R lever_1, lever_2;  ///< from the centres to the contact point [m]
  R rotation;          ///< of 2 against 1 since the start [rad]
  R spin;              ///< its rate [rad/s]
};

template <class R>
struct Step {
  const Kinematics<R>& motion;  ///< by reference: a copy would be written to the stack
  R gap;                        ///< approach needed before the grains themselves press on each other [m]
  R side;       ///< interfaces: +1 where the plane's normal points from 1 to 2, else -1; 0: no interface here
  const R& dt;  ///< [s]
  const R& extra_strength;  ///< added to all strengths [N/m]: 0, or huge while breakage is switched off
};

/// On grain 2; grain 1 gets the opposite force.
template <class R>
struct ContactForce {
  R fx, fy;  ///< [N/m]
  R M;       ///< couple at the contact point [N]
};

/// What a specimen sums over its contacts. The energies are the columns of the history that a model adds to.
template <class R>
struct Sums {
  R slip = R(0);                               ///< work of slip in this step [J/m]
  R linear = R(0), bond = R(0), joint = R(0);  ///< strain energy of grains, cement, interfaces [J/m]
  R overlap = R(0);                            ///< the largest, of the smaller radius; not across interfaces
  void add(const Sums& p) {
    slip += p.slip, linear += p.linear, bond += p.bond, joint += p.joint;
    overlap = max(overlap, p.overlap);
  }
};

/// Memory of a contact in the lanes where a model has its say. `everywhere`: in all, so nothing is masked.
template <class R, bool everywhere>
struct Memory {
  ScalarOf<R>* base;
  MaskOf<R> here;
  R load(std::size_t field) const { return phy::load<R>(base, field); }
  void store(std::size_t field, R now) const { phy::store(base, field, only_here(now, load(field))); }
  R only_here(R now, R before) const {
    if constexpr (everywhere) return now;
    return select(here, now, before);
  }
};

/// Lane vectors that stay in memory: a row of parameters, numbers of the geometry.
template <class R>
struct Row {
  const ScalarOf<R>* base;
  R operator[](std::size_t i) const { return phy::load<R>(base, i); }
};

/// What a contact is, apart from its memory: a row of parameters, and the numbers of its geometry.
template <class P, class G>
struct Given {
  const P& p;
  G g;
};
template <class P, class G>
Given(const P&, G) -> Given<P, G>;

/// A number of the geometry that is the same for all contacts of a specimen.
template <class T>
T of_all(T number) {
  return number;
}
template <class T, int W>
T of_all(const Pack<T, W>& number) {
  return number[0];
}

}  // namespace PHY_ISA
}  // namespace phy::contact
