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

std::size_t combination_of(const MatrixRecipe& matrix, const std::vector<BeddingRecipe>& bedding) {
  for (std::size_t i = 0; i < list().size(); ++i)
    // The first that fits is the leanest: models that cost more come behind (models.hpp).
    if (list()[i].matrix->describes(matrix, bedding) && list()[i].interface->describes(matrix, bedding))
      return i;
  PHY_CHECK(false, "contact models describe every specimen that a recipe can have");
}

const Models& models_of(const Specimen& specimen) {
  return list()[combination_of(specimen.matrix, specimen.bedding)];
}

}  // namespace phy::contact
