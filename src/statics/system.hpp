// The linear system of a network: K u = f with any degree of freedom prescribed or loaded.
//
// K is symmetric and, with loose bodies held by weak springs (rigidity.hpp), positive definite
// (sparse_cholesky.hpp). The order of elimination (approximate minimum degree on the graph of bodies, three
// unknowns each) and the place of every coefficient depend on who touches whom only, so one StiffnessSystem
// serves all bedding angles and all parameters of a packing. Rejected: conjugate gradients (in two dimensions
// the factor is small, and sensitivities want many right-hand sides).
#pragma once
#include <vector>

#include "records/elastic.hpp"
#include "statics/network.hpp"
#include "statics/rigidity.hpp"
#include "statics/sparse_cholesky.hpp"

namespace phy::statics {

/// A prescribed movement [m, rad] or an outer force or couple [N/m, N] at one degree of freedom.
struct Given {
  Freedom where;
  double value = 0.0;
};

/// What acts on a network from outside.
struct Boundary {
  std::vector<Given> movements;
  std::vector<Given> loads;
  Gradient gradient;  ///< between periodic images
};

/// Prescribes a body's movement to that of a uniform displacement gradient, its rotation included.
void move_with(Boundary& boundary, const Network& network, std::uint32_t body, const Gradient& gradient);

/// Weak springs of loose bodies, as a fraction of the stiffest contact. What they carry is checked by
/// ground_share.
constexpr double ground_stiffness = 1e-9;

class StiffnessSystem {
 public:
  /// Symbolic part: who is linked to whom, and which movements are prescribed.
  StiffnessSystem(const Network& network, std::vector<Freedom> prescribed);

  /// Would the symbolic part of this network be the same?
  bool fits(const Network& network, const std::vector<Freedom>& prescribed) const;

  /// Numerical part. bad_stiffness or mechanism when there is no usable factor.
  ElasticOutcome factor(const Network& network, const std::vector<laws::Tangent<double>>& k);

  /// Equilibrium under `boundary`, whose movements are those prescribed (the rest of them is 0). Needs
  /// factor() before.
  Movements solve(const Network& network, const std::vector<laws::Tangent<double>>& k,
                  const Boundary& boundary) const;

  /// K^-1 f for forces on all bodies; 0 where movements are prescribed.
  Movements solve(const std::vector<double>& f) const;

  /// Bodies that were given weak springs by the last factor().
  const std::vector<char>& loose() const { return loose_; }

  /// Sum of the forces in the weak springs, as a fraction of `force` (couples divided by the network's
  /// length).
  double ground_share(const Movements& u, double force) const;

 private:
  SparseCholesky factor_;
  std::vector<double> coefficients_;  // upper triangle of K, in the order of elimination
  std::vector<Freedom> prescribed_;
  std::vector<std::uint32_t> pairs_;    // a, b of every link
  std::vector<std::int32_t> equation_;  // of each degree of freedom, -1: prescribed
  std::vector<std::int32_t>
      slot_;  // 21 per link: coefficient of (row, column <= row) of its 6 x 6 block, -1: none
  std::vector<std::int32_t> diagonal_;  // coefficient of each equation's diagonal
  std::vector<char> loose_;
  double ground_ = 0.0, length_ = 1.0;
  SymmetricPattern place_coefficients(const Network& network);
};

/// Inner forces on all bodies, K u: what has to be applied to hold the movements (reactions where they are
/// prescribed).
std::vector<double> inner_forces(const Network& network, const std::vector<laws::Tangent<double>>& k,
                                 const Movements& u, const Gradient& gradient = {});

/// Uniform straining by 1: xx, yy, 2 xy.
constexpr std::array<Gradient, 3> unit_strains = {Gradient{1, 0, 0, 0}, Gradient{0, 0, 0, 1},
                                                  Gradient{0, 0.5, 0.5, 0}};

/// Force times branch of a link: xx, yy, xy, tension positive [N]. Summed over an area and divided by it this
/// is the mean stress there.
std::array<double, 3> stress_share(const Link& link, const laws::Tangent<double>& k,
                                   const std::array<double, 3>& strains);

/// Solution of one load case.
struct LoadCase {
  ElasticOutcome outcome;
  Movements u;
};
/// Everything at once, for a few load cases: unilateral parts act where `active` (empty: everywhere).
LoadCase solve_once(const Network& network, const Boundary& boundary, std::vector<char> active = {});

/// Effective stiffness [Pa] of a periodic cell: stress (xx, yy, xy) from strain (xx, yy, 2 xy).
struct CellStiffness {
  ElasticOutcome outcome;
  std::array<std::array<double, 3>, 3> C{};
};
CellStiffness cell_stiffness(const Network& network, double area);

}  // namespace phy::statics
