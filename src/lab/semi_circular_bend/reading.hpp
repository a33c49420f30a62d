// Semi-circular bend: the apparent fracture toughness.
//
//   K_Ic_apparent   Y' sqrt(pi a) P_max / (2 R B), B = 1, with the factor Y' of an isotropic body; apparent,
//                   because bedded rock is not one, and because the notch of a grain assembly is as blunt as
//                   its grains
//   bend_strength   largest nominal stress P/(2 R B); the percentages of the history refer to it
//   P_max, u_peak   largest load and the load-point displacement there
//   mouth_opening_at_peak   crack mouth opening there
//   notch_length    a, as the grains have it
//   Y_prime         the factor
//
// Y' is that of Kuruppu, Obara, Ayatollahi, Chong & Funatsu 2014 (Rock Mech. Rock Eng. 47:267-274), from
// finite elements in plane strain, for 0.4 <= a/R <= 0.6 and 0.5 <= s/(2R) <= 0.8, s the distance of the
// supports. An own calculation (docs/theory/semi-circular-bend.md) agrees within 0.6 % at a/R = 0.4 and 0.6;
// at 0.5 the formula lies 2.1 % above it.
#pragma once
#include <vector>

#include "analysis/branch.hpp"

namespace phy::lab {

/// E u / (2 R) over the nominal stress, of an isotropic half disc with a/R = 0.5 and s/(2R) = 0.8 (own plane
/// strain calculation): for the speed of waves and the expected cost only.
constexpr double bend_compliance = 12.0;

/// The half disc, its notch and its supports.
struct BendSpecimen {
  double radius = 0.0;  ///< R [m]
  double notch = 0.0;   ///< a [m]
  double span = 0.0;    ///< s, from one support to the other [m]
  /// The middle of the flat face in a box of this width, as genesis::cut_half_disc leaves it: the largest
  /// radius of the grains above the bottom.
  Vec2 flat_face(double width) const { return {0.5 * width, 0.5 * width - radius}; }
};

/// Y' = K_I 2 R B / (P sqrt(pi a)) of an isotropic body [-]; `notch_ratio` a/R, `span_ratio` s/(2R).
double bend_factor(double notch_ratio, double span_ratio);

/// K_I of an isotropic body under the nominal stress P/(2 R B) [Pa] [Pa sqrt(m)].
double isotropic_K_I(const BendSpecimen& specimen, double nominal_stress);

/// The numbers above. NaN with a note where the load has no peak.
std::vector<Number> toughness(const analysis::LoadingBranch& branch, const BendSpecimen& specimen);

/// All numbers of a half disc of rock of that density [kg/m^3], but for those of the direct elastic solution.
std::vector<Number> bend_numbers(const History& history, const std::vector<CrackEvent>& cracks,
                                 const BendSpecimen& specimen, double density);

}  // namespace phy::lab
