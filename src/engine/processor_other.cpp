// Of processors that are no x86-64: one kind of register, and no kernels for wider ones.
#include "engine/kernels.hpp"

namespace phy::engine {

Isa best_isa() { return Isa::sse2; }

std::vector<const char*> isa_names() { return {"portable"}; }

Kernel<double> double_kernel_avx2(std::size_t, int) { return {}; }
Kernel<float> float_kernel_avx2(std::size_t, int) { return {}; }
Kernel<double> double_kernel_avx512(std::size_t, int) { return {}; }
Kernel<float> float_kernel_avx512(std::size_t, int) { return {}; }

}  // namespace phy::engine
