// The cold side of a contact model: everything about two grains that hold together which is asked once per
// test, block of cycles or file, in double precision. The force loop knows the hot side (step.hpp); stable
// step, statics, tables and pictures ask this one, and none of them names a law.
//
// A specimen has two models (models.hpp): that of the matrix, whose normal is the branch vector between the
// grains, and that of the interfaces, whose normal is fixed. A contact belongs to one of them for ever; a
// pair that was never bonded belongs to the matrix until it meets. A model whose bonds break keeps what is
// left: there is no handing over, a broken parallel bond is a linear contact because the model holds both
// side by side.
//
// Signs are those of laws/law.hpp: closure, compression and shortening positive, forces on grain 2.
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>

#include "base/vec.hpp"
#include "laws/tangent.hpp"
#include "records/result.hpp"
#include "records/specimen.hpp"

namespace phy::contact {

constexpr double unlimited =
    1e30;  ///< [N/m] no strength or friction is reached while nothing may break or slip

/// A contact between two blocks of cycles. Grain 1 is the lower one in memory.
struct Standing {
  const Specimen& specimen;
  std::uint8_t set = 0;   ///< bedding set, of an interface
  double side = 0.0;      ///< of an interface, as in step.hpp
  bool original = false;  ///< bonded, or an interface, since the start of the test
  double r_min = 0.0;     ///< smaller radius [m]
  double gap = 0.0;       ///< approach needed before the grains press on each other [m]
  Vec2 branch_0, branch;  ///< from centre 1 to centre 2, at the start and now [m]
  double rotation = 0.0;  ///< of grain 2 against grain 1 [rad]
  const double* geometry = nullptr;
  const double* fields = nullptr;
};

/// The direct solution: gaps up to this fraction of the mean radius count as closed; an axial strain of 1e-6
/// closes them.
constexpr double touching_gap = 1e-6;

/// Stiffness of a contact in the two parts that the direct solution tells apart.
struct ElasticPart {
  laws::Tangent<double> unilateral;  ///< acts only while the grains press on each other
  laws::Tangent<double> bilateral;   ///< acts always
};

/// A parameter of the recipe that elastic constants depend on: of the matrix or of a bedding set.
struct ElasticParameter {
  const char* name;  ///< its key within the table of the recipe
  const char* unit;
  double MatrixRecipe::*matrix = nullptr;
  double BeddingRecipe::*bedding = nullptr;
  const char* together = nullptr;  ///< parameters of this name are also varied by the same amount
};

inline double radius_of(const Specimen& s, std::uint32_t grain) { return s.packing->discs[grain].r; }

class ContactModel {
 public:
  struct Size {
    std::size_t fields, parameters, geometry;
    std::size_t cracks;  ///< the most that one contact gives in its life
  };
  virtual ~ContactModel() = default;

  virtual Size size() const = 0;
  /// Can it be in a specimen with this matrix and bedding?
  virtual bool describes(const MatrixRecipe& matrix, const std::vector<BeddingRecipe>& bedding) const = 0;
  /// Specimens side by side in lanes share the geometry: may these two?
  virtual bool same_geometry(const MatrixRecipe& one, const MatrixRecipe& other) const = 0;
  /// What the packing gives it, for grains of radii r1, r2 [m].
  virtual void geometry(const MatrixRecipe& matrix, double r1, double r2, double* out) const = 0;
  /// Its parameters in SI units from the recipe; `set` is the bedding set of an interface.
  virtual void parameters(const Specimen& specimen, std::uint8_t set, double* out) const = 0;
  /// Parameters for a lane in which it has no say: harmless in every operation.
  virtual void idle_parameters(double* out) const = 0;

  /// Memory at the start of a test.
  virtual void install(const Specimen& specimen, const Contact& contact, double* fields) const = 0;
  /// Memory of an interface between grains that meet during a test: broken, `gap` apart [m], with the shear
  /// force [N/m] that they already pressed on each other with in the block that is over.
  virtual void meet(double gap, double F_s, double* fields) const = 0;

  /// Unit normal from grain a to grain b, whose unit branch vector is `branch`.
  virtual Vec2 normal(const Specimen& specimen, const Contact& contact, Vec2 branch) const = 0;
  /// The largest stiffness that it shows as it is, unbroken or not: linear parts closed and sticking. The
  /// stable step follows from it, and every bit of a run from the step: the order of its operations is part
  /// of it.
  virtual laws::Tangent<double> stiffness(const Specimen& specimen, const Contact& contact,
                                          bool unbroken) const = 0;
  /// The same for the direct solution, in parts, as a product of moduli and factors of the geometry.
  virtual ElasticPart elastic(const Specimen& specimen, const Contact& contact, double gap) const = 0;
  /// Parameters of the recipe that `elastic` depends on.
  virtual std::span<const ElasticParameter> elastic_parameters() const = 0;
  /// Derivative of `elastic` with respect to one of them.
  virtual ElasticPart elastic_rate(const Specimen& specimen, const Contact& contact, double gap,
                                   const ElasticParameter& parameter) const = 0;

  /// Memory after an affine displacement of the whole specimen, that of grain 2 against grain 1 being du [m].
  virtual void affine_start(const Standing& contact, Vec2 du, double* fields) const = 0;
  /// It carries its strength or more: it would break the moment breakage is allowed.
  virtual bool at_strength(const Standing& contact) const = 0;
  /// It has a bond and the bond holds.
  virtual bool unbroken(const double* fields) const = 0;
  /// Kind, state, normal and forces for pictures.
  virtual void describe(const Standing& contact, ContactState& out) const = 0;
  /// Place and size of a crack of its part number `part`, and its normal where that is not the branch; it
  /// comes with the branch as its normal and the contact point as its place.
  virtual void crack(const Standing& contact, std::size_t part, CrackEvent& out) const = 0;
};

/// The cold sides of a combination.
struct Models {
  const ContactModel* matrix;
  const ContactModel* interface;
  const ContactModel& of(ContactKind kind) const { return kind == ContactKind::joint ? *interface : *matrix; }
  std::size_t n_fields() const { return std::max(matrix->size().fields, interface->size().fields); }
  std::size_t n_geometry() const { return matrix->size().geometry + interface->size().geometry; }
  std::size_t n_cracks() const { return std::max(matrix->size().cracks, interface->size().cracks); }
};

template <class C>
Models models() {
  return {&C::Matrix::model(), &C::Interface::model()};
}

/// The line of the list (models.hpp) that a specimen takes: the first whose models can be in it.
std::size_t combination_of(const MatrixRecipe& matrix, const std::vector<BeddingRecipe>& bedding);
const Models& models_of(const Specimen& specimen);

}  // namespace phy::contact
