// The largest stable time step of a specimen, from a proven upper bound of its highest frequency.
//
// Leap-frog with local damping alpha is stable for dt < 2/(omega_max sqrt(1 + alpha)). omega_max^2 is the
// largest eigenvalue of K = M^-1/2 K M^-1/2 with a 3 x 3 block per pair of grains (u_x, u_y, rotation). A
// power iteration approaches it from below, which is the unsafe side. Instead: the matrix N of the blocks'
// spectral norms is non-negative with omega_max^2 <= rho(N) (norm compression), and for every positive x,
// rho(N) <= max_i (N x)_i/x_i (Collatz 1942, Wielandt 1950). Iterating x <- N x brings the bound down; any
// iterate is safe. Rejected: Gershgorin's circles (28 % smaller step), PFC's 0.8 min sqrt(m/k) (40 %
// smaller). Arithmetic in fixed order: dt decides every bit.
#pragma once
#include <vector>

#include "contact/model.hpp"
#include "engine/boundary.hpp"
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

/// The bound with its witness x, so that new contacts can be added without starting over.
class FrequencyBound {
 public:
  /// Grains within a radius of a body count as touching it. `body_friction`: of its rough bodies.
  FrequencyBound(const Specimen& specimen, const std::vector<ContactStiffness>& contacts,
                 const Boundary& boundary = {}, double body_friction = 0.0);
  /// Upper bound of omega_max [1/s].
  double omega() const;
  /// A contact is created: the bound rises by what its row of N can at most become. Breakage only lowers the
  /// frequency and is left in. Both loosen the bound; `loose()` says when it pays to start over.
  void add(const ContactStiffness& k);
  /// The additions have raised the bound by more than 3 %.
  bool loose() const { return bound_ > 1.06 * tight_; }

 private:
  struct Entry {
    std::uint32_t a, b;
    double norm;
  };
  double block_norm(const ContactStiffness& k, double* diag_a, double* diag_b) const;

  const Packing* packing_;
  double density_;
  std::vector<double> x_;    // witness, > 0
  std::vector<double> row_;  // (N x)_i / x_i
  double bound_ = 0.0;       // max of row_
  double tight_ = 0.0;       // the same before any addition
};

}  // namespace phy::engine
