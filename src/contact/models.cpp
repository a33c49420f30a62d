#include "contact/models.hpp"

#include <utility>
#include <vector>

#include "base/check.hpp"
#include "contact/model.hpp"

namespace phy::contact {
namespace {

template <std::size_t... i>
std::vector<Models> all_models(std::index_sequence<i...>) {
  return {models<std::tuple_element_t<i, Combinations>>()...};
}

const std::vector<Models>& list() {
  static const std::vector<Models> lines =
      all_models(std::make_index_sequence<std::tuple_size_v<Combinations>>());
  return lines;
}

}  // namespace

std::size_t combination_of(const MatrixRecipe& matrix) {
  for (std::size_t i = 0; i < list().size(); ++i)
    if (list()[i].matrix->describes(matrix) && list()[i].interface->describes(matrix)) return i;
  PHY_CHECK(false, "contact models describe every matrix that a recipe can have");
}

const Models& models_of(const MatrixRecipe& matrix) { return list()[combination_of(matrix)]; }

}  // namespace phy::contact
