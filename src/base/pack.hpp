// Numbers that are one lane wide or many: the laws and the force loop are written once, over the number type
// R.
//
//   R = double              one specimen: the reference, easy to step through in a debugger
//   R = Pack<double, W>     W specimens of one packing side by side in a SIMD register
//   R = Pack<float, W>      the same in single precision
//
// A comparison gives a mask (bool, or a vector of all-ones/all-zeros integers); select(mask, a, b) replaces
// branches, so that every lane does the same operations and a lane's bits never depend on its neighbours.
// Built on the vector types of GCC and Clang; only the square root needs an intrinsic. Rejected: a SIMD
// library (the ten functions below are all that is used) and gathers inside one specimen (three times slower
// per contact, docs/decisions/0001).
#pragma once
#include <cmath>
#include <cstdint>
#include <type_traits>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

// The force loop is compiled once per instruction set. Each build lives in an inline namespace of its own, or
// the linker would keep one copy of equally named templates, perhaps one that this processor cannot run.
#ifndef PHY_ISA
#define PHY_ISA portable
#endif
// The body of the loop over contacts must be one piece of straight code: what is called for every contact is
// inlined whatever its size, and what happens to few contacts is kept out of it (g++ 12 otherwise spills half
// the registers).
#define PHY_HOT __attribute__((always_inline))
#define PHY_RARE __attribute__((noinline))

namespace phy {
inline namespace PHY_ISA {

template <class T>
using MaskInt = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;

template <class T, int W>
struct Mask {
  typedef MaskInt<T> Bits __attribute__((vector_size(sizeof(T) * W)));
  Bits bits;
  friend Mask operator&(Mask a, Mask b) { return {a.bits & b.bits}; }
  friend Mask operator|(Mask a, Mask b) { return {a.bits | b.bits}; }
  friend Mask operator!(Mask a) { return {~a.bits}; }
  bool operator[](int lane) const { return bits[lane] != 0; }
};

template <class T, int W>
struct Pack {
  typedef T Lanes __attribute__((vector_size(sizeof(T) * W)));
  using Scalar = T;
  static constexpr int width = W;
  Lanes v;

  Pack() = default;
  Pack(T scalar) : v(scalar - Lanes{}) {}  // NOLINT: a scalar is the same in every lane
  static Pack of(Lanes lanes) {
    Pack p;
    p.v = lanes;
    return p;
  }
  T operator[](int lane) const { return v[lane]; }

  friend Pack operator+(Pack a, Pack b) { return of(a.v + b.v); }
  friend Pack operator-(Pack a, Pack b) { return of(a.v - b.v); }
  friend Pack operator*(Pack a, Pack b) { return of(a.v * b.v); }
  friend Pack operator/(Pack a, Pack b) { return of(a.v / b.v); }
  friend Pack operator-(Pack a) { return of(-a.v); }
  Pack& operator+=(Pack b) { return *this = *this + b; }
  Pack& operator-=(Pack b) { return *this = *this - b; }
  friend Mask<T, W> operator<(Pack a, Pack b) { return {a.v < b.v}; }
  friend Mask<T, W> operator>(Pack a, Pack b) { return {a.v > b.v}; }
  friend Mask<T, W> operator>=(Pack a, Pack b) { return {a.v >= b.v}; }
};

template <class T, int W>
Pack<T, W> select(Mask<T, W> m, Pack<T, W> a, Pack<T, W> b) {
  return Pack<T, W>::of(m.bits ? a.v : b.v);
}

template <class T, int W>
Pack<T, W> sqrt(Pack<T, W> a) {
#if defined(__AVX512F__)
  if constexpr (sizeof(a.v) == 64 && sizeof(T) == 4)
    return Pack<T, W>::of((typename Pack<T, W>::Lanes)_mm512_sqrt_ps((__m512)a.v));
  if constexpr (sizeof(a.v) == 64 && sizeof(T) == 8)
    return Pack<T, W>::of((typename Pack<T, W>::Lanes)_mm512_sqrt_pd((__m512d)a.v));
#endif
#if defined(__AVX__)
  if constexpr (sizeof(a.v) == 32 && sizeof(T) == 4)
    return Pack<T, W>::of((typename Pack<T, W>::Lanes)_mm256_sqrt_ps((__m256)a.v));
  if constexpr (sizeof(a.v) == 32 && sizeof(T) == 8)
    return Pack<T, W>::of((typename Pack<T, W>::Lanes)_mm256_sqrt_pd((__m256d)a.v));
#endif
#if defined(__SSE2__)
  if constexpr (sizeof(a.v) == 16 && sizeof(T) == 4)
    return Pack<T, W>::of((typename Pack<T, W>::Lanes)_mm_sqrt_ps((__m128)a.v));
  if constexpr (sizeof(a.v) == 16 && sizeof(T) == 8)
    return Pack<T, W>::of((typename Pack<T, W>::Lanes)_mm_sqrt_pd((__m128d)a.v));
#endif
  Pack<T, W> r = a;
  for (int i = 0; i < W; ++i) r.v[i] = std::sqrt(a.v[i]);
  return r;
}

template <class T, int W>
Pack<T, W> abs(Pack<T, W> a) {
  using Bits = typename Mask<T, W>::Bits;
  const Bits sign = (Bits)(-(Pack<T, W>((T)0)).v);
  return Pack<T, W>::of((typename Pack<T, W>::Lanes)((Bits)a.v & ~sign));
}

template <class T, int W>
bool any(Mask<T, W> m) {
#if defined(__AVX512F__) && defined(__AVX512DQ__)
  if constexpr (sizeof(m.bits) == 64 && sizeof(T) == 4) return _mm512_movepi32_mask((__m512i)m.bits) != 0;
  if constexpr (sizeof(m.bits) == 64 && sizeof(T) == 8) return _mm512_movepi64_mask((__m512i)m.bits) != 0;
#endif
#if defined(__AVX__)
  if constexpr (sizeof(m.bits) == 32) return _mm256_testz_si256((__m256i)m.bits, (__m256i)m.bits) == 0;
#endif
#if defined(__SSE2__)
  if constexpr (sizeof(m.bits) == 16) return _mm_movemask_epi8((__m128i)m.bits) != 0;
#endif
  MaskInt<T> all = 0;
  for (int i = 0; i < W; ++i) all |= m.bits[i];
  return all != 0;
}

// The same vocabulary for one lane.
inline double select(bool m, double a, double b) { return m ? a : b; }
inline double sqrt(double a) { return std::sqrt(a); }
inline double abs(double a) { return std::fabs(a); }
inline bool any(bool m) { return m; }

/// What the laws need to know about a number type.
template <class R>
struct NumberTraits {
  using Scalar = typename R::Scalar;
  using MaskType = Mask<Scalar, R::width>;
  static constexpr int width = R::width;
  static Scalar get(const R& r, int lane) { return r.v[lane]; }
  static void set(R& r, int lane, Scalar value) { r.v[lane] = value; }
  static bool test(const MaskType& m, int lane) { return m[lane]; }
};
template <>
struct NumberTraits<double> {
  using Scalar = double;
  using MaskType = bool;
  static constexpr int width = 1;
  static double get(const double& r, int) { return r; }
  static void set(double& r, int, double value) { r = value; }
  static bool test(bool m, int) { return m; }
};
template <class R>
using MaskOf = typename NumberTraits<R>::MaskType;
template <class R>
using ScalarOf = typename NumberTraits<R>::Scalar;

template <class R>
R max0(R a) {
  return select(a > R(0), a, R(0));
}
template <class R>
R min(R a, R b) {
  return select(a < b, a, b);
}
template <class R>
R max(R a, R b) {
  return select(a > b, a, b);
}
/// a limited to [-limit, limit], limit >= 0.
template <class R>
R clip(R a, R limit) {
  return max(min(a, limit), -limit);
}
/// -1, 0 or +1.
template <class R>
R sign(R a) {
  return select(a > R(0), R(1), select(a < R(0), R(-1), R(0)));
}

}  // namespace PHY_ISA
}  // namespace phy
