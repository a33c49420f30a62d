// Curved strength envelopes of intact rock, isotropic and foliated.
//
//   Hoek-Brown, intact rock:   sigma_1 = sigma_3 + sigma_c  sqrt( m_i sigma_3 / sigma_c + 1 )
//   Saroglou-Tsiambaos:        sigma_1 = sigma_3 + sigma_ct sqrt( k m_i sigma_3 / sigma_ct + 1 )
//
// sigma_ct is the unconfined strength, as measured at that inclination, and k the anisotropy parameter there:
// 1 when the load is normal to the planes, where the second law is the first.
// Sources: E. Hoek & E.T. Brown (1980), read in E. Eberhardt, "The Hoek-Brown
// failure criterion", Rock Mech. Rock Eng. 45 (2012) 981-988, Eq. 1 with s = 1; H. Saroglou & G. Tsiambaos,
// "A modified Hoek-Brown failure criterion for anisotropic intact rock", IJRMMS 45 (2008) 223-234 (its text
// could not be opened: the form above is the commonly quoted one). Compression positive. Left out: rock mass
// (s < 1, GSI), tension beyond sigma_3 = -sigma_c / (k m_i). docs/theory/strength.md
#pragma once

namespace phy::theory {

/// Peak sigma_1 [Pa]; sigma_c > 0 [Pa], m_i > 0 [-], sigma_3 >= -sigma_c / m_i [Pa].
double hoek_brown_sigma_1(double sigma_c, double m_i, double sigma_3);

/// Peak sigma_1 [Pa] of foliated rock; sigma_c_theta > 0 [Pa] and k_theta > 0 [-] belong to the same
/// inclination.
double saroglou_tsiambaos_sigma_1(double sigma_c_theta, double k_theta, double m_i, double sigma_3);

}  // namespace phy::theory
