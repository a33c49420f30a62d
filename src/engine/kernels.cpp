#include "engine/kernels.hpp"

#include <utility>
#include <vector>

#include "contact/models.hpp"

namespace phy::engine {

namespace {

template <std::size_t combination>
Kernel<double> double_kernel(Isa isa, int lanes) {
  if (isa == Isa::avx512) return double_kernel_avx512(combination, lanes);
  return isa == Isa::avx2 ? double_kernel_avx2(combination, lanes) : double_kernel_sse2(combination, lanes);
}

template <std::size_t combination>
Kernel<float> float_kernel(Isa isa, int lanes) {
  if (isa == Isa::avx512) return float_kernel_avx512(combination, lanes);
  return isa == Isa::avx2 ? float_kernel_avx2(combination, lanes) : float_kernel_sse2(combination, lanes);
}

template <std::size_t combination>
const ContactPhysics& physics() {
  static const ContactPhysics of{contact::models<std::tuple_element_t<combination, contact::Combinations>>(),
                                 double_kernel<combination>, float_kernel<combination>};
  return of;
}

template <std::size_t... combinations>
std::vector<const ContactPhysics*> all_physics(std::index_sequence<combinations...>) {
  return {&physics<combinations>()...};
}

}  // namespace

const ContactPhysics& physics_of(const MatrixRecipe& matrix, const std::vector<BeddingRecipe>& bedding) {
  static const std::vector<const ContactPhysics*> lines =
      all_physics(std::make_index_sequence<std::tuple_size_v<contact::Combinations>>());
  return *lines[contact::combination_of(matrix, bedding)];
}

}  // namespace phy::engine
