// THE list of contact models: the combinations that may meet in one specimen, one line each. A specimen takes
// the first line that can describe it. The force loop is compiled for every line.
#pragma once
#include <algorithm>
#include <tuple>

#include "contact/flat_joint.hpp"
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

using Combinations = std::tuple<           //
    Combination<LinearBond, SmoothJoint>,  //
    Combination<UnevenBond, SmoothJoint>,  //
    Combination<FlatJoint, SmoothJoint>>;

}  // namespace phy::contact
