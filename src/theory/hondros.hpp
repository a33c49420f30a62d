// Stresses in the Brazilian disc, isotropic and elastic.
//
// A disc (diameter D, thickness t) is pressed along y by a uniform radial pressure p on two arcs of 2 alpha
// each. On the diameters, compression positive, rho = distance from the centre / radius:
//
//   along the load (y axis)                              across it (x axis)
//   A = (1-rho^2) sin 2a / (1 - 2 rho^2 cos 2a + rho^4)  A = (1-rho^2) sin 2a / (1 + 2 rho^2 cos 2a + rho^4)
//   B = atan( (1+rho^2)/(1-rho^2) tan a )                B = atan( (1-rho^2)/(1+rho^2) tan a )
//   sigma_x = (2p/pi) (B - A)                            sigma_x = (2p/pi) (B - A)
//   sigma_y = (2p/pi) (B + A)                            sigma_y = (2p/pi) (B + A)
//
// p follows from the force that a platen measures: P = 2 R t p sin(alpha). Hondros writes p = P/(2 R t
// alpha), the mean over the arc; the two differ by alpha/sin(alpha), 0.13 % at alpha = 5 degrees. For alpha
// -> 0, inside the disc,
//
//   y axis: sigma_x = -2P/(pi D t), sigma_y = (2P/(pi D t)) (4/(1-rho^2) - 1)
//   x axis: sigma_x = -(2P/(pi D t)) ((1-rho^2)/(1+rho^2))^2, sigma_y = (2P/(pi D t)) (4/(1+rho^2)^2 - 1)
//
// Source: G. Hondros, "The evaluation of Poisson's ratio and the modulus of materials of a low tensile
// resistance by the Brazilian (indirect tensile) test", Aust. J. Appl. Sci. 10 (1959) 243-268; its Fourier
// series, summed here in closed form, is the independent check in hondros.test.cpp. Point load: Timoshenko &
// Goodier, "Theory of Elasticity". Left out: platen friction, anisotropy (anisotropic_disc.hpp), contact
// that grows with the load. docs/theory/brazilian.md
#pragma once

namespace phy::theory {

/// Disc and load. P is the whole force on one platen, compression positive.
struct BrazilianDisc {
  double diameter = 0.0;   ///< D [m], > 0
  double thickness = 0.0;  ///< t [m], > 0; 1 in two dimensions
  double alpha = 0.0;      ///< half the loaded arc [deg], 0 < alpha < 90
  double P = 0.0;          ///< force [N]
};

/// Normal stresses on a diameter [Pa]; the shear stress vanishes there by symmetry.
struct DiameterStress {
  double sigma_x = 0.0;  ///< across the load; negative = tension
  double sigma_y = 0.0;  ///< along the load
};

/// On the loaded diameter, |rho| <= 1 (at |rho| = 1 the applied pressure).
DiameterStress hondros_loaded_diameter(const BrazilianDisc& disc, double rho);

/// On the diameter across the load, |rho| <= 1.
DiameterStress hondros_cross_diameter(const BrazilianDisc& disc, double rho);

/// The same for two point loads; alpha is not used and |rho| < 1 on the loaded diameter.
DiameterStress point_load_loaded_diameter(const BrazilianDisc& disc, double rho);
DiameterStress point_load_cross_diameter(const BrazilianDisc& disc, double rho);

/// Indirect tensile strength 2P/(pi D t) [Pa], positive.
double brazilian_strength(double P, double diameter, double thickness);

}  // namespace phy::theory
