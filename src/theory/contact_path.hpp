// What a contact must answer to a path of straight legs, solved leg by leg instead of stepped: the witness
// beside `phyllite contact` and the laws' tests. On a straight leg closure, slide and rotation grow in
// proportion to lambda = 0 ... 1, so every force is linear in lambda between events, and the events (touch,
// slip, opening, breakage) are roots of linear functions:
//
//   stick   F_n' = k_n c',  F_s' = -k_s s'                      ' = d/d lambda; c closure, s slide
//   slip in direction q = +-1 (F_s = -q mu F_n):                 p = plastic slip, dilation' = p' tan(psi)
//           p' = (k_s q s' - mu k_n c')/(k_s + mu k_n tan(psi)),  F_n' = k_n (c' + p' tan(psi))
//   break   tension: arm |M| - F_n = capacity;  shear: |F_s| = S_0 + F_n tan(phi); the first of them
//           a joint that breaks in shear drops at once to F_s = mu F_n by the slip
//           p = (|F_s| - mu F_n)/(k_s + mu k_n tan(psi))
//
// The linear contact is the broken joint without dilation. Derived from Coulomb's law and springs in series
// with a slider; nothing is shared with laws/. Signs as everywhere: compression, closure positive; F_s on
// grain 2 along t. Sources: Cundall & Strack 1979, Potyondy & Cundall 2004, Mas Ivars et al. 2011.
#pragma once
#include "records/contact_path.hpp"

namespace phy::theory {

/// Springs with a Coulomb slider that may dilate.
struct Slider {
  double k_n = 0.0, k_s = 0.0;  ///< [N/m per m]
  double mu = 0.0;              ///< [-]
  double tan_psi = 0.0;         ///< dilation [-], <= mu
  double gap_closed = 0.0;      ///< closure with dilation [m]: F_n = k_n times its positive part
  double F_s = 0.0;             ///< [N/m]
  int slips = 0;                ///< direction q of the slip at the end of the last leg, or 0

  void leg(double closure, double slide);
  ContactForces forces() const { return {gap_closed > 0.0 ? k_n * gap_closed : 0.0, F_s, 0.0}; }

 private:
  double touch(double closure, double left);
  double open(double closure, double slip_rate, double left);
};

/// A bond: three springs and two strengths; breaks for good.
struct Cement {
  double k_n = 0.0, k_s = 0.0;  ///< [N/m per m]
  double k_m = 0.0;             ///< [N]
  double arm = 0.0;             ///< [1/m]
  double S_0 = 0.0;             ///< [N/m]
  double tan_phi = 0.0;         ///< [-]
  double capacity = 0.0;        ///< [N/m]; 0: broken
  ContactPoint at;

  enum class Breakage { none, tension, shear };
  /// Goes on by `step` or to where it breaks; `done` is the fraction of the leg gone.
  Breakage leg(ContactPoint step, double& done);
  ContactForces forces() const;
};

/// The linear contact, with dashpots if c_n or c_s is not 0.
struct ExactLinear {
  Slider slider;
  double c_n = 0.0, c_s = 0.0;  ///< [N s/m per m]
  bool no_tension = false, cut_while_slipping = false;
  ContactForces viscous;
  /// One straight leg at constant speed; `seconds` matters to dashpots only.
  void leg(ContactPoint step, double seconds);
  ContactForces forces() const;
};
/// The parallel bond alone.
struct ExactBond {
  Cement cement;
  void leg(ContactPoint step, double seconds);
  ContactForces forces() const { return cement.forces(); }
};
/// The smooth joint: cement until it breaks, slider from then on.
struct ExactJoint {
  Cement cement;
  Slider slider;
  void leg(ContactPoint step, double seconds);
  ContactForces forces() const { return cement.capacity > 0.0 ? cement.forces() : slider.forces(); }
};

}  // namespace phy::theory
