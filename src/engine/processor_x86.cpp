#include "engine/isa.hpp"

namespace phy::engine {

Isa best_isa() {
  Isa best = Isa::sse2;
  if (__builtin_cpu_supports("avx2")) best = Isa::avx2;
  // All parts of AVX-512 that the compiler may use with the flags of that build.
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
    best = Isa::avx512;
  return best;
}

std::vector<const char*> isa_names() { return {"sse2", "avx2", "avx512"}; }

}  // namespace phy::engine
