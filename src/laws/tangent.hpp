// The stiffness of a law: all that those need to know of laws who step no contact.
#pragma once

namespace phy::laws {

/// Stiffness of a law against small motions from where it is, a symmetric matrix:
///    dF_n   k_n   k_ns  k_nm   d_closure
///   -dF_s =  .    k_s   k_sm   d_slide
///   -dM      .     .    k_m    d_rotation
/// The direct elastic solution and the stable step are built from it. Most laws couple nothing; an interface
/// that is broken over half its length couples force and moment.
template <class R>
struct Tangent {
  R k_n;                                    ///< [N/m per m]
  R k_s;                                    ///< [N/m per m]
  R k_m;                                    ///< [N]
  R k_ns = R(0), k_nm = R(0), k_sm = R(0);  ///< [N/m per m], [N/m], [N/m]
  bool coupled() const { return k_ns != R(0) || k_nm != R(0) || k_sm != R(0); }
};

}  // namespace phy::laws
