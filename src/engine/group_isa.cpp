// Compiled once per instruction set (CMakeLists.txt): the kernels of that set, by precision and number of
// lanes.
#include "engine/force_loop.hpp"
#include "engine/kernels.hpp"

namespace phy {
namespace {

template <class R>
void run(GroupView<ScalarOf<R>>& view, int n_steps) {
  ForceLoop<R>(view).advance(n_steps);
}

}  // namespace

#define PHY_JOIN2(a, b) a##b
#define PHY_JOIN(a, b) PHY_JOIN2(a, b)

AdvanceBlock<double> PHY_JOIN(double_kernel_, PHY_ISA)(int lanes) {
  switch (lanes) {
#if !defined(__AVX__)
    case 1: return run<double>;
#endif
    case 2: return run<Pack<double, 2>>;
    case 4: return run<Pack<double, 4>>;
    case 8: return run<Pack<double, 8>>;
    default: return nullptr;
  }
}

AdvanceBlock<float> PHY_JOIN(float_kernel_, PHY_ISA)(int lanes) {
  switch (lanes) {
    case 4: return run<Pack<float, 4>>;
    case 8: return run<Pack<float, 8>>;
    case 16: return run<Pack<float, 16>>;
    default: return nullptr;
  }
}

}  // namespace phy
