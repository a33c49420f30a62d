// What glued or rough platens do to the modulus of obliquely bedded rock.
//
// Oblique bedding couples axial stress to shear. Between frictionless platens the specimen simply shears
// sideways and the uniform solution holds. Ends that may neither shift nor turn bend it into an S and make it
// look stiffer. Along the centre line, axial direction y, width W, height H:
//
//   eta = 3 S_ys^2 / ( S_yy (3 S_ss + 2 S_yy (H/W)^2) )
//   centre-line stress / centre-line strain = E / (1 - eta)
//   mean axial stress  / centre-line strain = E (1 - 2 eta/3) / (1 - eta)
//
// Source: N.J. Pagano & J.C. Halpin, "Influence of end constraint in the testing of anisotropic bodies", J.
// Composite Materials 2 (1968) 18-31: the strip whose axis is clamped (no sideways shift, no rotation) at
// both ends while the rest of the end section stays free. The stress field is re-derived in
// end_constraint.test.cpp, which checks strains, end conditions and both ratios. The first ratio is
// the one usually quoted; force over area measures the second. Left out: friction over the whole end face
// (stiffer still, and not solvable in closed form). docs/theory/transverse-isotropy.md
#pragma once
#include "theory/transverse_isotropy.hpp"

namespace phy::theory {

/// eta [-], 0 <= eta < 1; `S` is the compliance in specimen axes, `slenderness` is H/W > 0.
double end_constraint_eta(const PlaneCompliance& S, double slenderness);

/// Apparent over true modulus [-], >= 1, both on the centre line.
double end_constraint_ratio(const PlaneCompliance& S, double slenderness);

/// Apparent over true modulus [-], >= 1, with the mean axial stress (force over area) in place of the
/// centre-line stress.
double end_constraint_mean_ratio(const PlaneCompliance& S, double slenderness);

}  // namespace phy::theory
