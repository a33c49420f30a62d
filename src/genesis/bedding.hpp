// Bedding: sets of parallel planes cut through a bonded packing, or joints dispersed in it; contacts at a
// plane, or of a direction, become joints.
//
// A set has the unit normal n_j = (-sin theta, cos theta). Its planes are the lines n_j.(x - centre) = offset
// + k spacing, k = ..., -1, 0, 1, ..., the centre being that of the specimen. Three rules say which contacts
// are joints:
//   crossing   the centres of the two discs lie in different intervals: one layer of joints per plane
//   zone       the contact point is at most zone_thickness/2 from the nearest plane (the paper's reading);
//              with bridges = false the contacts of the crossing rule as well
//   oriented   the branch vector is at most orientation_range from n_j; there are no planes (the joints of
//              Duan & Kwok 2015, Int. J. Rock Mech. Min. Sci. 78:46-56, whose text was not at hand)
// The first two differ. In a random packing of 0.25-0.415 mm discs with a zone of 0.6 mm a third of the
// zone's joints connect discs on the same side of the plane, and a few per cent of the crossing contacts stay
// bonded bridges; BeddingReport states both. The length of joint contact per length of plane, sum(A)/L, sets
// the macroscopic joint stiffness: K_n ~ k_n sum(A)/L. A joint replaces the bond of its contact (Mas Ivars et
// al. 2011, Int. J. Rock Mech. Min. Sci. 48:219-244), and also that of a contact left without one. If several
// sets claim a contact the first set of the recipe has it.
//
// Side: +1 if b lies above a along n_j, else -1, decided once. A branch parallel to the plane (to rounding,
// 1e-12 of the radii) has no upper disc; the one with the larger number counts as the upper one.
//
// Persistence p: a plane falls apart into patches of patch_length, from a place of its own, and each is
// jointed with probability p; with patch_length 0 each contact is for itself. Outside of jointed patches
// bonds stay. Scatter: the distance of planes k-1 and k is spacing (1 + spacing_sd z), their theta is theta +
// theta_sd z about the point of the plane below or above the specimen's centre, z being standard normal,
// drawn again outside of 3. All draws are keyed by bond_seed, set, number of plane and patch (or of the
// grains): they depend on no order, and planes that are turned take patches, distances and tilts with them.
// docs/theory/bedding.md has the reasons.
#pragma once
#include <vector>

#include "records/specimen.hpp"

namespace phy::genesis {

/// The planes of one set in one specimen.
class PlaneSet {
 public:
  PlaneSet(const BeddingRecipe& recipe, double width, double height);

  Vec2 normal() const { return normal_; }
  /// Height of a point above the specimen's centre along the normal [m].
  double height_of(double x, double y) const { return dot(normal_, Vec2{x, y} - centre_); }
  /// Number of the interval between planes in which a height lies: floor((height - offset)/spacing).
  std::int32_t interval(double height) const;
  /// Number of the plane that is nearest to a height.
  std::int32_t nearest(double height) const;
  /// Distance of a height from the nearest plane [m].
  double distance(double height) const;
  /// Total length of the planes inside the specimen's rectangle [m].
  double total_length() const;

 private:
  Vec2 normal_, centre_;
  double offset_, spacing_;
};

/// The sets plane by plane if planes of any of them scatter, else none. `bond_seed`: of the matrix.
std::vector<LaidSet> laid_apart(const std::vector<BeddingRecipe>& bedding, double width, double height,
                                std::int64_t bond_seed);

/// Turns the contacts of specimen.contacts that qualify into joints and fills laid_sets, plane_label and
/// bedding_report, for the sets of specimen.bedding.
void lay_bedding(Specimen& specimen);

}  // namespace phy::genesis
