// What genesis hands over: discs, the contacts between them and what each contact is. Plain data in SI units.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/vec.hpp"
#include "records/recipe.hpp"

namespace phy {

struct Disc {
  double x = 0.0;  ///< [m] from the specimen's left edge
  double y = 0.0;  ///< [m] from the bottom platen
  double r = 0.0;  ///< [m]
};

/// How a packing turned out; printed and stored with every result.
struct PackingReport {
  double porosity = 0.0;        ///< 1 - sum(pi r^2) / (width height)
  double coordination = 0.0;    ///< mean number of touching neighbours, 2 N_contacts / N
  double fabric = 0.0;          ///< <cos 2 angle> of the contact normals; 0 = isotropic
  double stress_left = 0.0;     ///< [Pa] mean stress locked in
  std::int64_t n_rattlers = 0;  ///< discs with fewer than three contacts
  double mean_overlap = 0.0;    ///< mean overlap / mean radius
  double unbalanced = 0.0;      ///< mean unbalanced force / mean contact force at the end
};

/// A box of discs in equilibrium between smooth walls x = 0, x = width, y = 0, y = height.
struct Packing {
  double width = 0.0;   ///< [m]
  double height = 0.0;  ///< [m]
  std::vector<Disc> discs;
  bool stress_free = true;  ///< present overlaps count as zero force
  PackingReport report;
  std::string hash;  ///< fingerprint of the discs' bits
};

enum class ContactKind : std::uint8_t {
  touching,  ///< linear law only (touching or near, not bonded)
  bonded,    ///< linear law + parallel bond, or flat joint (without bond where sigma_c = 0)
  joint      ///< smooth joint, bonded at the start
};

/// One contact at the start of a test. a < b are disc numbers of the packing.
struct Contact {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  ContactKind kind = ContactKind::bonded;
  std::int8_t side = 0;  ///< joints: sign of n.n_j at assignment (a -> b); kept for ever
  std::uint8_t set = 0;  ///< joints: number of the set as laid (Specimen::laid)
  double sigma_c = 0.0;  ///< bonded: tensile strength [Pa]
  double tau_c = 0.0;    ///< bonded: shear strength or cohesion [Pa]
  double gap = 0.0;      ///< flat joints that start open: gap of the interface [m]
  /// Of the matrix: cosine of twice the angle between its normal and that of the foliation at the start. 0
  /// stands for the mean over all directions, which pairs that meet during a test have.
  double cos_2a = 0.0;
  double layer = 1.0;    ///< bonded: stiffness over that of the matrix, in a layer of the bedding
  double sigma_n = 1.0;  ///< joints: tensile strength over the mean of the set
};

/// How a bedding set sits in this specimen.
struct BeddingReport {
  double overlap_ratio = 0.0;    ///< sum(A)/L of one plane: joint contact length per length of plane
  double bridge_fraction = 0.0;  ///< contacts that cross a plane but are no joints, of all crossing contacts
  double non_crossing_fraction = 0.0;  ///< joints whose grains lie on the same side, of all joints
  bool dispersed = false;              ///< joints without planes: what is above means nothing,
  double joint_fraction = 0.0;         ///< and this is the set's share of all contacts
};

/// One plane of a set whose planes scatter, laid as a set of its own; or a set that does not scatter.
struct LaidSet {
  BeddingRecipe recipe;
  std::uint8_t set = 0;    ///< in Specimen::bedding
  std::int32_t plane = 0;  ///< number of the plane within its set
};

/// A bonded specimen of one packing with its bedding: what the engine and the statics load.
struct Specimen {
  std::string name;  ///< "theta = 30 deg" or "intact"
  std::shared_ptr<const Packing> packing;
  MatrixRecipe matrix;
  std::vector<BeddingRecipe> bedding;  ///< sets of the recipe, with their final angles
  std::vector<LaidSet> laid_sets;      ///< empty where no set scatters: then the sets are laid as they are
  std::vector<Contact> contacts;       ///< sorted by (a, b)
  /// Plane interval of each grain's centre, per set as laid: label[set * n_grains + grain] = floor of the
  /// plane count below it. Dispersed joints have no planes, and one label.
  std::vector<std::int32_t> plane_label;
  std::vector<BeddingReport> bedding_report;  ///< per set of the recipe

  /// Sets as laid: what contacts and labels number.
  std::size_t n_laid() const { return laid_sets.empty() ? bedding.size() : laid_sets.size(); }
  const BeddingRecipe& bedding_of(std::size_t number) const {
    return laid_sets.empty() ? bedding[number] : laid_sets[number].recipe;
  }
  /// The set of the recipe that a set as laid belongs to.
  std::uint8_t set_of(std::uint8_t number) const {
    return laid_sets.empty() ? number : laid_sets[number].set;
  }
};

}  // namespace phy
