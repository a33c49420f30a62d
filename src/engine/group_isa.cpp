// Compiled once per instruction set (CMakeLists.txt): the kernels of that set, by combination of contact
// models, precision and number of lanes.
#include <utility>

#include "contact/models.hpp"
#include "engine/force_loop.hpp"

namespace phy::engine {
namespace {

/// The kernel of one line of the list of combinations.
template <class R>
AdvanceBlock<ScalarOf<R>> run(std::size_t combination) {
  // Index at run time to type at compile time: one comparison per combination.
  AdvanceBlock<ScalarOf<R>> found = nullptr;
  [&]<std::size_t... i>(std::index_sequence<i...>) {
    ((i == combination ? void(found = advance_block<R, std::tuple_element_t<i, contact::Combinations>>)
                       : void()),
     ...);
  }
  (std::make_index_sequence<std::tuple_size_v<contact::Combinations>>());
  return found;
}

}  // namespace

#define PHY_JOIN2(a, b) a##b
#define PHY_JOIN(a, b) PHY_JOIN2(a, b)

AdvanceBlock<double> PHY_JOIN(double_kernel_, PHY_ISA)(std::size_t combination, int lanes) {
  // One lane is built once, without AVX: kernels.cpp takes it for every instruction set.
  switch (lanes) {
#if !defined(__AVX__)
    case 1: return run<double>(combination);
#endif
    case 2: return run<Pack<double, 2>>(combination);
    case 4: return run<Pack<double, 4>>(combination);
    case 8: return run<Pack<double, 8>>(combination);
    default: return nullptr;
  }
}

AdvanceBlock<float> PHY_JOIN(float_kernel_, PHY_ISA)(std::size_t combination, int lanes) {
  switch (lanes) {
    case 4: return run<Pack<float, 4>>(combination);
    case 8: return run<Pack<float, 8>>(combination);
    case 16: return run<Pack<float, 16>>(combination);
    default: return nullptr;
  }
}

}  // namespace phy::engine
