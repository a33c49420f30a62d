// The largest stable time step of a specimen, from a proven upper bound of its highest frequency.
//
// Leap-frog with local damping alpha is stable for dt < 2/(omega_max sqrt(1 + alpha)). omega_max^2 is the
// largest eigenvalue of K = M^-1/2 K M^-1/2 with a 3 x 3 block per pair of grains (u_x, u_y, rotation). A
// power iteration approaches it from below, which is the unsafe side. Instead: the matrix N of the blocks'
// spectral norms is non-negative with omega_max^2 <= rho(N) (norm compression), and for every positive x,
// rho(N) <= max_i (N x)_i/x_i (Collatz 1942, Wielandt 1950). Iterating x <- N x brings the bound down; any
// iterate is safe. Rejected: Gershgorin's circles (28 % smaller step), PFC's 0.8 min sqrt(m/k) (40 %
// smaller). Arithmetic in fixed order: dt decides every bit.
//
// Grains of equal mass (inertia.hpp) have a closer bound. A contact between i and j stretches, slides or
// turns by e = e_i + e_j, and for every x > 0 e^2 <= (1 + x_j/x_i) e_i^2 + (1 + x_i/x_j) e_j^2. So K lies
// below the block diagonal sum over contacts of (1 + x_j/x_i) K_c,ii, whose largest eigenvalue bounds
// omega_max^2: the directions of a grain's contacts are added as tensors where N adds their norms. x grows
// where a block is large; any iterate is safe, the best one is taken. Above the frequency itself by 8 %
// (paper's packing, ten iterations; N: 18 %). Of discs it is 16 and 17 %: their bits keep N.
#pragma once
#include <array>
#include <vector>

#include "contact/model.hpp"
#include "engine/boundary.hpp"
#include "engine/inertia.hpp"
#include "records/specimen.hpp"

namespace phy::engine {

/// Stiffness of one contact between grains a and b (packing numbers) in its own frame.
struct ContactStiffness {
  std::uint32_t a = 0, b = 0;
  laws::Tangent<double> k{0.0, 0.0, 0.0};  ///< along and across `normal`, and against rotation
  Vec2 normal;                             ///< a -> b: branch, or the plane's normal
  Vec2 branch;                             ///< unit vector from centre a to centre b
  double gap = 0.0;                        ///< between the discs [m]
};
/// Stiffness of a contact as its model states it, for grains that touch with this unit branch vector.
ContactStiffness stiffness_of(const contact::Models& models, const Specimen& specimen, const Contact& contact,
                              Vec2 branch, bool unbroken = true);
/// Stiffness with which a contact starts (linear part closed, bond or interface intact).
ContactStiffness initial_stiffness(const contact::Models& models, const Specimen& specimen,
                                   const Contact& contact);
/// All contacts of a specimen as it starts.
std::vector<ContactStiffness> initial_stiffnesses(const contact::Models& models, const Specimen& specimen);

/// A symmetric 3 x 3 matrix: xx yy zz xy xz yz.
using Sym3 = std::array<double, 6>;

/// The bound with its witness x, so that new contacts can be added without starting over.
class FrequencyBound {
 public:
  /// Grains within a radius of a body count as touching it. `body_friction`: of its rough bodies.
  FrequencyBound(const Specimen& specimen, const std::vector<ContactStiffness>& contacts,
                 const Inertia& inertia, const Boundary& boundary = {}, double body_friction = 0.0);
  /// The bound anew, from the contacts that are there.
  void renew(const Specimen& specimen, const std::vector<ContactStiffness>& contacts,
             const Boundary& boundary, double body_friction);
  /// Upper bound of omega_max [1/s].
  double omega() const;
  /// A contact is created: the bound rises by what its grains' rows can at most become. Breakage only lowers
  /// the frequency and is left in. Both loosen the bound; `loose()` says when it pays to start over.
  void add(const ContactStiffness& k);
  /// The additions have raised the bound by more than 3 %.
  bool loose() const { return bound_ > 1.06 * tight_; }

 private:
  /// Scaled stiffness of a contact: of each grain with itself, and between them (its norm, for discs).
  struct Blocks {
    std::uint32_t a, b;
    Sym3 of_a, of_b;
    double norm_ab;
  };
  struct OfBody {
    std::uint32_t grain;
    Sym3 block;
  };
  Blocks blocks_of(const ContactStiffness& k) const;
  void bound_by_norms(const std::vector<Blocks>& contacts, const std::vector<OfBody>& bodies);
  void bound_by_tensors(const std::vector<Blocks>& contacts, const std::vector<OfBody>& bodies);

  const Packing* packing_;
  Inertia inertia_;
  double density_;
  std::vector<double> x_;  // witness, > 0
  // What bounds the frequency at a grain: (N x)_i/x_i, or the largest eigenvalue of its block.
  std::vector<double> row_;
  std::vector<Sym3> diagonal_;
  double bound_ = 0.0;  // max of row_
  double tight_ = 0.0;  // the same before any addition
};

}  // namespace phy::engine
