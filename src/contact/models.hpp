// THE list of contact models: the combinations that may meet in one specimen, one line each. The force loop
// is compiled for every line.
#pragma once
#include <algorithm>
#include <tuple>

#include "contact/linear_bond.hpp"
#include "contact/smooth_joint.hpp"

namespace phy::contact {

/// Hot sides of the matrix model and of the interface model of a specimen.
template <class MatrixModel, class InterfaceModel>
struct Combination {
  using Matrix = MatrixModel;
  using Interface = InterfaceModel;
  /// Memory of a contact is as wide as the wider of both, and says first which of them it is.
  static constexpr std::size_t n_fields = std::max<std::size_t>(Matrix::n_fields, Interface::n_fields);
  static constexpr std::size_t n_geometry = std::size_t{Matrix::n_geometry} + Interface::n_geometry;
};

using Combinations = std::tuple<Combination<LinearBond, SmoothJoint>>;

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

/// The first line of the list: what statics and tables ask unless they are told otherwise.
inline Models standard_models() { return models<std::tuple_element_t<0, Combinations>>(); }

}  // namespace phy::contact
