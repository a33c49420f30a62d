// A flat joint along straight legs (theory/contact_path.hpp): what its elements answer at the end of a leg,
// solved in one piece. The motion is given, so every element is alone with its own closure a and the
// rotation.
//
//   bonded     springs and strengths that are linear in lambda: a Cement whose moment is k_n h rotation
//   unbonded   the stress over the closed length l is a triangle or a trapezium: the force F is the closed
//              part's stress summed, a convex function of lambda (a sum of max(linear, 0))
//   friction   |S| <= L = mu F, S driven at the rate d >= 0 (d < 0: mirrored). A limit that moves convexly is
//              met from below at most once, and left where it moves away as fast as S is driven:
//              S(1) = min(max(S(0) + d, max_x(-L(x) + d (1 - x))), min_x(L(x) + d (1 - x))),  0 <= x <= 1
//
// The two extrema are of convex functions. Nothing is shared with laws/.
#pragma once
#include <vector>

#include "theory/contact_path.hpp"

namespace phy::theory {

class ExactFlat {
 public:
  /// Of the whole interface: stiffnesses [N/m per m], capacities [N/m]; half length [m].
  struct Interface {
    double k_n, k_s, half_length, mu, S_0, tan_phi, edge;
    int elements;
    double capacity;
  };
  explicit ExactFlat(const Interface& whole);
  void leg(ContactPoint step, double seconds);
  ContactForces forces() const;

 private:
  struct Element {
    double x, h;  // centre and half length [m]
    Cement bond;  // its `at` holds the closure of the centre, slide and rotation, also when broken
    double S;     // [N/m] of a broken one
    double mu;
    /// Force of an unbonded element and its couple about the middle of the interface.
    ContactForces pressing(const ContactPoint& where) const;
    void rub(ContactPoint from, ContactPoint step);
    void leg(ContactPoint step);
    ContactForces forces() const;
  };
  std::vector<Element> elements_;
};

}  // namespace phy::theory
