// A matrix with directions: what belongs to a contact depends on the angle a between its normal and that of
// the foliation.
//
//   1 + W cos 2a                  W = (1 - r)/(1 + r),   r = value along the foliation / value across it
//   1 - V cos 4a                  V = (q - 1)/(q + 1),   q = value at 45 degrees / value along or across
//
// r belongs to contacts whose *normal* lies along the foliation (a = 90 degrees) over those whose normal lies
// across it: r > 1 makes the planes of the foliation, which contacts across it hold together, the weak ones.
// Both have the mean 1 over all directions, so that r and q change directions and leave the level alone; r ->
// 1/r is the specimen turned by 90 degrees. The first is the form in which the critical-plane approach writes
// a strength on a plane of normal l, c = c_0 (1 + W_ij l_i l_j) with a traceless tensor of the fabric
// (Pietruszczak & Mroz 2001, Int. J. Numer. Anal. Meth. Geomech. 25:509-524; for stratified rock Lydzba,
// Pietruszczak & Shao 2003, Comput. Geotech. 30:289-302), in two dimensions, for the plane of a contact; the
// second is the next term of the same series, which is even in a.
#pragma once

namespace phy::contact {

/// r > 0; cos_2a between -1 (normal along the foliation) and 1 (across it).
constexpr double direction_factor(double r, double cos_2a) { return 1.0 + (1.0 - r) / (1.0 + r) * cos_2a; }
/// Its derivative with respect to r.
constexpr double direction_factor_rate(double r, double cos_2a) {
  return -2.0 / ((1.0 + r) * (1.0 + r)) * cos_2a;
}
/// q > 0.
constexpr double oblique_factor(double q, double cos_2a) {
  return 1.0 - (q - 1.0) / (q + 1.0) * (2.0 * cos_2a * cos_2a - 1.0);
}

}  // namespace phy::contact
