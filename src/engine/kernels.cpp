#include "engine/kernels.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <utility>
#include <vector>

#include "base/check.hpp"
#include "contact/models.hpp"

namespace phy::engine {

// Defined in group_isa.cpp, which is compiled once for each instruction set.
Kernel<double> double_kernel_sse2(std::size_t combination, int lanes);
Kernel<float> float_kernel_sse2(std::size_t combination, int lanes);
Kernel<double> double_kernel_avx2(std::size_t combination, int lanes);
Kernel<float> float_kernel_avx2(std::size_t combination, int lanes);
Kernel<double> double_kernel_avx512(std::size_t combination, int lanes);
Kernel<float> float_kernel_avx512(std::size_t combination, int lanes);

const char* to_string(Isa isa) {
  switch (isa) {
    case Isa::sse2: return "sse2";
    case Isa::avx2: return "avx2";
    case Isa::avx512: return "avx512";
  }
  return "unknown";
}

Isa native_isa() {
  Isa best = Isa::sse2;
  if (__builtin_cpu_supports("avx2")) best = Isa::avx2;
  // All parts of AVX-512 that the compiler may use with the flags of that build.
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    best = Isa::avx512;
  const char* wish = std::getenv("PHYLLITE_ISA");
  if (wish == nullptr || *wish == 0) return best;
  // The environment can lower the set (to compare them) but not raise it: the processor would stop at an
  // unknown instruction.
  for (const Isa isa : {Isa::sse2, Isa::avx2, Isa::avx512})
    if (std::strcmp(wish, to_string(isa)) == 0) return std::min(isa, best);
  throw InputError(Problem{"environment", "PHYLLITE_ISA", wish, "sse2, avx2 or avx512", "or leave it unset"});
}

template <class T>
int native_lanes(Isa isa) {
  return static_cast<int>((isa == Isa::sse2 ? 16 : isa == Isa::avx2 ? 32 : 64) / sizeof(T));
}
template int native_lanes<double>(Isa);
template int native_lanes<float>(Isa);

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
