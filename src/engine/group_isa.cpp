// Compiled once per instruction set (CMakeLists.txt): the kernels of that set, by combination of contact
// models, precision and number of lanes.
#include <utility>

#include "contact/models.hpp"
#include "engine/advance_block.hpp"
#include "engine/force_loop.hpp"
#include "engine/wide_loop.hpp"

namespace phy::engine {
namespace {

#if defined(__AVX512F__)
constexpr std::size_t register_bytes = 64;
#elif defined(__AVX2__)
constexpr std::size_t register_bytes = 32;
#else
constexpr std::size_t register_bytes = 16;
#endif

/// What `kernel` has for one line of the list of combinations.
template <class T, class KernelOf>
Kernel<T> find(std::size_t combination, const KernelOf& kernel) {
  // Index at run time to type at compile time: one comparison per combination.
  Kernel<T> found;
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    ((i == combination ? void(found = kernel(std::tuple_element<i, contact::Combinations>{})) : void()), ...);
  }
  (std::make_index_sequence<std::tuple_size_v<contact::Combinations>>());
  return found;
}
/// Specimens in lanes, as far as a register holds them: two registers are slower than two groups.
template <class R>
Kernel<ScalarOf<R>> run(std::size_t combination) {
  using T = ScalarOf<R>;
  if constexpr (sizeof(R) > register_bytes)
    return {};
  else
    return find<T>(combination,
                   []<class Line>(Line) { return Kernel<T>{advance_block<R, typename Line::type>}; });
}
/// One specimen, a register full of its contacts.
template <class T>
Kernel<T> run_alone(std::size_t combination) {
  using R = Pack<T, static_cast<int>(register_bytes / sizeof(T))>;
  return find<T>(combination, []<class Line>(Line) {
    return Kernel<T>{advance_wide<R, typename Line::type>, R::width};
  });
}

}  // namespace

#define PHY_JOIN2(a, b) a##b
#define PHY_JOIN(a, b) PHY_JOIN2(a, b)

Kernel<double> PHY_JOIN(double_kernel_, PHY_ISA)(std::size_t combination, int lanes) {
  switch (lanes) {
#if defined(__AVX2__)
    case 1: return run_alone<double>(combination);
#else
    case 1: return run<double>(combination);  // the reference: one contact after the other
#endif
    case 2: return run<Pack<double, 2>>(combination);
    case 4: return run<Pack<double, 4>>(combination);
    case 8: return run<Pack<double, 8>>(combination);
    default: return {};
  }
}

Kernel<float> PHY_JOIN(float_kernel_, PHY_ISA)(std::size_t combination, int lanes) {
  switch (lanes) {
    case 1: return run_alone<float>(combination);
    case 4: return run<Pack<float, 4>>(combination);
    case 8: return run<Pack<float, 8>>(combination);
    case 16: return run<Pack<float, 16>>(combination);
    default: return {};
  }
}

}  // namespace phy::engine
