// Lane vectors in memory: reading, writing, adding.
#pragma once
#include <cstddef>

#include "base/pack.hpp"

namespace phy {
inline namespace PHY_ISA {

template <class R>
R load(const ScalarOf<R>* base, std::size_t i) {
  R r;
  __builtin_memcpy(&r, base + i * NumberTraits<R>::width, sizeof r);
  return r;
}
template <class R>
void store(ScalarOf<R>* base, std::size_t i, const R& r) {
  __builtin_memcpy(base + i * NumberTraits<R>::width, &r, sizeof r);
}
template <class R>
void add_to(ScalarOf<R>* base, std::size_t i, const R& r) {
  store(base, i, load<R>(base, i) + r);
}

/// Adds a row's lane sums to the specimen's sums in double.
template <class R>
void add_sample(double* sample, int field, const R& r) {
  constexpr int W = NumberTraits<R>::width;
  for (int l = 0; l < W; ++l) sample[field * W + l] += static_cast<double>(NumberTraits<R>::get(r, l));
}

}  // namespace PHY_ISA
}  // namespace phy
