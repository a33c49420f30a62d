// Settling: discs without friction between four smooth walls, moved until the forces of their overlaps
// balance.
//
// Overlapping discs push each other with linear springs, so settling is the search for a minimum of the
// elastic energy. It is done with FIRE (Bitzek et al. 2006, Phys. Rev. Lett. 97:170201), in the form of
// Guenole et al. 2020 (Comput. Mater. Sci. 175:109584): damped motion of unit masses whose velocity is
// steered towards the force and which stops and steps back whenever it runs uphill. Near equilibrium it needs
// about as many steps as conjugate gradients. Forces are in units of the contact modulus E_c: a spring has
// the stiffness K_n / E_c, 1 between discs with pfc31. Rejected: Newton's method with a sparse factorisation
// (fewer iterations, but a linear-algebra library does not give the same bits on every instruction set),
// growing from half the radii (Potyondy & Cundall 2004; the discs may overlap freely at the start of a
// minimisation, so growing only costs time). Tried at 50,000 discs: steering tile by tile takes more steps;
// taking long waves out on a coarse grid takes hardly fewer down to 1e-4, where single discs that slip are
// waited for. Discs placed without long waves (placement.hpp) save more.
#pragma once
#include <functional>
#include <stdexcept>
#include <vector>

#include "records/specimen.hpp"

namespace phy::genesis {

/// A wish to stop has come while discs were moved.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("stopped while a packing was made: nothing was written") {}
};

/// The box and the springs in it.
struct SettleBox {
  double width = 0.0;   ///< [m]
  double height = 0.0;  ///< [m]
  StiffnessConvention stiffness = StiffnessConvention::pfc31;
  std::function<bool()> stop = {};  ///< asked now and then; true: settle() throws Interrupted
};

/// State of a settled (or not settled) assembly.
struct Equilibrium {
  double unbalanced = 0.0;    ///< mean unbalanced force / mean contact force
  double pressure = 0.0;      ///< mean stress / E_c
  double stiffness = 0.0;     ///< sum of K_n l^2 / E_c over all contacts, l = R1 + R2 (walls: R) [m^2]
  double mean_overlap = 0.0;  ///< over contacts between discs [m]
  long n_contacts = 0;        ///< between discs
  long n_iterations = 0;
  bool loose = false;  ///< forces have vanished: the discs do not fill the box
};

/// Moves the discs (never their radii) until `unbalanced` <= tolerance, the forces vanish (mean contact force
/// below E_c * loose_overlap [m]), or max_iterations. max_iterations = 0 only measures.
Equilibrium settle(const SettleBox& box, std::vector<Disc>& discs, double tolerance, double loose_overlap,
                   long max_iterations);

/// Relative change of all radii that changes the mean stress by d_stress if the centres stay where they are:
/// alpha = D V d_stress / sum(K_n l^2), D = 2 (Potyondy & Cundall 2004, specimen genesis). Exact for a
/// lattice that just touches. Stress and stiffness in the same unit of modulus; volume [m^2 per m].
double radius_change(double volume, double d_stress, double stiffness);

}  // namespace phy::genesis
